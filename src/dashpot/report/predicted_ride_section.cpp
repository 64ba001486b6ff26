#include "dashpot/report/predicted_ride_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/quantity.h"
#include "dashpot/report/ranking_words.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

/// A figure of the ride: its names, and how people see it.
struct PredictedFigure {
  const char *key, *title, *hint;
  Estimate PredictedRide::* figure;
  int priority;
  const char* unit = "";  ///< SI; "" where it is a share, whose title has the %
  double to_si = 1;       ///< factor to that unit
};
constexpr double kMetres = 1e-3;  // per mm
constexpr std::array kPredictedFigures{
    PredictedFigure{"ride_error_percent", "Ride error %",
                    "Root mean square of the next three, each over its rms in the damper's ride",
                    &PredictedRide::error, 0},
    PredictedFigure{"weighted_acceleration", "a_w",
                    "rms over time of the error of the body's acceleration, weighted by Wk",
                    &PredictedRide::acceleration, 0, "m/s^2"},
    PredictedFigure{"tyre_load_percent", "Tyre load %",
                    "rms error of the worst tyre's load, of its static load",
                    &PredictedRide::tyre_load, 1},
    PredictedFigure{"travel_mm", "Travel", "rms error of the worst strut's travel",
                    &PredictedRide::travel, 1, "m", kMetres},
    PredictedFigure{"weighted_acceleration_excess", "a_w",
                    "Above 0, the damper rides better than the model says",
                    &PredictedRide::acceleration_excess, 0, "m/s^2"},
    PredictedFigure{"tyre_load_excess_percent", "Tyre load %", "Of the static load",
                    &PredictedRide::tyre_load_excess, 0},
    PredictedFigure{"travel_excess_mm", "Travel", "Of the worst strut",
                    &PredictedRide::travel_excess, 0, "m", kMetres}};
constexpr std::size_t kTraces = 4;  // of them are errors over time, the first ones

/// "13.5 (9 ... 121)", of a quantity in SI or of a share.
std::string interval_text(const Estimate& figure, std::string_view unit = "", double to_si = 1) {
  const auto end = [&](double value) {
    return quantity(to_si * value, unit, std::abs(value) < 99.5 ? 2 : 3);
  };
  return fmt::format("{} ({} ... {})", quantity(to_si * figure.value, unit, 3), end(figure.low),
                     end(figure.high));
}

std::size_t place_of(const Ranking& ranking, const RankedModel& model) {
  return static_cast<std::size_t>(&model - ranking.models.data());
}

std::string setting_of(const Ranking& ranking) {
  const RiddenThrough& ride = *ranking.ridden;
  return fmt::format(
      "{}, {}, {}, {} s. The damper is known by {}, whose errors on left-out records leave least "
      "unexplained ({} {}): with one of its errors, drawn {} times, it stands for the damper.",
      ride.vehicle, ride.road, ride.controller, number_text(ride.duration), ride.known_by,
      quantity(ride.unexplained, "N"), unit_name("N"), ride.draws);
}

/// The two orders in a sentence.
std::string orders_of(const Ranking& ranking) {
  const std::vector<const RankedModel*> ridden = ranking.by_ride();
  const auto on_bench = std::ranges::min_element(
      ridden, {}, [](const RankedModel* m) { return m->left_out.pooled.esr; });
  const RankedModel &first = *ridden.front(), &bench = **on_bench;
  if (&first == &bench)
    return fmt::format("{} is best on the bench and in the ride, where its error is {} %.",
                       display_name(first), interval_text(first.ride->error));
  return fmt::format("In the ride {} is best, error {} %; {}, best on the bench, has {} %.",
                     display_name(first), interval_text(first.ride->error), display_name(bench),
                     interval_text(bench.ride->error));
}

/// One row per ridden model, with these of the figures.
DocumentTable predicted_table(const Ranking& ranking, std::string title,
                              std::span<const PredictedFigure> figures) {
  DocumentTable table{.title = std::move(title),
                      .columns = {{.title = "Model", .elastic = true}},
                      .rows = {},
                      .leads_to = "closer"};
  for (const PredictedFigure& figure : figures) {
    const std::string unit = *figure.unit ? ' ' + unit_name(figure.unit) : "";
    table.columns.push_back({.title = figure.title + unit,
                             .numeric = true,
                             .priority = figure.priority,
                             .hint = figure.hint});
  }
  table.columns.push_back({.title = "ESR %", .numeric = true});
  table.columns.push_back(
      {.title = "On the bench", .numeric = true, .hint = "The place in the ranking by ESR"});

  for (const RankedModel* model : ranking.by_ride()) {
    const std::size_t place = place_of(ranking, *model);
    std::vector<DocumentCell> row{{model->name}};
    for (const PredictedFigure& column : figures) {
      const Estimate& figure = (*model->ride).*column.figure;
      row.push_back({interval_text(figure, column.unit, column.to_si), figure.value});
    }
    row.push_back({percent_text(model->left_out.pooled.esr), model->left_out.pooled.esr});
    row.push_back({std::to_string(place + 1)});
    add_row(table, row);
    table.chooses.push_back({{"model", place}});
  }
  return table;
}

/// Error in the ride over error on the bench.
DocumentFigure bench_and_ride_figure(const Ranking& ranking) {
  FigurePanel panel{.title = "Error in the ride over error on the bench",
                    .x_label = "ESR on the bench, %",
                    .y_label = "error in the ride, %",
                    .series = {},
                    .x_log = true};
  FigureSeries dots{.label = "median",
                    .colour = "series-1",
                    .x = {},
                    .y = {},
                    .mark = FigureSeries::Mark::Dots,
                    .width = 4};

  // An interval for each model, and all medians as one series above them.
  for (const RankedModel* model : ranking.by_ride()) {
    const double esr = model->left_out.pooled.esr;
    const Estimate& error = model->ride->error;
    panel.series.push_back({.label = "90 % interval",
                            .colour = "series-1",
                            .x = {esr, esr},
                            .y = {error.low, error.high},
                            .is_read = false,
                            .opacity = 0.5});
    dots.x.push_back(esr);
    dots.y.push_back(error.value);
    dots.names.push_back(model->name);
  }
  panel.series.push_back(std::move(dots));
  return {"bench-and-ride",
          "On the bench and in the ride",
          "Each model once: where the order from left to right is not that from below upwards, the "
          "bench misleads.",
          {std::move(panel)}};
}

Value estimate_json(const Estimate& figure) {
  return Value::object({{"value", figure.value}, {"low", figure.low}, {"high", figure.high}});
}

}  // namespace

std::vector<DocumentSection> predicted_ride_sections(const Ranking& ranking) {
  DocumentSection section{.name = "ride",
                          .title = "Ranking by the ride",
                          .paragraphs = {},
                          .lead =
                              "How far the ride of each model will lie from that of the damper, "
                              "as far as the recordings tell."};
  if (ranking.ridden) {
    section.paragraphs = {orders_of(ranking), setting_of(ranking)};
    const std::span all(kPredictedFigures);
    section.tables = {predicted_table(ranking, "Error over time", all.first(kTraces)),
                      predicted_table(ranking, "Error of the rms itself, above 0: too high",
                                      all.subspan(kTraces))};
    section.tables.front().note = "Medians with 90 % intervals.";
    section.tables.back().audience = Audience::Files;
    section.figures.push_back(bench_and_ride_figure(ranking));
  }

  // Models without a ride, and what went wrong on the way.
  for (const RankedModel& model : ranking.models) {
    if (!model.ride) continue;
    if (!model.ride->refusal.empty())
      section.remarks.push_back(model.name + " is not ridden: " + model.ride->refusal);
    for (const std::string& warning : model.ride->warnings)
      section.remarks.push_back(model.name + ": " + warning);
  }
  if (!ranking.ridden && section.remarks.empty()) return {};
  return {std::move(section)};
}

Value predicted_json(const RankedModel& model) {
  if (!model.ride) return {};
  if (!model.ride->refusal.empty()) return Value::object({{"refusal", model.ride->refusal}});
  Value ride = Value::object();
  for (const PredictedFigure& column : kPredictedFigures)
    ride.add(column.key, estimate_json((*model.ride).*column.figure));
  ride.add("warnings", Value::array(model.ride->warnings));
  return ride;
}

Value ridden_json(const Ranking& ranking) {
  if (!ranking.ridden) return {};
  Value order = Value::array();
  for (const RankedModel* model : ranking.by_ride()) order.push_back(model->name);
  const RiddenThrough& ride = *ranking.ridden;
  return Value::object({{"vehicle", ride.vehicle},
                        {"road", ride.road},
                        {"controller", ride.controller},
                        {"duration", ride.duration},
                        {"known_by", ride.known_by},
                        {"unexplained_N", ride.unexplained},
                        {"draws", ride.draws},
                        {"order", std::move(order)}});
}

std::string predicted_csv_titles(const Ranking& ranking) {
  std::string text;
  if (!ranking.ridden) return text;
  for (const PredictedFigure& column : kPredictedFigures)
    for (const char* end : {"", "_low", "_high"}) text += std::string(",") + column.key + end;
  return text;
}

std::string predicted_csv(const Ranking& ranking, const RankedModel& model) {
  std::string text;
  if (!ranking.ridden) return text;
  const bool is_ridden = model.ride && model.ride->refusal.empty();
  for (const PredictedFigure& column : kPredictedFigures)
    for (double Estimate::* part : {&Estimate::value, &Estimate::low, &Estimate::high})
      text += ',' + (is_ridden ? format_exact((*model.ride).*column.figure.*part) : std::string());
  return text;
}

}  // namespace dashpot
