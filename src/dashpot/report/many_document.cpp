#include "dashpot/report/many_document.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "dashpot/base/any_number.h"
#include "dashpot/base/text.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

constexpr std::size_t kShownDampers = 50;  // rows of a table for people; the CSV has all
constexpr double kPerThousand = 1000;      // drift is told over so many dampers

/// What stands out of one damper: places in PopulationReport::outliers.
struct FlaggedDamper {
  std::size_t damper = 0;
  std::vector<const Outlier*> found;  ///< by falling |score|
};

std::vector<FlaggedDamper> flagged_dampers(const ManyReport& report) {
  std::vector<FlaggedDamper> flagged;
  for (const Outlier& outlier : report.population.outliers) {
    if (flagged.empty() || flagged.back().damper != outlier.damper)
      flagged.push_back({outlier.damper, {}});
    flagged.back().found.push_back(&outlier);
  }
  return flagged;
}

std::string drift_text(const Usual& usual) {
  if (!usual.drift.is_tested) return "-";
  if (!usual.drift.is_seen()) return "none seen";
  return number_text(kPerThousand * usual.drift.slope);
}

/// "weak in rebound_100mm/s_0.5A (-6.1)"
std::string outlier_text(const ManyReport& report, const Outlier& outlier) {
  return fmt::format("{} {} ({:+.1f})", report.quantities[outlier.quantity].name,
                     number_text(outlier.value), outlier.score);
}

std::vector<std::string> drifting(const ManyReport& report) {
  std::vector<std::string> names;
  for (std::size_t q = 0; q < report.quantities.size(); ++q)
    if (report.population.usual[q].drift.is_seen()) names.push_back(report.quantities[q].name);
  return names;
}

std::string many_verdict(const ManyReport& report) {
  const std::size_t all = report.rows.size(), fitted = report.fitted();
  std::string text = fmt::format("{}: {} with a result, {} without.", counted(all, "damper"),
                                 fitted, all - fitted);
  if (report.population.judged_columns == 0)
    return text + " Too few, or too alike, to judge them by each other.";

  // How many stand out, beside how many would by chance.
  const std::size_t flagged = flagged_dampers(report).size();
  text += fmt::format(
      " {} out in at least one of {} quantities; of sound and normal ones, {} would by chance.",
      flagged == 1 ? "1 stands" : fmt::format("{} stand", flagged),
      report.population.judged_columns,
      number_text(report.options.false_alarms * static_cast<double>(report.population.judged), 2));

  // What drifts over the serial number: the first few by name.
  const std::vector<std::string> drifts = drifting(report);
  if (!drifts.empty()) {
    constexpr std::size_t kNamed = 4;
    std::vector<std::string> named(
        drifts.begin(),
        drifts.begin() + static_cast<std::ptrdiff_t>(std::min(kNamed, drifts.size())));
    text += fmt::format(
        " Over the serial number drift {}{}.", join(named, ", "),
        drifts.size() > kNamed ? fmt::format(" and {} more", drifts.size() - kNamed) : "");
  }
  return text;
}

DocumentSection outlier_section(const ManyReport& report) {
  const std::vector<FlaggedDamper> flagged = flagged_dampers(report);
  DocumentSection section{"outliers", "What stands out", {}};
  DocumentTable table{.title = "Dampers that stand out",
                      .columns = {{"damper"},
                                  {"serial", true, 2},
                                  {"quantity"},
                                  {"value", true},
                                  {"expected", true},
                                  {"unit", false, 1},
                                  {"score", true},
                                  {"also", false, 3, true}},
                      .rows = {}};

  // The farthest first.
  std::vector<const FlaggedDamper*> order;
  for (const FlaggedDamper& one : flagged) order.push_back(&one);
  std::ranges::stable_sort(order, std::greater<>(), [](const FlaggedDamper* one) {
    return std::abs(one->found.front()->score);
  });
  for (const FlaggedDamper* one : order) {
    if (table.rows.size() == kShownDampers) break;
    const Outlier& worst = *one->found.front();
    std::vector<std::string> also;
    for (std::size_t k = 1; k < one->found.size(); ++k)
      also.push_back(report.quantities[one->found[k]->quantity].name);
    const DamperRow& row = report.rows[one->damper];
    add_row(table, {{row.name},
                    {format_number(row.serial, 15), row.serial},
                    {report.quantities[worst.quantity].name},
                    {number_text(worst.value, 4), worst.value},
                    {number_text(worst.expected, 4), worst.expected},
                    {report.quantities[worst.quantity].unit},
                    {fmt::format("{:+.1f}", worst.score), worst.score},
                    {join(also, ", ")}});
  }
  table.note = flagged.size() > kShownDampers
                   ? fmt::format("The {} farthest of {}; dampers.csv has all.", kShownDampers,
                                 flagged.size())
                   : "";
  if (flagged.empty())
    section.paragraphs.emplace_back("No damper stands out.");
  else
    section.tables.push_back(std::move(table));
  return section;
}

DocumentSection failure_section(const ManyReport& report) {
  DocumentSection section{"failures", "Without a result", {}};
  DocumentTable table{.title = "Dampers without a result",
                      .columns = {{"damper"}, {"why", false, 0, true}},
                      .rows = {}};
  std::size_t count = 0;
  for (const DamperRow& row : report.rows)
    if (!row.failure.empty() && ++count <= kShownDampers)
      table.rows.push_back({row.name, row.failure});
  if (count > kShownDampers)
    table.note = fmt::format("The first {} of {}; dampers.csv has all.", kShownDampers, count);
  section.tables.push_back(std::move(table));
  return section;
}

/// The quantities that are drawn: those in which most dampers stand out, then those that drift.
std::vector<std::size_t> drawn_quantities(const ManyReport& report) {
  constexpr std::size_t kPanels = 6;
  std::vector<std::size_t> found(report.quantities.size()), order(report.quantities.size());
  for (const Outlier& outlier : report.population.outliers) ++found[outlier.quantity];
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t q) { return !(report.population.usual[q].below > 0); });
  std::ranges::stable_sort(order, {}, [&](std::size_t q) {
    return std::pair(-static_cast<double>(found[q]), report.population.usual[q].drift.probability);
  });
  order.resize(std::min(order.size(), kPanels));
  return order;
}

FigurePanel quantity_panel(const ManyReport& report, std::size_t q) {
  constexpr std::size_t kMostDots = 2000, kMostRings = 300;
  const Quantity& quantity = report.quantities[q];
  const Usual& usual = report.population.usual[q];
  FigurePanel panel{
      .title = quantity.name,
      .x_label = report.folders.has_serials ? "Serial number" : "Number",
      .y_label = quantity.name + (quantity.unit.empty() ? "" : " (" + quantity.unit + ')'),
      .series = {}};

  // As many dampers as a figure shows, evenly over all.
  FigureSeries dots{
      .label = "dampers", .colour = "measured", .mark = FigureSeries::Mark::Dots, .width = 1.5};
  const std::size_t stride = report.rows.size() / kMostDots + 1;
  for (std::size_t k = 0; k < report.rows.size(); k += stride)
    if (const double value = report.values_of(k, q); std::isfinite(value)) {
      dots.x.push_back(report.rows[k].serial);
      dots.y.push_back(value);
      dots.names.push_back(report.rows[k].name);
    }

  // What is expected, and what stands out.
  FigureSeries line{.label = "expected", .colour = "modelled"};
  for (const double serial : {report.rows.front().serial, report.rows.back().serial}) {
    line.x.push_back(serial);
    line.y.push_back(usual.expected(serial));
  }
  FigureSeries rings{
      .label = "stands out", .colour = "series-2", .mark = FigureSeries::Mark::Rings, .width = 4};
  for (const Outlier& outlier : report.population.outliers)
    if (outlier.quantity == q && rings.x.size() < kMostRings) {
      rings.x.push_back(report.rows[outlier.damper].serial);
      rings.y.push_back(outlier.value);
      rings.names.push_back(report.rows[outlier.damper].name);
    }
  panel.series = {std::move(dots), std::move(line), std::move(rings)};
  return panel;
}

DocumentSection population_section(const ManyReport& report) {
  DocumentSection section{"population", "What is usual", {}};
  DocumentTable table{.title = "The population",
                      .columns = {{"quantity"},
                                  {"unit", false, 1},
                                  {"dampers", true, 3},
                                  {"median", true},
                                  {"spread below", true},
                                  {"spread above", true, 2},
                                  {"drift per 1000", true},
                                  {"stand out", true},
                                  {"limit", true, 2},
                                  {"meaning", false, 4, true}},
                      .rows = {}};
  std::vector<std::size_t> found(report.quantities.size());
  for (const Outlier& outlier : report.population.outliers) ++found[outlier.quantity];
  for (std::size_t q = 0; q < report.quantities.size(); ++q) {
    const Quantity& quantity = report.quantities[q];
    const Usual& usual = report.population.usual[q];
    table.rows.push_back({quantity.name, quantity.unit, std::to_string(usual.count),
                          number_text(usual.median, 4), number_text(usual.below),
                          number_text(usual.above), drift_text(usual), std::to_string(found[q]),
                          number_text(report.population.limits[q]), quantity.meaning});
  }
  table.note =
      "Spread: robust standard deviation, from the median absolute deviation or the 10 % and 90 % "
      "points, whichever is larger. Drift: median slope between blocks of dampers, per 1000 serial "
      "numbers, where their order has a probability below 0.1 % by chance (Mann-Kendall). Limit: "
      "of the score, (value - expected) / spread.";
  section.tables.push_back(std::move(table));

  // The quantities over the serial number.
  DocumentFigure figure{.name = "population",
                        .title = "Over the serial number",
                        .caption = "Every damper, what is expected of it, and what stands out.",
                        .panels = {},
                        .columns = 2,
                        .audience = Audience::Files};
  for (const std::size_t q : drawn_quantities(report))
    figure.panels.push_back(quantity_panel(report, q));
  if (!figure.panels.empty()) section.figures.push_back(std::move(figure));
  return section;
}

DocumentSection method_section(const ManyReport& report) {
  DocumentSection section{"how", "How it was done", {}};
  section.paragraphs.push_back(fmt::format(
      "Each damper is fitted by itself ({}). {}", join(report.options.models, ", "),
      report.options.pilot == 0
          ? "Every fit begins from all starts."
          : fmt::format(
                "The first {} are fitted from all starts; the one whose parameters lie in the "
                "middle of theirs is the start of every other fit, which is repeated from all "
                "starts where its error is more than 1.5 times what is usual of the pilot ({} of "
                "these).",
                counted(report.options.pilot, "damper"),
                std::ranges::count_if(report.rows,
                                      [](const DamperRow& row) { return row.restarted; }))));
  section.paragraphs.push_back(fmt::format(
      "A damper stands out where it is farther from what is expected than all but {} % of sound "
      "dampers in any quantity, if these are normal (Student's distribution, an equal part for "
      "each of {} quantities). Quantities that are not normal give more, or fewer.",
      format_number(100 * report.options.false_alarms), report.population.judged_columns));
  return section;
}

}  // namespace

Document many_document(const ManyReport& report) {
  Document document;
  document.title = "Production: " + report.folders.folder.filename().string();
  document.subtitle = join(report.options.models, ", ");
  document.verdict = many_verdict(report);
  document.kind = "production";
  document.sections.push_back(outlier_section(report));
  if (report.fitted() < report.rows.size()) document.sections.push_back(failure_section(report));
  document.sections.push_back(population_section(report));
  document.sections.push_back(method_section(report));
  return document;
}

ColumnTable many_table(const ManyReport& report) {
  ColumnTable table{"dampers", "every damper with its numbers", {}};
  DataColumn names{"damper", "1", "its folder or file", {}}, verdicts{"verdict", "1", "", {}},
      reasons{"reason", "1", "what stands out, with its score; or why there is no result", {}},
      serials{"serial", "1", "its serial number", {}},
      restarted{"restarted", "1", "1: fitted from all starts after all", {}};

  // The words of each damper.
  std::map<std::size_t, std::vector<std::string>> found;
  for (const Outlier& outlier : report.population.outliers)
    found[outlier.damper].push_back(outlier_text(report, outlier));
  for (std::size_t k = 0; k < report.rows.size(); ++k) {
    const DamperRow& row = report.rows[k];
    const auto flagged = found.find(k);
    names.texts.push_back(row.name);
    serials.numbers.push_back(row.serial);
    restarted.numbers.push_back(row.restarted ? 1 : 0);
    verdicts.texts.emplace_back(!row.failure.empty()     ? "no result"
                                : flagged == found.end() ? "ok"
                                                         : "stands out");
    reasons.texts.push_back(!row.failure.empty()     ? row.failure
                            : flagged == found.end() ? ""
                                                     : join(flagged->second, "; "));
  }
  for (DataColumn* column : {&names, &serials, &verdicts, &reasons, &restarted})
    table.columns.push_back(std::move(*column));

  // Its numbers.
  for (std::size_t q = 0; q < report.quantities.size(); ++q) {
    const Quantity& quantity = report.quantities[q];
    DataColumn column{
        quantity.name, quantity.unit.empty() ? "1" : quantity.unit, quantity.meaning, {}};
    for (std::size_t k = 0; k < report.rows.size(); ++k)
      column.numbers.push_back(report.values_of(k, q));
    table.columns.push_back(std::move(column));
  }
  return table;
}

Value many_json(const ManyReport& report) {
  // What is usual among the dampers, and what drifts.
  Value population = Value::array();
  for (std::size_t q = 0; q < report.quantities.size(); ++q) {
    const Quantity& quantity = report.quantities[q];
    const Usual& usual = report.population.usual[q];
    population.push_back(Value::object({{"quantity", quantity.name},
                                        {"unit", quantity.unit},
                                        {"dampers", usual.count},
                                        {"median", any_number(usual.median)},
                                        {"spread_below", usual.below},
                                        {"spread_above", usual.above},
                                        {"limit", any_number(report.population.limits[q])},
                                        {"drifts", usual.drift.is_seen()},
                                        {"drift_per_serial", usual.drift.slope},
                                        {"drift_probability", usual.drift.probability}}));
  }

  // The dampers that stand out, and those without a result.
  Value outliers = Value::array(), failures = Value::array();
  for (const Outlier& outlier : report.population.outliers)
    outliers.push_back(Value::object({{"damper", report.rows[outlier.damper].name},
                                      {"serial", report.rows[outlier.damper].serial},
                                      {"quantity", report.quantities[outlier.quantity].name},
                                      {"value", outlier.value},
                                      {"expected", outlier.expected},
                                      {"score", outlier.score}}));
  for (const DamperRow& row : report.rows)
    if (!row.failure.empty())
      failures.push_back(Value::object({{"damper", row.name}, {"why", row.failure}}));

  return Value::object({{"dampers", report.rows.size()},
                        {"fitted", report.fitted()},
                        {"models", Value::array(report.options.models)},
                        {"false_alarms", report.options.false_alarms},
                        {"population", std::move(population)},
                        {"outliers", std::move(outliers)},
                        {"failures", std::move(failures)}});
}

}  // namespace dashpot
