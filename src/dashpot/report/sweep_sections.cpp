// Tables and figures of a sweep's page.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/ride_parts.h"
#include "dashpot/report/sweep_parts.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

constexpr std::size_t kCurvePoints = 200;

/// "0.871 (0.868-0.874)"
std::string with_interval(const Quantile& q, const ShownMeasure& shown) {
  const std::string value = shown.text(q.value);
  return q.low && q.high
             ? fmt::format("{} ({} ... {})", value, shown.text(*q.low), shown.text(*q.high))
             : value;
}

std::vector<TextColumn> quantile_columns(const std::string& first) {
  std::vector<TextColumn> columns{{first}, {"Controller"}};
  for (const double share : kSweepShares)
    columns.push_back(
        {format_number(100 * share) + " %", true, share == 0.25 || share == 0.75 ? 1 : 0});
  columns.push_back({"Median with interval", true, 2});
  return columns;
}

std::vector<std::string> quantile_row(const std::string& first, const std::string& controller,
                                      const SweepSpread& spread, const ShownMeasure& shown) {
  std::vector<std::string> row{first, controller};
  for (const Quantile& q : spread.quantiles) row.push_back(shown.text(q.value));
  row.push_back(with_interval(spread.quantiles[kSweepShares.size() / 2], shown));
  return row;
}

/// The share of vehicles below each value, as a curve.
FigureSeries quantile_curve(std::vector<double> values, double factor, FigureSeries series) {
  const std::vector<double> sorted = sorted_finite(std::move(values));
  const std::size_t points = std::min(sorted.size(), kCurvePoints);
  for (std::size_t k = 0; k < points; ++k) {
    const double share =
        points > 1 ? static_cast<double>(k) / static_cast<double>(points - 1) : 0.5;
    series.x.push_back(
        factor * sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))]);
    series.y.push_back(100 * share);
  }
  return series;
}

using Pairs = std::vector<std::pair<double, double>>;

/// Pairs of equal x where there are few x; else bins of equally many. Rising.
std::vector<Pairs> binned(Pairs pairs) {
  constexpr std::size_t kMostBins = 12, kFewest = 20;
  std::ranges::sort(pairs);
  std::vector<Pairs> bins;
  for (const auto& pair : pairs) {
    if (bins.empty() || bins.back().front().first != pair.first) bins.emplace_back();
    bins.back().push_back(pair);
  }
  if (bins.size() <= kMostBins) return bins;
  bins.assign(std::clamp(pairs.size() / kFewest, std::size_t{1}, kMostBins), {});
  for (std::size_t k = 0; k < pairs.size(); ++k)
    bins[k * bins.size() / pairs.size()].push_back(pairs[k]);
  return bins;
}

/// Median and the middle 90 % of y over x.
void add_trend(FigurePanel& panel, const std::vector<double>& x, const std::vector<double>& y,
               FigureSeries middle) {
  Pairs pairs;
  for (std::size_t k = 0; k < x.size(); ++k)
    if (std::isfinite(y[k])) pairs.emplace_back(x[k], y[k]);
  middle.width = 2.2;
  FigureSeries low = middle;
  low.label = "";
  low.width = 0.8;
  FigureSeries high = low;

  // One point of each curve per bin, at its middle.
  for (const Pairs& bin : binned(std::move(pairs))) {
    std::vector<double> ys;
    for (const auto& pair : bin) ys.push_back(pair.second);
    std::ranges::sort(ys);
    for (const auto& [series, share] : {std::pair{&middle, 0.5}, {&low, 0.05}, {&high, 0.95}}) {
      series->x.push_back(bin[bin.size() / 2].first);
      series->y.push_back(quantile_of(ys, share).value);
    }
  }
  for (FigureSeries* series : {&middle, &low, &high}) panel.series.push_back(std::move(*series));
}

/// An input with its greatest rank correlation with any of the main measures, greatest first.
struct Weight {
  std::size_t input;
  double greatest;
};
std::vector<Weight> weights_of(const Sweep& sweep) {
  std::vector<Weight> weights;
  for (std::size_t k = 0; k < sweep.request.inputs.size(); ++k) {
    Weight weight{k, 0};
    for (std::size_t c = 0; c < sweep.rides.size(); ++c)
      for (const ShownMeasure& shown : main_measures(sweep))
        if (const auto rho =
                rank_correlation(input_values(sweep, k), measure_values(sweep, c, *shown.measure)))
          weight.greatest = std::max(weight.greatest, std::abs(*rho));
    weights.push_back(weight);
  }
  std::ranges::stable_sort(weights, std::greater{}, &Weight::greatest);
  return weights;
}

/// "-0.64"; without the sign of what is 0 as it is printed.
std::string correlation_text(double rho) {
  const std::string text = fmt::format("{:.2f}", rho);
  return text == "-0.00" ? "0.00" : text;
}

DocumentTable correlation_table(const Sweep& sweep, std::size_t c,
                                const std::vector<Weight>& weights) {
  const std::vector<ShownMeasure> measures = shown_measures(sweep);
  DocumentTable table{sweep.request.controllers[c].name, {{"Input"}}, {}};
  int priority = 0;
  for (const ShownMeasure& shown : measures)
    table.columns.push_back({shown.name, true, priority++});

  // Inputs by their weight, strongest first.
  for (const Weight& weight : weights) {
    std::vector<std::string> row{sweep.request.inputs[weight.input].name};
    for (const ShownMeasure& shown : measures) {
      const auto rho = rank_correlation(input_values(sweep, weight.input),
                                        measure_values(sweep, c, *shown.measure));
      row.push_back(rho ? correlation_text(*rho) : "-");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

DocumentFigure trend_figure(const Sweep& sweep, const std::vector<Weight>& weights) {
  constexpr std::size_t kMost = 2;
  DocumentFigure figure{
      "trends",
      "The inputs that matter most",
      "Median (thick) and 5 and 95 % (thin) of the vehicles, in bins of equally many.",
      {},
      2};

  // One panel per input and main measure, one trend per controller.
  for (std::size_t i = 0; i < std::min(kMost, weights.size()); ++i) {
    const SweepInput& input = sweep.request.inputs[weights[i].input];
    for (const ShownMeasure& shown : main_measures(sweep)) {
      FigurePanel panel{
          "", input.name + (input.unit == "1" ? "" : " (" + input.unit + ")"), shown.title(), {}};
      panel.places = input.words;
      for (std::size_t c = 0; c < sweep.rides.size(); ++c) {
        std::vector<double> values = measure_values(sweep, c, *shown.measure);
        for (double& value : values) value *= shown.factor;
        add_trend(panel, input_values(sweep, weights[i].input), values,
                  controller_look(sweep.request.controllers[c].name, c));
      }
      figure.panels.push_back(std::move(panel));
    }
  }
  return figure;
}

/// The places of the grid that vehicles 0, 1, ... stand at, in words.
std::string place_text(const Sweep& sweep, std::size_t place) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < sweep.request.inputs.size(); ++k) {
    const SweepInput& input = sweep.request.inputs[k];
    if (!input.on_grid) continue;
    parts.push_back(input.name + ' ' + input.text_of(sweep.vehicles[place].values[k]) +
                    (input.unit == "1" ? "" : ' ' + input.unit));
  }
  return join(parts, ", ");
}

}  // namespace

DocumentSection input_section(const Sweep& sweep) {
  DocumentSection section{"inputs", "What varies", {}};
  DocumentTable table{"Inputs", {{"Input"}, {"How"}, {"Meaning", false, 1, true}}, {}};
  for (const SweepInput& input : sweep.request.inputs)
    table.rows.push_back({input.name,
                          input.description() + (input.on_grid ? ", each with every sample" : ""),
                          input.meaning});
  section.tables.push_back(std::move(table));
  return section;
}

DocumentSection ratio_section(const Sweep& sweep) {
  const SweepRequest& request = sweep.request;
  const std::string& base = request.controllers[request.baseline].name;
  DocumentSection section{"ratios", "Against " + base, {}};
  section.paragraphs.push_back("Ratio to what the same vehicle does on the same road under " +
                               base + "; below 1 is less.");
  DocumentTable table{"Ratios, vehicle by vehicle", quantile_columns("Measure"), {}};
  table.columns.push_back({"Less on", true, 1});
  DocumentFigure figure{"ratios",
                        "Ratios to " + base,
                        "The share of the vehicles whose ratio is below that on the axis.",
                        {},
                        2};

  // A row and a curve for each measure and controller.
  for (const ShownMeasure& measure : shown_measures(sweep)) {
    const ShownMeasure shown{measure.measure, measure.name, "1"};
    FigurePanel panel{shown.name, "ratio", "share of the vehicles (%)", {}};
    for (std::size_t c = 0; c < sweep.rides.size(); ++c) {
      if (c == request.baseline) continue;
      const std::string& name = request.controllers[c].name;
      const std::vector<double> ratios = sorted_finite(baseline_ratios(sweep, c, *shown.measure));
      const auto spread = spread_of(ratios);
      if (!spread) continue;
      const auto less = static_cast<double>(std::ranges::lower_bound(ratios, 1.0) - ratios.begin());
      table.rows.push_back(quantile_row(shown.name, name, *spread, shown));
      // There is no ratio to a measure that is 0, as the time without contact.
      const std::size_t all = sweep.rides[c].size();
      table.rows.back().push_back(
          number_text(100 * less / static_cast<double>(ratios.size())) + " %" +
          (ratios.size() < all ? " of " + std::to_string(ratios.size()) : ""));
      panel.series.push_back(quantile_curve(ratios, 1, controller_look(name, c)));
    }

    // Only comfort and road holding are drawn.
    const auto main = main_measures(sweep);
    if (std::ranges::any_of(main,
                            [&](const ShownMeasure& one) { return one.measure == shown.measure; }))
      figure.panels.push_back(std::move(panel));
  }
  section.tables.push_back(std::move(table));
  section.figures.push_back(std::move(figure));
  return section;
}

DocumentSection quantile_section(const Sweep& sweep) {
  DocumentSection section{"quantiles", "Quantiles over all vehicles", {}};
  DocumentTable table{"Each measure over all vehicles", quantile_columns("Measure"), {}};
  DocumentFigure figure{"quantiles",
                        "Quantiles",
                        "The share of the vehicles that stay below the value on the axis.",
                        {},
                        2};

  // A row and a curve for each measure and controller.
  for (const ShownMeasure& shown : shown_measures(sweep)) {
    FigurePanel panel{shown.name, shown.title(), "share of the vehicles (%)", {}};
    for (std::size_t c = 0; c < sweep.rides.size(); ++c) {
      const std::string& name = sweep.request.controllers[c].name;
      const std::vector<double> values = measure_values(sweep, c, *shown.measure);
      if (const auto spread = spread_of(values))
        table.rows.push_back(quantile_row(shown.title(), name, *spread, shown));
      panel.series.push_back(quantile_curve(values, shown.factor, controller_look(name, c)));
    }
    figure.panels.push_back(std::move(panel));
  }
  section.tables.push_back(std::move(table));
  section.figures.push_back(std::move(figure));
  section.remarks = sweep.notes;
  return section;
}

DocumentSection grid_section(const Sweep& sweep) {
  DocumentSection section{"grid", "At each place of the grid", {}};

  // Vehicles of one place stand a whole grid apart.
  for (const ShownMeasure& shown : main_measures(sweep)) {
    DocumentTable table{shown.title(), quantile_columns("Place"), {}};
    for (std::size_t place = 0; place < sweep.request.grid_size(); ++place)
      for (std::size_t c = 0; c < sweep.rides.size(); ++c) {
        std::vector<double> values;
        for (std::size_t v = place; v < sweep.vehicles.size(); v += sweep.request.grid_size())
          values.push_back(sweep.rides[c][v].*shown.measure->field);
        if (const auto spread = spread_of(std::move(values)))
          table.rows.push_back(quantile_row(place_text(sweep, place),
                                            sweep.request.controllers[c].name, *spread, shown));
      }
    section.tables.push_back(std::move(table));
  }
  return section;
}

DocumentSection sensitivity_section(const Sweep& sweep) {
  DocumentSection section{"sensitivity", "What matters", {}};
  const std::vector<Weight> weights = weights_of(sweep);
  section.paragraphs.push_back(fmt::format(
      "Rank correlation (Spearman) of each input with each measure, -1 ... 1, strongest first; "
      "chance alone reaches {:.2f} in one of twenty. Each road's own chance is not an input.",
      chance_correlation(sweep.vehicles.size())));
  for (std::size_t c = 0; c < sweep.rides.size(); ++c)
    section.tables.push_back(correlation_table(sweep, c, weights));
  section.figures.push_back(trend_figure(sweep, weights));
  return section;
}

}  // namespace dashpot
