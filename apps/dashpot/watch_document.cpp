#include "watch_document.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/machine/found_noise.h"
#include "dashpot/numerics/distributions.h"
#include "dashpot/report/quantity.h"

namespace dashpot::cli {
namespace {

bool is_share(const WatchedQuantity& q) { return q.unit == "1"; }

/// An amount as people see it: a share in percent.
std::string amount_text(const WatchedQuantity& q, double value, int digits = 3) {
  return is_share(q) ? format_number(100 * value, digits) : quantity(value, q.unit, digits);
}
std::string amount_unit(const WatchedQuantity& q) { return is_share(q) ? "%" : unit_name(q.unit); }

/// The unit of a number of the plant.
std::string_view unknown_unit(const Watched& watched, const PlantUnknown& unknown) {
  const PlantModel& model = *watched.plant.setup.model;
  return model.parameters[row_named(model.parameters, unknown.name, model.name, "plant")].unit;
}

bool has_several(const Watched& watched) { return watched.plant.dampers.size() > 1; }

/// Days that the charts take.
std::size_t days_that_count(const Watched& watched) {
  return static_cast<std::size_t>(std::ranges::count_if(
      watched.days, [](const WatchedDay& day) { return day.estimate.converged; }));
}

/// On a terminal: the last days, and those with an alarm.
std::vector<std::size_t> rows_in_brief(const Watched& watched) {
  constexpr std::size_t kLast = 15;
  std::vector<std::size_t> rows;
  for (std::size_t d = 0; d < watched.days.size(); ++d) {
    const bool is_alarm = std::ranges::any_of(
        watched.quantities, [&](const WatchedQuantity& q) { return q.chart.alarm == d; });
    if (is_alarm || d + kLast >= watched.days.size()) rows.push_back(d);
  }
  return rows;
}

/// Three columns per quantity, one per unknown of the plant.
std::vector<TextColumn> day_columns(const Watched& watched) {
  std::vector<TextColumn> columns = {{"day", false, 0, true}};
  for (const WatchedQuantity& q : watched.quantities) {
    columns.push_back({q.name + ", " + amount_unit(q), true});
    columns.push_back({"±", true, 2, false, "95 %, of the day by itself"});
    columns.push_back({"sum", true, 1, false, "of the chart; an alarm above its threshold"});
  }
  for (const PlantUnknown& unknown : watched.plant.setup.unknown)
    columns.push_back({unknown.name + ", " + unit_name(unknown_unit(watched, unknown)), true, 3});
  columns.push_back({"remark"});
  return columns;
}

/// The cells of day_columns().
std::vector<std::string> day_row(const Watched& watched, std::size_t d) {
  const DayEstimate& day = watched.days[d].estimate;
  std::vector<std::string> row = {day.name};
  for (const WatchedQuantity& q : watched.quantities) {
    row.push_back(amount_text(q, day.wear[q.place]));
    row.push_back(amount_text(q, kNormal95 * day.wear_deviation[q.place], 2));
    row.push_back(!watched.is_judged(d) ? "" : format_number(q.chart.points[d].sum, 3));
  }
  for (std::size_t k = 0; k < day.plant.size(); ++k)
    row.push_back(quantity(day.plant[k], unknown_unit(watched, watched.plant.setup.unknown[k]), 4));
  row.push_back(watched.remark(d));
  return row;
}

DocumentTable day_table(const Watched& watched) {
  DocumentTable table{.title = "By day", .columns = day_columns(watched), .rows = {}};
  for (std::size_t d = 0; d < watched.days.size(); ++d) {
    table.rows.push_back(day_row(watched, d));
    table.warnings.push_back(table.rows.back().back().starts_with("ALARM"));
  }
  table.brief = rows_in_brief(watched);
  table.note =
      std::string(has_several(watched) ? "Amounts by which each damper differs from its model"
                                       : "Amounts by which the damper differs from its model") +
      ", with what the day itself leaves open (95 %). 'sum' is the chart's: healthy days keep it "
      "near 0.";
  return table;
}

std::string state_of(const Watched& watched, const WatchedQuantity& q) {
  if (q.chart.alarm) return "alarm at " + watched.days[*q.chart.alarm].estimate.name;
  return days_that_count(watched) <= watched.options.chart.reference ? "learns" : "healthy";
}

DocumentTable chart_table(const Watched& watched) {
  DocumentTable table{.title = "Where they stand",
                      .columns = {{"quantity"},
                                  {"expected", true},
                                  {"scatter of days", true},
                                  {"sum", true},
                                  {"alarm above", true},
                                  {"state"}},
                      .rows = {}};
  for (const WatchedQuantity& q : watched.quantities) {
    const ChartPoint& last = q.chart.points.back();
    const bool is_learnt = last.scatter > 0;
    table.rows.push_back({q.name + ", " + amount_unit(q),
                          is_learnt ? amount_text(q, last.expected) : "-",
                          is_learnt ? amount_text(q, last.scatter, 2) : "-",
                          is_learnt ? format_number(last.sum, 3) : "-",
                          format_number(q.chart.threshold, 3), state_of(watched, q)});
    table.warnings.push_back(q.chart.alarm.has_value());
  }

  table.note = fmt::format(
      "Healthy days that are independent and normally distributed give a false alarm once in {} "
      "days on average, all charts {}together. Scatter: what is to be expected of the next day, "
      "learnt from those before.",
      format_number(watched.options.chart.days), has_several(watched) ? "of all dampers " : "");
  return table;
}

/// How well a day of the first ones tells the dampers apart.
DocumentTable outlook_table(const Watched& watched) {
  DocumentTable table{.title = "What a day can tell",
                      .columns = {{"quantity"},
                                  {"±, of a day", true},
                                  {"±, the others known", true},
                                  {"most like"}},
                      .rows = {}};
  for (std::size_t a = 0; a < watched.plant.outlook.size(); ++a) {
    const WearOutlook& one = watched.plant.outlook[a];
    const WatchedQuantity& q = watched.quantities[a];
    table.rows.push_back(
        {q.name + ", " + amount_unit(q), amount_text(q, kNormal95 * one.deviation, 2),
         amount_text(q, kNormal95 * one.alone, 2), watched.quantities[one.like].name});
  }
  table.note =
      "95 %, found on the first days. A number that is several times the one beside it is hardly "
      "told from the amount that it is most like.";
  return table;
}

std::vector<double> day_numbers(const Watched& watched) {
  std::vector<double> numbers;
  for (std::size_t d = 0; d < watched.days.size(); ++d)
    numbers.push_back(static_cast<double>(d + 1));
  return numbers;
}

/// A quantity by day, between the bounds in which it was expected.
FigurePanel value_panel(const Watched& watched, const WatchedQuantity& q) {
  const double factor = is_share(q) ? 100 : 1;
  const std::string label = q.name + (is_share(q) ? ", %" : "");

  // What was estimated, and both edges of what was expected.
  FigureSeries dots{.label = "estimated",
                    .colour = "measured",
                    .x = day_numbers(watched),
                    .mark = FigureSeries::Mark::Dots,
                    .width = 2.5};
  FigureSeries lower{.label = "expected, 95 %",
                     .colour = "modelled",
                     .mark = FigureSeries::Mark::Dashes,
                     .is_read = false};
  FigureSeries upper = lower;

  // Day by day; the first ones expect nothing yet.
  for (std::size_t d = 0; d < watched.days.size(); ++d) {
    const ChartPoint& point = q.chart.points[d];
    dots.y.push_back(factor * watched.days[d].estimate.wear[q.place]);
    dots.names.push_back(watched.days[d].estimate.name);
    if (!(point.scatter > 0)) continue;
    for (FigureSeries* edge : {&lower, &upper}) edge->x.push_back(dots.x[d]);
    lower.y.push_back(factor * (point.expected - kNormal95 * point.scatter));
    upper.y.push_back(factor * (point.expected + kNormal95 * point.scatter));
  }
  return {.title = label,
          .x_label = "day",
          .y_label = label,
          .series = {std::move(lower), std::move(upper), std::move(dots)},
          .reads_along_x = true,
          .y_unit = is_share(q) ? "" : q.unit};
}

/// The chart's sum by day, and its threshold.
FigurePanel sum_panel(const Watched& watched, const WatchedQuantity& q) {
  FigurePanel panel{.title = "sum of " + q.name,
                    .x_label = "day",
                    .y_label = "sum",
                    .series = {},
                    .reads_along_x = true};
  FigureSeries sum{.label = "sum", .colour = "measured", .x = day_numbers(watched)};
  for (const ChartPoint& point : q.chart.points) sum.y.push_back(point.sum);
  FigureSeries threshold{.label = "alarm above",
                         .colour = "series-4",
                         .x = {sum.x.front(), sum.x.back()},
                         .y = {q.chart.threshold, q.chart.threshold},
                         .mark = FigureSeries::Mark::Dashes};
  panel.series = {std::move(sum), std::move(threshold)};
  return panel;
}

DocumentFigure chart_figure(const Watched& watched) {
  DocumentFigure figure{
      .name = "charts",
      .title = "Amounts and sums",
      .caption =
          "By day: the amount, and between which bounds the days before had led to expect "
          "it; the chart's sum and its threshold.",
      .panels = {},
      .columns = 2};
  for (const WatchedQuantity& q : watched.quantities) {
    figure.panels.push_back(value_panel(watched, q));
    figure.panels.push_back(sum_panel(watched, q));
  }
  return figure;
}

/// "the damper's whole force has fallen by 12 ± 3 % since ..."
std::string alarm_text(const Watched& watched, const WatchedQuantity& q) {
  return fmt::format("{} has fallen by {} ± {} {} since {} (95 %); the alarm came at {}", q.meaning,
                     amount_text(q, q.chart.fall),
                     amount_text(q, kNormal95 * q.chart.fall_deviation, 2), amount_unit(q),
                     watched.days[q.chart.since].estimate.name,
                     watched.days[*q.chart.alarm].estimate.name);
}

bool is_judged(const Watched& watched, std::size_t day) {
  return std::ranges::all_of(watched.quantities,
                             [day](const auto& q) { return q.chart.points[day].is_judged; });
}

/// The days that all charts judged, and those behind the reference days that they could not.
struct JudgedDays {
  std::size_t judged = 0, unjudged = 0;
};
JudgedDays judged_days(const Watched& watched) {
  JudgedDays days;
  std::size_t teaching = 0;
  for (std::size_t d = 0; d < watched.days.size(); ++d) {
    const DayEstimate& day = watched.days[d].estimate;
    if (is_judged(watched, d))
      ++days.judged;
    else if (day.converged && day.excitation > 0 && ++teaching > watched.options.chart.reference)
      ++days.unjudged;
  }
  return days;
}

std::string verdict_of(const Watched& watched) {
  const WatchedQuantity* alarm = watched.first_alarm();
  const std::size_t count = days_that_count(watched), reference = watched.options.chart.reference;
  const auto [judged, unjudged] = judged_days(watched);
  std::string verdict;
  if (alarm)
    verdict = "ALARM: " + alarm_text(watched, *alarm) + '.';
  else if (count <= reference)
    verdict =
        fmt::format("{} of {} reference days are there: nothing is judged yet.", count, reference);
  else
    verdict =
        fmt::format("No alarm on {} behind {} reference days.", counted(judged, "day"), reference);
  if (!alarm && unjudged > 0)
    verdict += unjudged == 1
                   ? " One day was not judged: what is known of it had never varied before."
                   : fmt::format(
                         " {} days were not judged: what is known of them had never "
                         "varied before.",
                         unjudged);

  // How often it is wrong, and the days that it knows nothing of.
  verdict += fmt::format(
      " False alarms{}: one in {} days on average, where healthy days are independent and normal.",
      has_several(watched) ? " of any damper" : "", format_number(watched.options.chart.days));
  if (const std::size_t others = watched.days.size() - count; others > 0)
    verdict += fmt::format(" {} not count: no wear was found under which the sensors are likely.",
                           others == 1 ? "One day does" : std::to_string(others) + " days do");
  if (!watched.left_out.empty())
    verdict += fmt::format(" {} left out: no day could be read there.",
                           watched.left_out.size() == 1
                               ? "One recording was"
                               : counted(watched.left_out.size(), "recording") + " were");
  return verdict;
}

/// Titles of the rows of watch_csv().
std::string csv_titles(const Watched& watched, const PrintUnits& units) {
  std::string text = "day";
  for (const WatchedQuantity& q : watched.quantities) {
    const std::string unit = is_share(q) ? "" : " [" + units.of(q.unit).name + "]";
    text += ',' + q.name + unit + ',' + q.name + "_deviation" + unit + ',' + q.name + "_expected" +
            unit + ',' + q.name + "_scatter" + unit + ',' + q.name + "_score," + q.name + "_sum";
  }
  for (const PlantUnknown& unknown : watched.plant.setup.unknown)
    text += ',' + unknown.name + " [" + units.of(unknown_unit(watched, unknown)).name + "]";
  for (const std::string& name : watched.options.known) text += ',' + name;
  return text + ",remark\n";
}

}  // namespace

Document watch_document(const Watched& watched, const PrintUnits& units) {
  Document document{.title = has_several(watched) ? "Dampers watched from day to day"
                                                  : "A damper watched from day to day",
                    .subtitle = std::string(watched.plant.setup.model->title),
                    .verdict = {},
                    .sections = {},
                    .kind = "watch",
                    .units = units};
  document.verdict = verdict_of(watched);

  // The charts, with the alarms behind the first one, before the days that they stand on.
  DocumentSection charts{.name = "charts", .title = "Charts", .paragraphs = {}};
  for (const WatchedQuantity& q : watched.quantities)
    if (q.chart.alarm && &q != watched.first_alarm())
      charts.remarks.push_back("Also: " + alarm_text(watched, q) + ".");
  for (const std::string& doubt : hardly_apart(watched.plant))
    charts.remarks.push_back("In doubt: " + doubt + ".");
  for (const std::string& day : odd_days(watched.quantities, watched.days))
    charts.remarks.push_back("In doubt: " + day + ".");
  for (const std::string& why : watched.left_out)
    charts.remarks.push_back("Left out: " + why + ".");
  if (const std::string noise = identified_noise_words(watched.plant.setup, units); !noise.empty())
    charts.remarks.push_back(noise);
  charts.tables = {chart_table(watched)};
  if (has_several(watched)) charts.tables.push_back(outlook_table(watched));
  charts.figures = {chart_figure(watched)};
  DocumentSection days{.name = "days", .title = "Days", .paragraphs = {}};
  days.tables = {day_table(watched)};
  document.sections = {std::move(charts), std::move(days)};
  document.data = to_json(watched);
  return document;
}

std::string watch_csv(const Watched& watched, const PrintUnits& units) {
  std::string text = csv_titles(watched, units);
  for (std::size_t d = 0; d < watched.days.size(); ++d) {
    const WatchedDay& day = watched.days[d];
    const auto add = [&](double value) { text += ',' + format_number(value, 9); };

    // What is watched in its unit; scores and sums have none.
    text += csv_field(day.estimate.name);
    for (const WatchedQuantity& q : watched.quantities) {
      const ChartPoint& point = q.chart.points[d];
      const double factor = units.of(q.unit).factor;
      for (const double value : {day.estimate.wear[q.place], day.estimate.wear_deviation[q.place],
                                 point.expected, point.scatter})
        add(factor * value);
      add(point.score);
      add(point.sum);
    }

    // Beside it the plant's numbers, what is known of the day, and what is said of it.
    for (std::size_t k = 0; k < day.estimate.plant.size(); ++k)
      add(units.of(unknown_unit(watched, watched.plant.setup.unknown[k])).factor *
          day.estimate.plant[k]);
    for (const double value : day.known) add(value);
    text += ',' + csv_field(watched.remark(d)) + '\n';
  }
  return text;
}

}  // namespace dashpot::cli
