// A sweep for programs: tables and JSON.
#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/report/sweep_report.h"
#include "dashpot/suspension/sweep/statistics.h"

namespace dashpot {
namespace {

/// A table that is filled row by row: texts first, then numbers.
class Rows {
 public:
  Rows(std::string name, std::string title) : table_{std::move(name), std::move(title), {}} {}

  void text_column(const std::string& name, const std::string& meaning) {
    table_.columns.push_back({name, "1", meaning, {}});
    ++texts_;
  }
  void column(const std::string& name, const std::string& unit, const std::string& meaning) {
    table_.columns.push_back({name, unit, meaning, {}});
  }
  void row(const std::vector<std::string>& texts, const std::vector<double>& numbers) {
    for (std::size_t k = 0; k < texts_; ++k) table_.columns[k].texts.push_back(texts[k]);
    for (std::size_t k = 0; k < numbers.size(); ++k)
      table_.columns[texts_ + k].numbers.push_back(numbers[k]);
  }
  ColumnTable take() { return std::move(table_); }

 private:
  ColumnTable table_;
  std::size_t texts_ = 0;
};

ColumnTable ride_table(const Sweep& sweep) {
  const SweepRequest& request = sweep.request;
  Rows rows("rides", "every vehicle under every controller");
  rows.text_column("controller", "what drives the vehicle");

  // Inputs in words come before those in numbers.
  std::vector<std::size_t> words, numbers;
  for (std::size_t k = 0; k < request.inputs.size(); ++k)
    (request.inputs[k].words.empty() ? numbers : words).push_back(k);
  for (const std::size_t k : words)
    rows.text_column(request.inputs[k].name, request.inputs[k].meaning);
  rows.column("vehicle", "1", "its number, from 0 on");
  rows.column("road_seed", "1", "of the road's random numbers");
  for (const std::size_t k : numbers)
    rows.column(request.inputs[k].name, request.inputs[k].unit, request.inputs[k].meaning);
  for (const SweepMeasure& measure : sweep_measures()) {
    const SweepMeasure& m = as_driven(measure, sweep.drive);
    rows.column(std::string(m.name), std::string(m.unit),
                std::string(m.title) + ": " + std::string(m.meaning));
  }

  // A row per vehicle and controller.
  for (std::size_t v = 0; v < sweep.vehicles.size(); ++v)
    for (std::size_t c = 0; c < request.controllers.size(); ++c) {
      const SweepDraw& draw = sweep.vehicles[v];
      std::vector<std::string> texts{request.controllers[c].name};
      for (const std::size_t k : words) texts.push_back(request.inputs[k].text_of(draw.values[k]));
      std::vector<double> figures{static_cast<double>(draw.vehicle),
                                  static_cast<double>(draw.road_seed)};
      for (const std::size_t k : numbers) figures.push_back(draw.values[k]);
      for (const SweepMeasure& m : sweep_measures()) figures.push_back(sweep.rides[c][v].*m.field);
      rows.row(texts, figures);
    }
  return rows.take();
}

void add_spread_columns(Rows& rows) {
  rows.text_column("controller", "what drives the vehicle");
  rows.text_column("measure", "of what");
  rows.text_column("unit", "of the quantiles");
  rows.column("count", "1", "vehicles that count");
  rows.column("mean", "1", "in the row's unit");
  rows.column("deviation", "1", "standard deviation, in the row's unit");
  for (const double share : kSweepShares) {
    const std::string name = "q" + format_number(100 * share),
                      percent = format_number(100 * share) + " %";
    rows.column(name, "1", "below it lie " + percent);
    rows.column(name + "_low", "1", "lower end of its 95 % interval");
    rows.column(name + "_high", "1", "upper end of its 95 % interval");
  }
}

std::vector<double> figures_of(const SweepSpread& spread) {
  std::vector<double> figures{static_cast<double>(spread.count), spread.mean, spread.deviation};
  for (const Quantile& q : spread.quantiles)
    figures.insert(figures.end(), {q.value, q.low.value_or(kNoNumber), q.high.value_or(kNoNumber)});
  return figures;
}

ColumnTable quantile_table(const Sweep& sweep) {
  Rows rows("quantiles", "of each measure over all vehicles");
  add_spread_columns(rows);
  for (std::size_t c = 0; c < sweep.rides.size(); ++c)
    for (const SweepMeasure& m : judged_measures())
      if (const auto spread = spread_of(measure_values(sweep, c, m)))
        rows.row({sweep.request.controllers[c].name, std::string(m.name),
                  std::string(as_driven(m, sweep.drive).unit)},
                 figures_of(*spread));
  return rows.take();
}

ColumnTable ratio_table(const Sweep& sweep) {
  const SweepRequest& request = sweep.request;
  Rows rows("ratios", "of each measure to that under " +
                          request.controllers[request.baseline].name + ", vehicle by vehicle");
  add_spread_columns(rows);
  for (std::size_t c = 0; c < sweep.rides.size(); ++c) {
    if (c == request.baseline) continue;
    for (const SweepMeasure& m : judged_measures())
      if (const auto spread = spread_of(baseline_ratios(sweep, c, m)))
        rows.row({request.controllers[c].name, std::string(m.name), "1"}, figures_of(*spread));
  }
  return rows.take();
}

ColumnTable correlation_table(const Sweep& sweep) {
  Rows rows("correlations", "rank correlation (Spearman) of each input with each measure");
  rows.text_column("controller", "what drives the vehicle");
  rows.text_column("input", "what varies");
  rows.text_column("measure", "with what");
  rows.column("correlation", "1", "-1 ... 1");
  for (std::size_t c = 0; c < sweep.rides.size(); ++c)
    for (std::size_t k = 0; k < sweep.request.inputs.size(); ++k)
      for (const SweepMeasure& m : judged_measures())
        if (const auto rho = rank_correlation(input_values(sweep, k), measure_values(sweep, c, m)))
          rows.row({sweep.request.controllers[c].name, sweep.request.inputs[k].name,
                    std::string(m.name)},
                   {*rho});
  return rows.take();
}

Value table_value(const ColumnTable& table) {
  Value rows = Value::array();
  for (std::size_t r = 0; r < table.rows(); ++r) {
    Value row = Value::object();
    for (const DataColumn& column : table.columns)
      row.add(column.name, column.is_text() ? Value(column.texts[r]) : Value(column.numbers[r]));
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::vector<ColumnTable> sweep_tables(const Sweep& sweep) {
  return {ride_table(sweep), quantile_table(sweep), ratio_table(sweep), correlation_table(sweep)};
}

Value sweep_json(const Sweep& sweep) {
  Value controllers = Value::array(), notes = Value::array(sweep.notes);
  for (std::size_t c = 0; c < sweep.rides.size(); ++c)
    controllers.push_back(Value::object(
        {{"name", sweep.request.controllers[c].name}, {"diverged", diverged_rides(sweep, c)}}));

  // Single rides are left to the tables.
  return Value::object({{"name", sweep.request.name},
                        {"vehicles", sweep.vehicles.size()},
                        {"baseline", sweep.request.controllers[sweep.request.baseline].name},
                        {"controllers", std::move(controllers)},
                        {"quantiles", table_value(quantile_table(sweep))},
                        {"ratios", table_value(ratio_table(sweep))},
                        {"correlations", table_value(correlation_table(sweep))},
                        {"notes", std::move(notes)},
                        {"kept_rides", sweep.kept},
                        {"wall_seconds", sweep.wall_seconds}});
}

}  // namespace dashpot
