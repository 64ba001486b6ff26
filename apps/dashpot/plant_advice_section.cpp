#include "plant_advice_section.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/text.h"

namespace dashpot::cli {
namespace {

/// By how much an interval shrinks, %.
std::string less_text(double ratio) { return format_number(100 * (1 - ratio), 3); }

DocumentTable addition_table(const std::string& title, const std::string& what,
                             const std::vector<PlantAddition>& additions, const std::string& note) {
  DocumentTable table{.title = title,
                      .columns = {{what},
                                  {"intervals narrower by, %", true},
                                  {"most of all", false},
                                  {"by, %", true}},
                      .rows = {},
                      .note = note};
  for (const PlantAddition& one : additions)
    table.rows.push_back({one.what, less_text(one.intervals), one.most, less_text(one.of_most)});
  return table;
}

std::string bound_text(double value, const char* open) {
  return std::isfinite(value) ? format_number(value, 5) : open;
}

DocumentTable profile_table(const std::vector<ParameterProfile>& profiles) {
  DocumentTable table{
      .title = "Profiles",
      .columns = {{"number"}, {"unit"}, {"95 % by profile", true}, {"looked at", true}},
      .rows = {}};
  for (const ParameterProfile& one : profiles)
    table.rows.push_back(
        {one.name, one.unit, bound_text(one.low, "open") + " ... " + bound_text(one.high, "open"),
         format_number(one.value.front(), 4) + " ... " + format_number(one.value.back(), 4)});
  table.note =
      "Where the misfit, all other numbers fitted anew, rises to what bounds 95 %; open: it "
      "does not, as far as was looked.";
  return table;
}

DocumentFigure profile_figure(const std::vector<ParameterProfile>& profiles) {
  DocumentFigure figure{.name = "profiles",
                        .title = "Profiles",
                        .caption =
                            "Misfit over that of the best, all other numbers fitted anew; "
                            "3.84 bounds the 95 % interval.",
                        .panels = {},
                        .columns = 2};
  for (const ParameterProfile& one : profiles) {
    FigurePanel panel{.title = one.name,
                      .x_label = one.name + ", " + one.unit,
                      .y_label = "misfit over the best",
                      .series = {}};
    panel.series.push_back(
        {.label = "profile", .colour = "modelled", .x = one.value, .y = one.misfit});
    panel.series.push_back({.label = "95 %",
                            .colour = "measured",
                            .x = {one.value.front(), one.value.back()},
                            .y = {3.84, 3.84},
                            .mark = FigureSeries::Mark::Dashes});
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace

void add_advice(const PlantAdvice& advice, DocumentSection& section) {
  // The best sensor in a sentence, all of them in a table.
  if (!advice.sensors.empty()) {
    const PlantAddition& best = advice.sensors.front();
    section.paragraphs.push_back(
        fmt::format("The sensor that would add most ({} grade): {}. The 95 % intervals would be {} "
                    "% narrower on average, that of {} by {} %; known worst is {}.",
                    advice.grade, best.what, less_text(best.intervals), best.most,
                    less_text(best.of_most), advice.worst));
    section.tables.push_back(
        addition_table("Sensors that are not there", "sensor", advice.sensors,
                       "One of them added to the same recordings; mean over plant and damper. What "
                       "the model lacks is taken to show in it as much as in those that are "
                       "there."));
  }

  // More of the same sensors: other rides.
  if (!advice.rides.empty())
    section.tables.push_back(addition_table(
        "One more recording", "the first one again, with", advice.rides,
        "Beside one more that is just like the first; as far as the model is right there."));

  // What the recordings have of each number, as a table and as curves.
  if (advice.profiles.empty()) return;
  section.tables.push_back(profile_table(advice.profiles));
  section.figures.push_back(profile_figure(advice.profiles));
}

}  // namespace dashpot::cli
