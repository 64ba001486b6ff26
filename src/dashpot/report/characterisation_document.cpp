#include "dashpot/report/characterisation_document.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/record/cycle_figures.h"
#include "dashpot/report/column_table.h"
#include "dashpot/report/provenance.h"
#include "dashpot/report/quantity.h"
#include "dashpot/report/series.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

constexpr double kCelsius = 273.15;
constexpr double kPointsOfLoops = 120000;
constexpr std::size_t kRowsInBrief = 24;

std::string force_text(double newton) { return plain_quantity(newton, "N", 4); }
std::string speed_text(double speed) { return quantity(speed, "m/s"); }

/// "52.1 ... 524"; "125" where all are alike.
std::string span_text(const std::vector<SpeedFigures>& speeds) {
  const std::string least = speed_text(speeds.front().speed),
                    most = speed_text(speeds.back().speed);
  return least == most ? least : least + " ... " + most;
}

/// "412 ± 3"; the number alone without an error, a dash where it cannot be told. `si_unit`: "1" of
/// a number that has none.
std::string estimate_text(const Measured& estimate, std::string_view si_unit, int digits = 3) {
  if (!estimate.is_told()) return "-";
  const std::string value = plain_quantity(estimate.value, si_unit, digits);
  return std::isfinite(estimate.error) ? value + " ± " + plain_quantity(estimate.error, si_unit, 2)
                                       : value;
}

/// A change of which no more than its scatter is seen is not told.
std::string change_text(const Measured& change) {
  if (!change.is_told()) return "-";
  return std::abs(change.value) > 2 * change.error ? fmt::format("{:+.1f}", change.value)
                                                   : fmt::format("within {:.1f}", 2 * change.error);
}

std::string repeat_text(double percent) { return percent_text(percent); }

/// What every level says of itself: one row each.
DocumentTable level_table(const Characterisation& all) {
  DocumentTable table{.title = {},
                      .columns = {{"Drive"},
                                  {"Speeds", true, 3},
                                  {unit_name("m/s"), true, 4},
                                  {"Friction " + unit_name("N"), true},
                                  {"Yield " + unit_name("N"), true},
                                  {"Gas " + unit_name("N"), true, 1},
                                  {"Rate " + unit_name("N/m"), true, 2},
                                  {"Knee reb.", true},
                                  {"Knee compr.", true},
                                  {"From", false, 5}},
                      .rows = {}};

  // Forces in N, speeds and knees in mm/s, rates in N/mm.
  for (const LevelFigures& level : all.levels)
    table.rows.push_back({level_name(level, all.drive_unit), std::to_string(level.speeds.size()),
                          span_text(level.speeds), estimate_text(level.friction, "N"),
                          estimate_text(level.yield, "N"), estimate_text(level.static_force, "N"),
                          estimate_text(level.rate, "N/m"),
                          estimate_text(level.rebound.knee, "m/s"),
                          estimate_text(level.compression.knee, "m/s"), level.basis});

  table.note =
      "± one standard error. Friction: half of the jump of force between the directions towards "
      "v = 0. Yield: where the lines above the knees meet v = 0, friction and field together. "
      "Knee: " +
      unit_name("m/s") + ". Gas: positive pushes the rod out; holds the zero of the load cell.";
  return table;
}

/// Forces over speed, level by level; at the stated speeds where there are any.
DocumentTable speed_table(const Characterisation& all, const std::vector<double>& stated) {
  DocumentTable table{.title = {},
                      .columns = {{"Drive"},
                                  {unit_name("m/s"), true},
                                  {"Cycles", true, 4},
                                  {"Rebound " + unit_name("N"), true},
                                  {"Compr. " + unit_name("N"), true},
                                  {"Peak reb. " + unit_name("N"), true, 5},
                                  {"Peak compr. " + unit_name("N"), true, 6},
                                  {"± %", true, 1},
                                  {"Hyst. " + unit_name("N"), true, 3},
                                  {unit_name("J") + "/cycle", true, 2},
                                  {unit_name("N*s/m"), true, 2}},
                      .rows = {}};
  for (const LevelFigures& level : all.levels) {
    std::vector<SpeedFigures> rows = level.speeds;
    if (!stated.empty()) {
      rows.clear();
      for (const double speed : stated)
        if (const auto figures = at_speed(level, speed)) rows.push_back(*figures);
    }
    for (const SpeedFigures& s : rows)
      add_row(table, {{level_name(level, all.drive_unit), level.drive.value_or(kNoNumber)},
                      {speed_text(s.speed), s.speed},
                      {std::to_string(s.cycles)},
                      {force_text(s.rebound.mid_force), s.rebound.mid_force},
                      {force_text(s.compression.mid_force), s.compression.mid_force},
                      {force_text(s.rebound.peak_force), s.rebound.peak_force},
                      {force_text(s.compression.peak_force), s.compression.peak_force},
                      {repeat_text(s.repeatability), s.repeatability},
                      {quantity(s.hysteresis, "N"), s.hysteresis},
                      {quantity(s.energy, "J"), s.energy},
                      {plain_quantity(s.equivalent_damping, "N*s/m"), s.equivalent_damping}});
  }

  // A terminal shows a spread of a long table.
  const std::size_t rows = table.rows.size();
  if (rows > kRowsInBrief)
    for (std::size_t k = 0; k < kRowsInBrief; ++k)
      table.brief.push_back(k * (rows - 1) / (kRowsInBrief - 1));
  table.note =
      "Rebound, Compr.: force in the middle of the stroke. Peak: the greatest of the cycle. ± %: "
      "standard deviation between cycles of a record. Hyst.: how much more force at half speed "
      "while speed falls. " +
      unit_name("N*s/m") + ": the dashpot that takes out as much energy; " + unit_name("J") +
      " of alike strokes alone.";
  return table;
}

DocumentTable range_table(const Characterisation& all) {
  DocumentTable table{
      .title = {},
      .columns = {{unit_name("m/s"), true},
                  {unit_name("N") + " at " + level_name(all.levels.front(), all.drive_unit), true},
                  {unit_name("N") + " at " + level_name(all.levels.back(), all.drive_unit), true},
                  {"Ratio", true}},
      .rows = {}};
  for (const DynamicRange& r : all.range)
    table.rows.push_back({speed_text(r.speed), force_text(r.lowest_force),
                          force_text(r.highest_force), number_text(r.ratio)});
  table.note = "Half of the difference of the mid-stroke forces of both directions.";
  return table;
}

std::vector<std::string> record_row(const RecordFigures& r) {
  if (!r.is_cyclic()) return {r.name, "0", "-", "-", "-", "-", "-", "-"};
  const auto speed = [](const CycleFigures& c) { return c.rebound.mid_speed; };
  const auto [shortest, longest] = std::ranges::minmax(r.cycles, {}, &CycleFigures::stroke);
  const auto [quickest, slowest] = std::ranges::minmax(r.cycles, {}, &CycleFigures::duration);
  const auto [least, most] = std::ranges::minmax(r.cycles, {}, speed);

  return {r.name,
          std::to_string(r.cycles.size()),
          quantity_range(shortest.stroke, longest.stroke, "m"),
          range_text(1 / slowest.duration, 1 / quickest.duration, 3),
          quantity_range(speed(least), speed(most), "m/s"),
          repeat_text(r.repeatability),
          change_text(r.drift),
          estimate_text(r.fade, "1", 2)};
}

DocumentTable record_sheet(const Characterisation& all) {
  DocumentTable table{.title = {},
                      .columns = {{"Record", false, 0, true},
                                  {"Cycles", true},
                                  {"Stroke " + unit_name("m"), true, 3},
                                  {"Hz", true, 4},
                                  {unit_name("m/s"), true, 2},
                                  {"Repeats to %", true},
                                  {"Drift %", true},
                                  {"Fade %/K", true, 1}},
                      .rows = {}};
  bool has_fade = false;
  for (const RecordFigures& r : all.records) {
    table.rows.push_back(record_row(r));
    table.warnings.push_back(!r.remarks.empty());
    table.chooses.push_back({{"record", table.chooses.size()}});
    has_fade = has_fade || (r.is_cyclic() && r.fade.is_told());
  }

  // A column of nothing is for those who wonder, on the page.
  if (!has_fade) {
    table.columns.back().audience = Audience::Page;
    table.columns.back().hint = "needs a temperature channel that changes by 2 K";
  }
  table.leads_to = "loops";
  table.note =
      "Repeats to: standard deviation of the damping force between cycles of like speed. "
      "Drift: its change from the first cycle to the last.";

  const std::size_t rows = table.rows.size();
  if (rows > kRowsInBrief)
    for (std::size_t k = 0; k < kRowsInBrief; ++k)
      table.brief.push_back(k * (rows - 1) / (kRowsInBrief - 1));
  return table;
}

/// Remarks of records, equal ones together: "a, b and 3 more: it is at rest".
std::vector<std::string> all_remarks(const Characterisation& all) {
  std::vector<std::pair<std::string, std::vector<std::string>>> said;
  const auto say = [&](const std::string& who, const std::string& what) {
    const auto same = std::ranges::find(said, what, [](const auto& s) { return s.first; });
    if (same == said.end())
      said.push_back({what, {who}});
    else
      same->second.push_back(who);
  };

  // Those of records and of levels; what is said of all stands first.
  for (const RecordFigures& record : all.records)
    for (const std::string& remark : record.remarks) say(record.name, remark);
  for (const LevelFigures& level : all.levels)
    for (const std::string& remark : level.remarks) say(level_name(level, all.drive_unit), remark);

  std::vector<std::string> lines = all.remarks;
  std::vector<std::string> beyond;
  for (const double speed : all.stated_speeds)
    if (std::ranges::none_of(all.levels, [&](const LevelFigures& level) {
          return at_speed(level, speed).has_value();
        }))
      beyond.push_back(plain_quantity(speed, "m/s"));
  if (!beyond.empty() && !all.levels.empty())
    lines.push_back("no force is stated at " + join(beyond, ", ") + ' ' + unit_name("m/s") +
                    ": beyond the speeds that were measured");
  constexpr std::size_t kNamed = 3;
  for (auto& [what, who] : said) {
    const std::size_t more = who.size() - std::min(who.size(), kNamed);
    who.resize(who.size() - more);
    lines.push_back(join(who, ", ") + (more > 0 ? fmt::format(" and {} more", more) : "") + ": " +
                    what);
  }
  return lines;
}

std::string drive_colour(std::size_t level, std::size_t count) {
  return fmt::format("level-{}-{}", level + 1, count);
}

struct Axis {
  std::string label, si_unit;
};

FigurePanel blank_panel(const std::string& title, const Axis& x, const Axis& y, int height = 320) {
  return {.title = title,
          .x_label = x.label,
          .y_label = y.label,
          .series = {},
          .height = height,
          .x_unit = x.si_unit,
          .y_unit = y.si_unit};
}

/// Force over speed of every level, both directions.
DocumentFigure curve_figure(const Characterisation& all) {
  const Axis newtons{"Force", "N"};
  FigurePanel middle = blank_panel("Force at mid stroke", {"Velocity", "m/s"}, newtons),
              peak =
                  blank_panel("Greatest force of a cycle", {"Greatest velocity", "m/s"}, newtons);
  for (std::size_t k = 0; k < all.levels.size(); ++k) {
    const LevelFigures& level = all.levels[k];
    const FigureSeries line{.label = level_name(level, all.drive_unit),
                            .colour = drive_colour(k, all.levels.size()),
                            .x = {},
                            .y = {}};
    add_level_curve(middle, line, level, &StrokeFigures::mid_speed, &StrokeFigures::mid_force);
    add_level_curve(peak, line, level, &StrokeFigures::peak_speed, &StrokeFigures::peak_force);
  }
  return {
      .name = "peak-curves", .title = {}, .caption = {}, .panels = {middle, peak}, .columns = 2};
}

/// Loops of all cycles of the chosen record.
std::vector<DocumentFigure> loop_figures(const CharacterisationInput& input,
                                         std::vector<SharedSamples>& samples) {
  const Axis force{"Force", "N"};
  FigurePanel velocity = blank_panel("Force over velocity", {"Velocity", "m/s"}, force),
              displacement = blank_panel("Force over displacement", {"Displacement", "m"}, force),
              time = blank_panel("Force over time", {"Time (s)", ""}, force, 240);
  const auto points = static_cast<std::size_t>(
      kPointsOfLoops / static_cast<double>(std::max<std::size_t>(1, input.dataset.records.size())));

  for (std::size_t r = 0; r < input.dataset.records.size(); ++r) {
    const Record& record = input.dataset.records[r];
    std::vector<double> integrated;
    DynoChannels c;
    try {
      c = dyno_channels(record, input.dataset.drive_unit, integrated);
    } catch (const Error&) {
      continue;  // The record's remark says why it has no loops.
    }

    // As few samples as the eye needs, the same of every channel.
    const std::vector<std::size_t> chosen =
        thinned_indices({c.time, c.displacement, c.velocity, c.force}, points);
    const auto keep = [&](std::span<const double> values, const char* si_unit) {
      SharedSamples shared{{}, si_unit == std::string("s"), si_unit};
      for (const std::size_t i : chosen) shared.values.push_back(values[i]);
      samples.push_back(std::move(shared));
      return samples.size() - 1;
    };

    const std::size_t f = keep(c.force, "N");
    for (const auto& [to, x] : {std::pair{&velocity, keep(c.velocity, "m/s")},
                                {&displacement, keep(c.displacement, "m")},
                                {&time, keep(c.time, "s")}})
      to->series.push_back({.label = "measured",
                            .colour = "measured",
                            .x = {},
                            .y = {},
                            .is_listed = false,
                            .shared = SharedCurve{.x = x, .y = f},
                            .when = {{"record", {r}}}});
  }
  return {{.name = "loops",
           .title = {},
           .caption = {},
           .panels = {velocity, displacement},
           .columns = 2},
          {.name = "force-time", .title = {}, .caption = {}, .panels = {time}}};
}

/// Damping force cycle by cycle, as a share of its mean at that speed and drive: over the time of
/// its record and, where there is one, over temperature.
DocumentFigure drift_figure(const Characterisation& all) {
  FigurePanel over_time = blank_panel("Over the time of the record", {"Time (s)", ""},
                                      {"Damping force (% of its mean)", ""}, 280),
              over_heat = blank_panel("Over temperature", {"Temperature (°C)", ""},
                                      {"Damping force (% of its mean)", ""}, 280);
  for (std::size_t k = 0; k < all.levels.size(); ++k) {
    const LevelFigures& level = all.levels[k];
    FigureSeries in_time{.label = level_name(level, all.drive_unit),
                         .colour = drive_colour(k, all.levels.size()),
                         .x = {},
                         .y = {},
                         .mark = FigureSeries::Mark::Dots,
                         .width = 2.5};
    FigureSeries in_heat = in_time;

    // The cycles of this level, beside the level's force at their speed.
    for (const RecordFigures& record : all.records)
      for (const CycleFigures& cycle : record.cycles) {
        if (level.drive && !(std::abs(cycle.drive - *level.drive) <= 0.02 * std::abs(*level.drive)))
          continue;
        const auto mean =
            at_speed(level, (cycle.rebound.mid_speed + cycle.compression.mid_speed) / 2);
        if (!mean) continue;
        const double share = 100 * cycle.damping_force / mean->damping_force;
        in_time.x.push_back(cycle.start);
        in_time.y.push_back(share);
        if (!std::isfinite(cycle.temperature)) continue;
        in_heat.x.push_back(cycle.temperature - kCelsius);
        in_heat.y.push_back(share);
      }

    if (!in_time.x.empty()) over_time.series.push_back(std::move(in_time));
    if (!in_heat.x.empty()) over_heat.series.push_back(std::move(in_heat));
  }

  // Temperature has a panel where it was measured.
  DocumentFigure figure{.name = "drift", .title = {}, .caption = {}, .panels = {over_time}};
  if (!over_heat.series.empty()) {
    figure.panels.push_back(std::move(over_heat));
    figure.columns = 2;
  }
  return figure;
}

// JSON and CSV are in SI; what cannot be told is null.

Value told(double value) { return std::isfinite(value) ? Value(value) : Value(); }

Value estimate_json(const Measured& estimate) {
  return Value::object({{"value", told(estimate.value)}, {"standard_error", told(estimate.error)}});
}

Value stroke_json(const StrokeFigures& s) {
  return Value::object({{"mid_speed", s.mid_speed},
                        {"mid_force", s.mid_force},
                        {"peak_speed", s.peak_speed},
                        {"peak_force", s.peak_force}});
}

Value knee_json(const KneeFit& fit) {
  return Value::object({{"speed", estimate_json(fit.knee)},
                        {"force_at_rest", estimate_json(fit.at_rest)},
                        {"slope_below", fit.slope_below},
                        {"slope_above", fit.slope_above},
                        {"why_not", fit.why_no_knee.empty() ? Value() : Value(fit.why_no_knee)}});
}

Value level_json(const LevelFigures& level) {
  Value speeds = Value::array();
  for (const SpeedFigures& s : level.speeds)
    speeds.push_back(Value::object({{"speed", s.speed},
                                    {"cycles", s.cycles},
                                    {"rebound", stroke_json(s.rebound)},
                                    {"compression", stroke_json(s.compression)},
                                    {"damping_force", s.damping_force},
                                    {"repeatability_percent", told(s.repeatability)},
                                    {"hysteresis", told(s.hysteresis)},
                                    {"energy", told(s.energy)},
                                    {"equivalent_damping", s.equivalent_damping}}));
  return Value::object({{"drive", level.drive ? Value(*level.drive) : Value()},
                        {"basis", level.basis},
                        {"friction", estimate_json(level.friction)},
                        {"yield_force", estimate_json(level.yield)},
                        {"gas_force", estimate_json(level.static_force)},
                        {"gas_rate", estimate_json(level.rate)},
                        {"knee_rebound", knee_json(level.rebound)},
                        {"knee_compression", knee_json(level.compression)},
                        {"speeds", std::move(speeds)},
                        {"remarks", Value::array(level.remarks)}});
}

Value cycle_json(const CycleFigures& c) {
  return Value::object({{"start", c.start},
                        {"duration", c.duration},
                        {"stroke", c.stroke},
                        {"centre", c.centre},
                        {"drive", told(c.drive)},
                        {"rebound", stroke_json(c.rebound)},
                        {"compression", stroke_json(c.compression)},
                        {"gas_force", c.static_force},
                        {"gas_rate", told(c.rate)},
                        {"hysteresis", told(c.hysteresis)},
                        {"energy", c.energy},
                        {"equivalent_damping", c.equivalent_damping},
                        {"temperature", told(c.temperature)}});
}

Value record_json(const RecordFigures& r) {
  Value cycles = Value::array();
  for (const CycleFigures& c : r.cycles) cycles.push_back(cycle_json(c));
  return Value::object({{"name", r.name},
                        {"condition", r.condition},
                        {"repeatability_percent", told(r.repeatability)},
                        {"drift_percent", estimate_json(r.drift)},
                        {"fade_percent_per_K", estimate_json(r.fade)},
                        {"remarks", Value::array(r.remarks)},
                        {"cycles", std::move(cycles)}});
}

Value characterisation_json(const CharacterisationInput& input) {
  Value levels = Value::array(), records = Value::array(), range = Value::array();
  for (const LevelFigures& level : input.figures.levels) levels.push_back(level_json(level));
  for (const RecordFigures& r : input.figures.records) records.push_back(record_json(r));
  for (const DynamicRange& r : input.figures.range)
    range.push_back(Value::object({{"speed", r.speed},
                                   {"ratio", r.ratio},
                                   {"lowest_force", r.lowest_force},
                                   {"highest_force", r.highest_force}}));

  return Value::object({{"name", input.dataset.name},
                        {"units", "SI"},
                        {"drive_unit", to_string(input.figures.drive_unit)},
                        {"levels", std::move(levels)},
                        {"dynamic_range", std::move(range)},
                        {"records", std::move(records)},
                        {"remarks", Value::array(input.figures.remarks)}});
}

/// What the sheet says in a sentence or two.
std::string sheet_verdict(const Characterisation& all) {
  std::size_t cycles = 0, cyclic = 0;
  for (const RecordFigures& r : all.records) {
    cycles += r.cycles.size();
    cyclic += r.is_cyclic() ? 1 : 0;
  }
  if (cycles == 0)
    return "No cycle was found in " + counted(all.records.size(), "record") +
           ": a dyno sheet needs cyclic motion, and what cannot be told stands below.";

  // What was seen: cycles, speeds, levels.
  std::string text = fmt::format("{} in {} of {}", counted(cycles, "cycle"), cyclic,
                                 counted(all.records.size(), "record"));
  if (all.levels.empty()) return text + ", none of them at a steady drive.";
  const LevelFigures& first = all.levels.front();
  text += "; " + span_text(first.speeds) + ' ' + unit_name("m/s");
  if (all.levels.size() > 1) text += ", " + counted(all.levels.size(), "level") + " of drive";
  text += '.';

  if (!all.range.empty()) {
    const DynamicRange& widest = *std::ranges::max_element(all.range, {}, &DynamicRange::ratio);
    text +=
        fmt::format(" The highest drive gives up to {} times the force of the lowest (at {} {}).",
                    number_text(widest.ratio), speed_text(widest.speed), unit_name("m/s"));
  }
  return text;
}

}  // namespace

std::string level_name(const LevelFigures& level, DriveUnit unit) {
  return level.drive ? level_text(*level.drive, to_string(unit)) : "every drive";
}

void add_level_curve(FigurePanel& panel, FigureSeries line, const LevelFigures& level,
                     double StrokeFigures::* speed, double StrokeFigures::* force) {
  // Compression from the quickest on.
  for (auto s = level.speeds.rbegin(); s != level.speeds.rend(); ++s) {
    line.x.push_back(-(s->compression.*speed));
    line.y.push_back(s->compression.*force);
  }

  // A gap: between the slowest cycles of the directions nothing was measured.
  line.x.push_back(kNoNumber);
  line.y.push_back(kNoNumber);

  // Rebound to the quickest.
  for (const SpeedFigures& s : level.speeds) {
    line.x.push_back(s.rebound.*speed);
    line.y.push_back(s.rebound.*force);
  }

  // The same as dots, which the legend and the reading of values leave out.
  FigureSeries dots = line;
  dots.mark = FigureSeries::Mark::Dots;
  dots.width = 3;
  dots.is_read = false;
  panel.series.push_back(std::move(line));
  panel.series.push_back(std::move(dots));
}

Document characterisation_document(const CharacterisationInput& input) {
  const Characterisation& all = input.figures;
  Document document{.title = input.dataset.name,
                    .subtitle = counted(input.dataset.records.size(), "record") + " · " +
                                counted(input.dataset.files.size(), "file"),
                    .verdict = sheet_verdict(all),
                    .sections = {},
                    .command = input.command,
                    .version = input.version,
                    .date = input.date,
                    .kind = "dyno sheet",
                    .data = characterisation_json(input)};

  // Levels, then force over speed, then what the drive can do.
  if (!all.levels.empty()) {
    document.sections.push_back({.name = "levels",
                                 .title = "What each level of the drive says",
                                 .paragraphs = {},
                                 .tables = {level_table(all)}});
    document.sections.push_back({.name = "speeds",
                                 .title = "Force over speed",
                                 .paragraphs = {},
                                 .tables = {speed_table(all, all.stated_speeds)},
                                 .figures = {curve_figure(all)}});
  }
  if (!all.range.empty())
    document.sections.push_back({.name = "range",
                                 .title = "Dynamic range",
                                 .paragraphs = {},
                                 .tables = {range_table(all)}});

  // Record by record.
  document.sections.push_back({.name = "records",
                               .title = "Records",
                               .paragraphs = {},
                               .tables = {record_sheet(all)},
                               .remarks = all_remarks(all)});
  if (!all.levels.empty())
    document.sections.push_back({.name = "drift",
                                 .title = "Cycle by cycle",
                                 .paragraphs = {},
                                 .figures = {drift_figure(all)},
                                 .audience = Audience::Page});
  DocumentSection loops{.name = "loops",
                        .title = "Loops",
                        .paragraphs = {},
                        .choices = {{"record", "Record", {}}},
                        .audience = Audience::Page};
  for (std::size_t r = 0; r < all.records.size(); ++r) {
    loops.choices.front().options.push_back(all.records[r].name);
    if (!all.records[r].remarks.empty())
      loops.lists.push_back(
          {.title = "Remarks", .lines = all.records[r].remarks, .when = {{"record", {r}}}});
  }
  loops.figures = loop_figures(input, document.samples);
  document.sections.push_back(std::move(loops));
  document.provenance = provenance_section(
      input.dataset, "Of long records the least and greatest values of every stretch are shown.");
  return document;
}

std::string cycles_csv(const Characterisation& all, const PrintUnits& units) {
  ColumnTable table{.name = "cycles", .title = "cycles", .columns = {}};
  std::vector<std::string> names;
  std::vector<const CycleFigures*> cycles;
  for (const RecordFigures& r : all.records)
    for (const CycleFigures& c : r.cycles) {
      names.push_back(r.name);
      cycles.push_back(&c);
    }
  table.columns.push_back({"record", "1", "", {}, std::move(names)});
  const auto add = [&](const std::string& name, const std::string& unit, auto value) {
    DataColumn column{name, unit, "", {}};
    for (const CycleFigures* cycle : cycles) column.numbers.push_back(value(*cycle));
    table.columns.push_back(std::move(column));
  };

  // In the order of a cycle: when, what motion, which forces, what follows from them.
  using C = CycleFigures;
  add("start", "s", [](const C& c) { return c.start; });
  add("duration", "s", [](const C& c) { return c.duration; });
  add("stroke", "m", [](const C& c) { return c.stroke; });
  add("centre", "m", [](const C& c) { return c.centre; });
  add("drive", unit_of(all.drive_unit), [](const C& c) { return c.drive; });
  for (const auto& [name, side] :
       {std::pair<std::string, StrokeFigures C::*>{"rebound", &C::rebound},
        {"compression", &C::compression}}) {
    add(name + "_mid_speed", "m/s", [side](const C& c) { return (c.*side).mid_speed; });
    add(name + "_mid_force", "N", [side](const C& c) { return (c.*side).mid_force; });
    add(name + "_peak_speed", "m/s", [side](const C& c) { return (c.*side).peak_speed; });
    add(name + "_peak_force", "N", [side](const C& c) { return (c.*side).peak_force; });
  }
  add("damping_force", "N", [](const C& c) { return c.damping_force; });
  add("gas_force", "N", [](const C& c) { return c.static_force; });
  add("gas_rate", "N/m", [](const C& c) { return c.rate; });
  add("hysteresis", "N", [](const C& c) { return c.hysteresis; });
  add("energy", "J", [](const C& c) { return c.energy; });
  add("equivalent_damping", "N*s/m", [](const C& c) { return c.equivalent_damping; });
  add("temperature", "K", [](const C& c) { return c.temperature; });
  return csv_table(in_units(std::move(table), units));
}

}  // namespace dashpot
