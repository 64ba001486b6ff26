// The one-sensor paper's claims on accuracy: its table 6, its figure 6 and the comparison in its
// conclusions.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/words.h"
#include "studies/one_sensor/one_sensor_parts.h"

namespace dashpot {
namespace {

namespace paper = one_sensor_paper;

/// The networks of table 6, by what they measure.
constexpr std::array<std::pair<const char*, const char*>, 4> kNetworks{
    {{kStatic, "static, 1 sensor"},
     {"two-sensors", "static, 2 sensors"},
     {"recurrent", "recurrent, 2 sensors"},
     {kHysteresis, "hysteresis network, 1 sensor"}}};

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
  double squares = 0;
  for (const double value : values) squares += (value - mean(values)) * (value - mean(values));
  return std::sqrt(squares / static_cast<double>(values.size()));
}

/// % of half-span by experiment; empty when the model was not fitted or diverged on one.
std::vector<double> percents(const OneSensorView& view, std::size_t damper,
                             const std::string& key) {
  std::vector<double> values;
  for (std::size_t e = 0; e < view.study.dampers[damper].damper.experiments.size(); ++e) {
    const StudiedResult* result = view.study.result(damper, key, e);
    if (!result || result->diverged_at) return {};
    values.push_back(view.half_percent(damper, result->metrics.rmse));
  }
  return values;
}

std::vector<std::string> paper_row(const std::string& name, std::size_t damper) {
  std::vector<std::string> row{name, "the paper: static, 1 sensor, its own damper"};
  const auto& experiments = paper::kExperiments[damper];
  for (const double percent : experiments) row.push_back(number_text(percent, 4));
  const double average = mean({experiments.begin(), experiments.end()});
  row.push_back(number_text(average));
  row.push_back(number_text(average / 2));
  row.push_back(number_text(paper::kMeanRms[damper], 4));
  return row;
}

std::vector<std::string> own_row(const OneSensorView& view, std::size_t damper, const char* key,
                                 const std::string& title) {
  const StudiedDamper& studied = view.study.dampers[damper].damper;
  std::vector<std::string> row{studied.name + (studied.is_virtual ? ", virtual damper" : ""),
                               title};

  // Each experiment in % of half-span; a divergence leaves no mean.
  double sum = 0, rms = 0;
  for (std::size_t e = 0; e < studied.experiments.size(); ++e) {
    const StudiedResult* result = view.study.result(damper, key, e);
    if (!result) return {};
    row.push_back(view.half_text(damper, *result));
    const double here = result->diverged_at ? NAN : result->metrics.rmse;
    sum += view.half_percent(damper, here);
    rms += here;
  }

  // Means over the experiments: of half-span, of span, in N.
  const auto count = static_cast<double>(studied.experiments.size());
  row.push_back(number_text(sum / count));
  row.push_back(number_text(sum / count / 2));
  row.push_back(number_text(rms / count, 4));
  return row;
}

DocumentTable table_6(const OneSensorView& view, std::size_t damper) {
  const StudiedDamper& studied = view.study.dampers[damper].damper;
  DocumentTable table{"Table 6, RMS error in % of half-span: " + studied.name +
                          (studied.is_virtual ? ", a virtual damper" : ""),
                      {{"Damper", false}, {"Model", false, 0, true}},
                      {}};

  // A column for each experiment, then the means.
  for (std::size_t e = 0; e < studied.experiments.size(); ++e)
    table.columns.push_back(
        {studied.is_virtual ? "Exp. " + std::to_string(e + 1) : studied.experiments[e].name, true,
         studied.is_virtual ? 0 : 3});
  table.columns.insert(table.columns.end(),
                       {{"Mean", true}, {"Mean, span %", true, 2}, {"Mean RMS N", true, 1}});

  // The paper's row first, where this is one of its dampers.
  if (studied.is_virtual) table.rows.push_back(paper_row(studied.name, damper));
  for (const auto& [key, title] : kNetworks)
    if (std::vector<std::string> row = own_row(view, damper, key, title); !row.empty())
      table.rows.push_back(std::move(row));
  return table;
}

/// Shares of the samples that lie below, of the errors of one experiment, N.
std::vector<double> quantiles(std::vector<double> errors, const std::vector<double>& shares) {
  std::ranges::sort(errors);
  std::vector<double> result;
  for (const double share : shares)
    result.push_back(
        errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))]);
  return result;
}

/// A box by lines: 5 to 95 %, 25 to 75 %, and the median as a point.
void add_box(std::vector<FigureSeries>& box, double place, const std::vector<double>& percents) {
  const auto add = [&](FigureSeries& series, double low, double high) {
    series.x.insert(series.x.end(), {place, place, NAN});
    series.y.insert(series.y.end(), {low, high, NAN});
  };
  add(box[0], percents[0], percents[4]);
  add(box[1], percents[1], percents[3]);
  box[2].x.push_back(place);
  box[2].y.push_back(percents[2]);
}

std::vector<FigureSeries> boxes(const OneSensorView& view, std::size_t damper, const char* key,
                                const std::string& label, const std::string& colour, double shift) {
  std::vector<FigureSeries> box{{label, colour, {}, {}, FigureSeries::Mark::Line, 1.2},
                                {"", colour, {}, {}, FigureSeries::Mark::Line, 7},
                                {"", "", {}, {}, FigureSeries::Mark::Dots, 3}};
  box[2].colour = "series-2";

  // A box for each experiment on which the model stayed finite.
  const StudiedDamper& studied = view.study.dampers[damper].damper;
  for (std::size_t e = 0; e < studied.experiments.size(); ++e) {
    const StudiedResult* result = view.study.result(damper, key, e);
    if (!result || result->diverged_at) continue;

    // Errors of all scored samples of the left-out records.
    std::vector<double> errors;
    const std::vector<Record>& records = studied.experiments[e].left_out;
    for (std::size_t r = 0; r < records.size(); ++r) {
      const std::vector<double>& force = records[r].channel("force").samples;
      for (std::size_t i = records[r].warm_up; i < force.size(); ++i)
        errors.push_back(force[i] - result->forces[r][i]);
    }

    // Their quantiles in % of half-span.
    std::vector<double> found = quantiles(std::move(errors), {0.05, 0.25, 0.5, 0.75, 0.95});
    for (double& value : found) value = view.half_percent(damper, value);
    add_box(box, static_cast<double>(e) + shift, found);
  }
  return box;
}

DocumentFigure figure_6(const OneSensorView& view) {
  DocumentFigure figure{"figure-6",
                        "Figure 6: variability of the error",
                        "Error of the samples of each left-out recording: 5 to 95 % of them, 25 to "
                        "75 % thick, the median as a point.",
                        {}};

  // A panel for each damper, its experiments side by side.
  for (std::size_t d = 0; d < view.study.dampers.size(); ++d) {
    const StudiedDamper& damper = view.study.dampers[d].damper;
    FigurePanel panel{damper.name + (damper.is_virtual ? ", virtual damper" : ""),
                      damper.is_virtual ? "Experiment" : "Division",
                      "Error (% of half-span)",
                      {}};
    for (std::size_t e = 0; e < damper.experiments.size(); ++e)
      panel.places.push_back(std::to_string(e + 1));

    // Both networks with one sensor, beside each other.
    for (auto& part :
         {boxes(view, d, kStatic, "static, 1 sensor", "series-6", -0.15),
          boxes(view, d, kHysteresis, "hysteresis network, 1 sensor", "modelled", 0.15)})
      panel.series.insert(panel.series.end(), part.begin(), part.end());
    figure.panels.push_back(std::move(panel));
  }
  figure.columns = figure.panels.size() > 1 ? 2 : 1;
  return figure;
}

/// The experiments by falling error: "5, 2, 1, 4, 3".
std::string order_text(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t k) { return values[k]; });
  std::vector<std::string> words;
  for (const std::size_t k : order) words.push_back(std::to_string(k + 1));
  return join(words, ", ");
}

void compare_experiments(const OneSensorView& view, DocumentSection& section) {
  // The order of the experiments, and how much the error varies among them.
  std::vector<double> spreads, paper_spreads;
  for (std::size_t d = 0; d < view.study.dampers.size(); ++d) {
    const std::vector<double> ours = percents(view, d, kStatic);
    const std::vector<double> theirs(paper::kExperiments[d].begin(), paper::kExperiments[d].end());
    if (ours.empty()) return;
    section.remarks.push_back(fmt::format("{}, worst experiment first: {} here, {} in the paper.",
                                          view.study.dampers[d].damper.name, order_text(ours),
                                          order_text(theirs)));
    spreads.push_back(deviation(ours));
    paper_spreads.push_back(deviation(theirs));
  }

  // The paper's claim: it varies more on MR1 than on MR2.
  section.paragraphs.push_back(fmt::format(
      "{}: the static network's error varies more from experiment to experiment on MR1 than on "
      "MR2: standard deviation {} and {} % of half-span here, {} and {} % in the paper.",
      (spreads[0] > spreads[1]) == (paper_spreads[0] > paper_spreads[1]) ? "Agrees"
                                                                         : "Does not agree",
      number_text(spreads[0], 2), number_text(spreads[1], 2), number_text(paper_spreads[0], 2),
      number_text(paper_spreads[1], 2)));
}

/// Mean of the experiments' ESR, as the literature averages it; with the worst.
struct EsrRow {
  double mean = 0, worst = 0;
  std::size_t parameters = 0;
  bool judged = true;
};

EsrRow esr_of(const OneSensorView& view, std::size_t damper, const std::string& key) {
  EsrRow row;
  const std::size_t count = view.study.dampers[damper].damper.experiments.size();
  for (std::size_t e = 0; e < count; ++e) {
    const StudiedResult* result = view.study.result(damper, key, e);
    if (!result) return {.judged = false};
    const double esr = result->diverged_at ? NAN : result->metrics.esr;
    row.mean += esr / static_cast<double>(count);
    row.worst = result->diverged_at ? NAN : std::max(row.worst, esr);
    row.parameters = result->parameters;
  }
  return row;
}

struct EsrModel {
  const char *key, *title, *paper, *sensors;
};
const std::string kOwnEsr = number_text(paper::kEsr), kBingham = number_text(paper::kBinghamEsr),
                  kPhenomenological = number_text(paper::kPhenomenologicalEsr),
                  kSemiPhenomenological = number_text(paper::kSemiPhenomenologicalEsr);
const std::array<EsrModel, 7> kEsrModels{
    {{"bingham", "Bingham", kBingham.c_str(), "v"},
     {"semi-phenomenological", "semi-phenomenological", kSemiPhenomenological.c_str(), "x, v"},
     {"modified-bouc-wen", "phenomenological: modified Bouc-Wen", kPhenomenological.c_str(),
      "x, v"},
     {kStatic, "static network, 1 sensor", kOwnEsr.c_str(), "v"},
     {"two-sensors", "static network, 2 sensors", "-", "x, v"},
     {"recurrent", "recurrent network, 2 sensors", paper::kRecurrentEsr, "x, v"},
     {kHysteresis, "hysteresis network, 1 sensor", "-", "v"}}};

/// A sentence on an order that the paper states: it holds here for every damper, or does not.
std::string holds(const OneSensorView& view, const char* better, const char* worse,
                  const std::string& said) {
  std::vector<std::string> here;
  bool all = true;
  for (std::size_t d = 0; d < view.study.dampers.size(); ++d) {
    const EsrRow a = esr_of(view, d, better), b = esr_of(view, d, worse);
    if (!a.judged || !b.judged) return "Not to be compared here: " + said + ".";
    const bool right = a.mean < b.mean;
    all = all && right;
    here.push_back(fmt::format("{} {} and {} %", view.study.dampers[d].damper.name,
                               number_text(a.mean), number_text(b.mean)));
  }
  return fmt::format("{}: {} ({}).", all ? "Agrees" : "Does not agree", said, join(here, "; "));
}

}  // namespace

DocumentSection accuracy_section(const OneSensorView& view) {
  DocumentSection section{"table-6", "Table 6: five experiments", {}};
  if (!view.is_virtual()) section.title = "Table 6: division by division";

  // Table and figure; the paper's experiments only for virtual dampers.
  for (std::size_t d = 0; d < view.study.dampers.size(); ++d)
    section.tables.push_back(table_6(view, d));
  section.figures.push_back(figure_6(view));
  if (view.is_virtual()) compare_experiments(view, section);

  // The hysteresis network against the static one: how often it is better, and by how much.
  for (std::size_t d = 0; d < view.study.dampers.size(); ++d) {
    const std::vector<double> plain = percents(view, d, kStatic),
                              bank = percents(view, d, kHysteresis);
    if (plain.empty() || bank.empty()) continue;
    std::size_t better = 0;
    for (std::size_t e = 0; e < plain.size(); ++e) better += bank[e] < plain[e];
    section.remarks.push_back(fmt::format(
        "{}: the hysteresis network beats the static one in {} of {}; the mean error {}.",
        view.study.dampers[d].damper.name, better,
        counted(plain.size(), view.is_virtual() ? "experiment" : "division"),
        change_text(mean(plain), mean(bank))));
  }
  return section;
}

DocumentSection esr_section(const OneSensorView& view) {
  DocumentSection section{
      "esr", "The conclusions: share of the force's power left unexplained", {}};

  // Mean and worst experiment of every damper, beside what the paper reports.
  DocumentTable table{"ESR %, mean over the experiments and worst",
                      {{"Model", false, 0, true}, {"Sensors"}, {"As the paper reports", true}},
                      {}};
  for (const DamperStudy& one : view.study.dampers) {
    const std::string name = one.damper.name + (one.damper.is_virtual ? ", virtual" : "");
    table.columns.push_back({name + ": mean", true});
    table.columns.push_back({name + ": worst", true, 2});
  }
  table.columns.push_back({"Numbers", true, 3});

  // A row for each model.
  for (const EsrModel& model : kEsrModels) {
    std::vector<std::string> row{model.title, model.sensors, model.paper};
    std::size_t parameters = 0;
    for (std::size_t d = 0; d < view.study.dampers.size(); ++d) {
      const EsrRow esr = esr_of(view, d, model.key);
      row.push_back(esr.judged ? number_text(esr.mean) : "-");
      row.push_back(esr.judged ? number_text(esr.worst) : "-");
      parameters = std::max(parameters, esr.parameters);
    }
    row.push_back(parameters == 0 ? "-" : std::to_string(parameters));
    table.rows.push_back(std::move(row));
  }

  // The sources of the reported figures.
  table.note =
      "Reported: Bingham and 0.9 % by Savaresi et al. 2005, the others by Ruiz-Cabrera et al. "
      "2010, 4.7 % by the paper itself: each on a damper and records of its own. A number that is "
      "not finite stands as -.";
  section.tables.push_back(std::move(table));

  // The orders that the paper states, checked on every damper.
  section.remarks = {
      holds(view, kStatic, "bingham", "the static one-sensor network leaves less than Bingham"),
      holds(view, kStatic, "modified-bouc-wen", "it leaves less than the phenomenological model"),
      holds(view, kStatic, "semi-phenomenological",
            "it leaves less than the semi-phenomenological model"),
      holds(view, "recurrent", kStatic, "a recurrent network with two sensors leaves less than it"),
      holds(view, "modified-bouc-wen", "bingham",
            "the phenomenological model leaves less than Bingham"),
      holds(view, "bingham", "semi-phenomenological",
            "Bingham leaves less than the semi-phenomenological model")};

  // Limits of the comparison.
  section.paragraphs.push_back(
      "The paper compares its 4.7 % with what other papers report of other dampers. Here all "
      "models see the same records. Laws are fitted to all currents at once, each parameter as the "
      "table of its law says; a law fitted current by current, or better started, would do better, "
      "which may be what sets the published figures apart.");
  if (view.is_virtual())
    section.paragraphs.push_back(
        "What cannot be compared: the size of any figure. A virtual damper is as difficult as it "
        "was made; MR1 here is a law of the registry (hyperbolic tangent of velocity and "
        "acceleration), so that models near to that law have an easy task. Nor do the paper's "
        "percentages say how its network was trained and judged.");
  return section;
}

}  // namespace dashpot
