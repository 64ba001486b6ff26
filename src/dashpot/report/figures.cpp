// The report's figures for print: loops per condition, a force trace, the ranking.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/error.h"
#include "dashpot/rank.h"
#include "dashpot/report/gnuplot.h"
#include "dashpot/report/ranking_words.h"
#include "dashpot/report/report.h"
#include "dashpot/report/series.h"
#include "dashpot/report/words.h"

namespace dashpot {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPointsPerCurve = 3000;
constexpr char kMeasured[] = "#8b949e";
constexpr char kModelled[] = "#0b5cad";
constexpr std::array kLevels = {"#26468a", "#18808a", "#3ca05f", "#d69614", "#be481e"};

/// The colour of one of `count` drive levels: as far apart as the five allow.
GnuplotText level_colour(std::size_t index, std::size_t count) {
  return gnuplot_string(kLevels[count > 1 ? index * (kLevels.size() - 1) / (count - 1) : 0]);
}

std::vector<double> taken(const std::vector<double>& samples,
                          const std::vector<std::size_t>& chosen) {
  std::vector<double> result;
  for (const std::size_t i : chosen) result.push_back(samples[i]);
  return result;
}

/// Columns x, measured, modelled from the end of the warm-up on, thinned for print.
GnuplotText add_curves(GnuplotFigure& figure, const RecordResult& record,
                       const std::vector<double>& x) {
  std::vector<std::size_t> chosen =
      thinned_indices({record.measured, record.modelled}, kPointsPerCurve);
  std::erase_if(chosen, [&](std::size_t i) { return i < record.warm_up; });
  const auto xs = taken(x, chosen), measured = taken(record.measured, chosen),
             modelled = taken(record.modelled, chosen);
  return figure.data({xs, measured, modelled});
}

/// The curves as people see them.
Evaluation as_shown(Evaluation evaluation, const PrintUnits& units) {
  const auto scale = [](std::vector<double>& values, double factor) {
    for (double& value : values) value *= factor;
  };
  for (RecordResult& record : evaluation.records) {
    scale(record.displacement, units.of("m").factor);
    scale(record.velocity, units.of("m/s").factor);
    for (auto* forces : {&record.measured, &record.modelled}) scale(*forces, units.of("N").factor);
  }
  return evaluation;
}

std::string drive_label(const RecordResult& record, const std::string& unit) {
  return record.drive_level ? level_text(*record.drive_level, unit) : record.record;
}

using Series = std::vector<double> RecordResult::*;

/// 1, 2 or 5 times a power of ten: at most five steps over `span`, so that labels do not touch.
double tic_step(double span) {
  if (!(span > 0)) return 1;
  const double power = std::pow(10, std::floor(std::log10(span / 5)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (span / (digit * power) <= 5) return digit * power;
  return 10 * power;
}

/// One panel: loops of the records of one condition; lines are measured, dashes modelled.
void loop_panel(GnuplotFigure& figure, const std::vector<const RecordResult*>& records,
                const std::string& unit, Series axis) {
  // Tics follow the extent of the panel.
  double low = 0, high = 0;
  for (const RecordResult* record : records)
    for (const double value : record->*axis)
      low = std::min(low, value), high = std::max(high, value);
  figure.command(gnuplot("set xtics {}", tic_step(high - low)));

  // Measured loops by level of the drive, the model in one dark dash above.
  std::vector<GnuplotText> measured, modelled;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const GnuplotText data = add_curves(figure, *records[i], records[i]->*axis);
    measured.push_back(gnuplot("{} using 1:2 with lines lw 1.8 lc rgb {} title {}", data,
                               level_colour(i, records.size()),
                               gnuplot_string(drive_label(*records[i], unit))));
    modelled.push_back(gnuplot("{} using 1:3 with lines lw 0.9 dt (8,5) lc rgb '#1c2127' {}", data,
                               i == 0 ? GnuplotText("title 'model'") : GnuplotText("notitle")));
  }
  figure.command("plot " + listed(measured) + ", " + listed(modelled));
}

std::vector<std::vector<const RecordResult*>> by_condition(const Evaluation& evaluation) {
  std::vector<std::vector<const RecordResult*>> groups;
  for (const RecordResult& record : evaluation.records) {
    const auto same = [&](const auto& group) {
      return !record.condition.empty() && group.front()->condition == record.condition;
    };
    const auto found = std::ranges::find_if(groups, same);
    if (found == groups.end())
      groups.push_back({&record});
    else
      found->push_back(&record);
  }
  return groups;
}

/// Panels of all conditions, up to three abreast, at most twelve.
std::vector<fs::path> loops(const Evaluation& shown, const PrintUnits& units,
                            const std::string& drive_unit, Series axis, const fs::path& folder) {
  auto groups = by_condition(shown);
  std::erase_if(groups, [&](const auto& group) {
    return std::ranges::any_of(
        group, [&](const RecordResult* r) { return (r->*axis).size() != r->time.size(); });
  });
  if (groups.empty()) return {};

  // As many panels as a page of paper holds.
  groups.resize(std::min<std::size_t>(groups.size(), 12));
  const std::size_t columns = groups.size() == 4 ? 2 : std::min<std::size_t>(3, groups.size());
  const std::size_t rows = (groups.size() + columns - 1) / columns;
  const bool is_velocity = axis == &RecordResult::velocity;
  GnuplotFigure figure(6.5 * static_cast<double>(columns) + 1, 6.2 * static_cast<double>(rows));
  figure.command(gnuplot("set multiplot layout {},{}", rows, columns));
  figure.command("set ylabel " + gnuplot_string("Force (" + units.of("N").name + ")") +
                 " offset 1,0");
  figure.command("set xlabel " + gnuplot_string(is_velocity
                                                    ? "Velocity (" + units.of("m/s").name + ")"
                                                    : "Displacement (" + units.of("m").name + ")"));

  // One panel per condition.
  for (const auto& group : groups) {
    const RecordResult& first = *group.front();
    figure.command("set title " +
                   gnuplot_string(first.condition.empty() ? first.record : first.condition) +
                   " noenhanced");
    loop_panel(figure, group, drive_unit, axis);
  }
  figure.command("unset multiplot");
  return figure.write(folder, is_velocity ? "force-velocity" : "force-displacement");
}

std::vector<fs::path> force_trace(const RankedModel& model, const RecordResult& record,
                                  const PrintUnits& units, const fs::path& folder) {
  GnuplotFigure figure(16, 7);
  const GnuplotText data = add_curves(figure, record, record.time);
  figure.command("set xrange [] noextend\nset xlabel 'Time (s)'\nset ylabel " +
                 gnuplot_string("Force (" + units.of("N").name + ")"));
  figure.command("set title " + gnuplot_string(record.record) + " noenhanced");
  figure.command(
      gnuplot("plot {0} using 1:2 with lines lw 2 lc rgb '{1}' title 'measured', {0} using 1:3 "
              "with lines lw 1.2 lc rgb '{2}' title {3}",
              data, GnuplotText(kMeasured), GnuplotText(kModelled),
              gnuplot_string(fmt::format("{}, fit {} %", display_name(model),
                                         percent_text(record.metrics.fit)))));
  return figure.write(folder, "force-time");
}

std::vector<fs::path> ranking_bars(const Ranking& ranking, const fs::path& folder) {
  std::vector<double> places, errors;
  std::vector<GnuplotText> tics;
  for (const RankedModel& model : ranking.models) {
    const double esr = model.left_out.pooled.esr;
    if (!std::isfinite(esr) || esr <= 0) continue;
    tics.push_back(gnuplot("{} {}", gnuplot_label(display_name(model)), places.size()));
    places.push_back(static_cast<double>(places.size()));
    errors.push_back(esr);
  }
  if (places.empty()) return {};

  // Horizontal bars, so that long names have room.
  GnuplotFigure figure(12, 1.6 + 0.85 * static_cast<double>(places.size()));
  const GnuplotText data = figure.data({places, errors});
  figure.command("set ytics (" + listed(tics) + ") scale 0 noenhanced\nset yrange [" +
                 gnuplot("{}:-0.6]", static_cast<double>(places.size()) - 0.4));
  figure.command(
      "unset key\nset grid noytics\nset xlabel 'Left-out error, ESR (%)'\nset rmargin 8\nset "
      "bmargin 3.2");
  figure.command(
      gnuplot("set xrange [0:*]\nplot {0} using (0.5*$2):1:(0.5*$2):(0.34) with boxxyerror lc "
              "rgb '{1}', {0} using 2:1:(sprintf('%.3g',$2)) with labels left offset 0.5,0",
              data, GnuplotText(kModelled)));
  return figure.write(folder, "ranking");
}

}  // namespace

std::vector<fs::path> write_figures(const ReportInput& input, const fs::path& folder) {
  const auto usable = [](const RankedModel& m) { return !m.left_out.records.empty(); };
  const auto best = std::ranges::find_if(input.ranking.models, usable);
  if (best == input.ranking.models.end())
    throw Error("figures", "no model was judged on any record");
  const Evaluation shown = as_shown(best->left_out, input.units);
  const auto& records = shown.records;
  const auto worst = std::ranges::find(records, best->left_out.worst_record,
                                       [](const auto& r) { return r.record; });

  std::vector<fs::path> paths;
  const auto add = [&](std::vector<fs::path> more) {
    paths.insert(paths.end(), more.begin(), more.end());
  };
  add(ranking_bars(input.ranking, folder));
  const std::string drive_unit = to_string(input.dataset.drive_unit);
  for (const Series axis : {&RecordResult::velocity, &RecordResult::displacement})
    add(loops(shown, input.units, drive_unit, axis, folder));
  add(force_trace(*best, worst == records.end() ? records.front() : *worst, input.units, folder));
  return paths;
}

}  // namespace dashpot
