#include "dashpot/report/comparison_document.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/record/cycle_figures.h"
#include "dashpot/record/differences.h"
#include "dashpot/report/characterisation_document.h"
#include "dashpot/report/provenance.h"
#include "dashpot/report/quantity.h"
#include "dashpot/report/series.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

constexpr double kPointsOfOverlays = 100000;
constexpr std::size_t kRowsOfTerminal = 30;

std::string thing_colour(std::size_t thing) {
  return thing == 0 ? "measured" : fmt::format("series-{}", (thing - 1) % 8 + 1);
}

std::string drive_name(const std::optional<double>& drive, DriveUnit unit) {
  return drive ? level_text(*drive, to_string(unit)) : "every drive";
}

/// "yes", "no": more than twice its noise; "-": the noise is not known.
std::string clear_text(const Difference& difference) {
  const std::optional<bool> clear = difference.is_clear();
  return !clear ? "-" : *clear ? "yes" : "no";
}

/// A terminal shows a spread of a long table.
void shorten(DocumentTable& table) {
  const std::size_t rows = table.rows.size();
  if (rows <= kRowsOfTerminal) return;
  for (std::size_t k = 0; k < kRowsOfTerminal; ++k)
    table.brief.push_back(k * (rows - 1) / (kRowsOfTerminal - 1));
}

/// The models over the recordings, by their errors.
DocumentTable fit_table(const std::vector<ComparedThing>& things) {
  DocumentTable table{.title = {},
                      .columns = {{"Model", false, 0, true},
                                  {"Records", true, 2},
                                  {"RMSE " + unit_name("N"), true},
                                  {"ESR %", true},
                                  {"Fit %", true},
                                  {"Worst record", false, 1, true},
                                  {"Seen", true}},
                      .rows = {}};

  // A recording among the things has no errors; a model that has seen records is marked.
  for (const ComparedThing& thing : things) {
    if (!thing.evaluation) continue;
    const Evaluation& e = *thing.evaluation;
    add_row(table, {{thing.name},
                    {std::to_string(e.records.size())},
                    {quantity(e.pooled.rmse, "N"), e.pooled.rmse},
                    {percent_text(e.pooled.esr), e.pooled.esr},
                    {percent_text(e.pooled.fit), e.pooled.fit},
                    {e.worst_record},
                    {std::to_string(thing.seen)}});
    table.warnings.push_back(thing.seen > 0);
  }

  table.note =
      "Free run, with a free force zero per record. Seen: records that taught the model; "
      "its errors there are no judgement.";
  return table;
}

/// What differs at the levels that both have: the numbers of the fits.
DocumentTable number_table(const std::vector<LevelDifference>& levels, DriveUnit unit) {
  DocumentTable table{.title = {},
                      .columns = {{"Drive"},
                                  {"Figure"},
                                  {"First", true},
                                  {"Second", true},
                                  {"Difference", true},
                                  {"Noise", true},
                                  {"Clear"}},
                      .rows = {}};

  // What a fit did not find is NaN, and has no row.
  for (const LevelDifference& level : levels) {
    const auto add = [&](const std::string& what, const Difference& d, const char* si_unit) {
      if (!std::isfinite(d.value())) return;
      table.rows.push_back({drive_name(level.drive, unit), what + ' ' + unit_name(si_unit),
                            plain_quantity(d.first, si_unit), plain_quantity(d.second, si_unit),
                            plain_quantity(d.value(), si_unit), plain_quantity(d.noise, si_unit, 2),
                            clear_text(d)});
    };
    add("friction", level.friction, "N");
    add("yield", level.yield, "N");
    add("gas", level.static_force, "N");
    add("rate", level.rate, "N/m");
    add("knee rebound", level.knee_rebound, "m/s");
    add("knee compr.", level.knee_compression, "m/s");
  }
  table.note =
      "Noise: the standard errors of both; none where a knee is found among speeds in one and in a "
      "loop in the other, which are not alike, where one cycle or record less makes another curve, "
      "and of gas, which holds the zero of the load cell. Clear: the difference is more than twice "
      "it.";
  shorten(table);
  return table;
}

DocumentTable force_table(const std::vector<LevelDifference>& levels, DriveUnit unit) {
  DocumentTable table{.title = {},
                      .columns = {{"Drive"},
                                  {unit_name("m/s"), true},
                                  {"Rebound", true, 1},
                                  {"Second", true, 1},
                                  {"Compr.", true, 1},
                                  {"Second", true, 1},
                                  {"Change " + unit_name("N"), true},
                                  {"Change %", true},
                                  {"Noise " + unit_name("N"), true},
                                  {"Clear"}},
                      .rows = {}};

  for (const LevelDifference& level : levels)
    for (const SpeedDifference& s : level.speeds)
      add_row(table,
              {{drive_name(level.drive, unit), level.drive.value_or(kNoNumber)},
               {quantity(s.speed, "m/s"), s.speed},
               {fixed_quantity(s.rebound.first, "N", 0), s.rebound.first},
               {fixed_quantity(s.rebound.second, "N", 0), s.rebound.second},
               {fixed_quantity(s.compression.first, "N", 0), s.compression.first},
               {fixed_quantity(s.compression.second, "N", 0), s.compression.second},
               {signed_quantity(s.damping_force.value(), "N", 1), s.damping_force.value()},
               {fmt::format("{:+.1f}", s.damping_force.percent()), s.damping_force.percent()},
               {quantity(s.damping_force.noise, "N", 2), s.damping_force.noise},
               {clear_text(s.damping_force)}});

  table.note =
      "Mid-stroke forces, " + unit_name("N") +
      ". Change: of half of the difference of the directions, which holds no "
      "gas force. Noise: the scatter from cycle to cycle of both. Clear: more than twice it.";
  shorten(table);
  return table;
}

/// Peak curves of all things at one level of the drive of the first.
FigurePanel peak_panel(const std::vector<ComparedThing>& things, const LevelFigures& level) {
  FigurePanel panel{.title = level_name(level, things.front().figures.drive_unit),
                    .x_label = "Velocity",
                    .y_label = "Force at mid stroke",
                    .series = {},
                    .height = 300,
                    .x_unit = "m/s",
                    .y_unit = "N"};
  double greatest = 0;
  for (const LevelFigures& one : things.front().figures.levels)
    greatest = std::max(greatest, std::abs(one.drive.value_or(0)));

  for (std::size_t k = 0; k < things.size(); ++k)
    for (const LevelFigures& other : things[k].figures.levels) {
      if (level.drive && other.drive && std::abs(*level.drive - *other.drive) > 0.02 * greatest)
        continue;
      add_level_curve(panel, {.label = things[k].name, .colour = thing_colour(k), .x = {}, .y = {}},
                      other, &StrokeFigures::mid_speed, &StrokeFigures::mid_force);
    }
  return panel;
}

/// The record of a thing that stands beside one of the first thing: of the same name, else the one
/// at the same drive whose strokes and speeds are nearest, within 10 %.
std::optional<std::size_t> partner_of(const ComparedThing& first, std::size_t record,
                                      const ComparedThing& thing) {
  const auto& records = thing.dataset.records;
  for (std::size_t k = 0; k < records.size(); ++k)
    if (records[k].name == first.dataset.records[record].name) return k;

  const RecordFigures& wanted = first.figures.records[record];
  if (!wanted.is_cyclic()) return std::nullopt;

  std::optional<std::size_t> best;
  double least = 0.1;
  for (std::size_t k = 0; k < records.size(); ++k) {
    const RecordFigures& other = thing.figures.records[k];
    if (!other.is_cyclic() || other.cycles.size() < 1) continue;
    const CycleFigures &a = wanted.cycles.front(), &b = other.cycles.front();
    if (std::isfinite(a.drive) && std::abs(a.drive - b.drive) > 0.02 * std::abs(a.drive) + 1e-9)
      continue;

    const double apart =
        std::max(std::abs(b.stroke / a.stroke - 1), std::abs(b.duration / a.duration - 1));
    if (apart < least) {
      least = apart;
      best = k;
    }
  }
  return best;
}

/// s: where a record's first cycle begins, so that two recordings can be laid over each other.
double start_of(const RecordFigures& figures) {
  return figures.is_cyclic() ? figures.cycles.front().start : 0;
}

/// "model.json, fit 91.2 %".
std::string curve_label(const ComparedThing& thing, std::size_t record) {
  if (!thing.evaluation) return thing.name;
  const RecordResult& result = thing.evaluation->records[record];
  return result.diverged_at
             ? thing.name + ", diverged"
             : fmt::format("{}, fit {} %", thing.name, percent_text(result.metrics.fit));
}

/// The three panels of curves that are laid over each other.
struct OverlayPanels {
  FigurePanel time{.title = "Force over time",
                   .x_label = "Time (s)",
                   .y_label = "Force",
                   .series = {},
                   .reads_along_x = true,
                   .height = 280,
                   .y_unit = "N"};
  FigurePanel velocity{.title = "Force over velocity",
                       .x_label = "Velocity",
                       .y_label = "Force",
                       .series = {},
                       .height = 320,
                       .x_unit = "m/s",
                       .y_unit = "N"};
  FigurePanel displacement{.title = "Force over displacement",
                           .x_label = "Displacement",
                           .y_label = "Force",
                           .series = {},
                           .height = 320,
                           .x_unit = "m",
                           .y_unit = "N"};
};

/// Draws what thing k has to record r of the first one, where it has something.
void lay_over(const std::vector<ComparedThing>& things, std::size_t r, std::size_t k,
              std::size_t points, OverlayPanels& panels, std::vector<SharedSamples>& samples) {
  const std::optional<std::size_t> partner = partner_of(things.front(), r, things[k]);
  if (!partner) return;
  std::vector<double> integrated;
  DynoChannels c;
  try {
    c = dyno_channels(things[k].dataset.records[*partner], things[k].dataset.drive_unit,
                      integrated);
  } catch (const Error&) {
    return;  // A record that has no displacement to be drawn over.
  }

  // As few samples as the eye needs, the same of every channel.
  const std::vector<std::size_t> chosen =
      thinned_indices({c.time, c.displacement, c.velocity, c.force}, points);
  const auto keep = [&](std::span<const double> values, const char* si_unit, double offset = 0) {
    SharedSamples shared{{}, offset != 0, si_unit};
    for (const std::size_t i : chosen) shared.values.push_back(values[i] + offset);
    samples.push_back(std::move(shared));
    return samples.size() - 1;
  };

  // Recordings of one motion begin their cycles at the same time; a model ran over the first one's.
  const double shift = things[k].is_model ? 0
                                          : start_of(things.front().figures.records[r]) -
                                                start_of(things[k].figures.records[*partner]);
  const std::size_t force = keep(c.force, "N");
  for (const auto& [panel, x] : {std::pair{&panels.time, keep(c.time, "s", shift)},
                                 {&panels.velocity, keep(c.velocity, "m/s")},
                                 {&panels.displacement, keep(c.displacement, "m")}})
    panel->series.push_back({.label = curve_label(things[k], *partner),
                             .colour = thing_colour(k),
                             .x = {},
                             .y = {},
                             .shared = SharedCurve{.x = x, .y = force},
                             .when = {{"record", {r}}}});
}

std::vector<DocumentFigure> overlay_figures(const std::vector<ComparedThing>& things,
                                            std::vector<SharedSamples>& samples) {
  const std::size_t records = things.front().dataset.records.size();
  const auto points = static_cast<std::size_t>(
      kPointsOfOverlays / static_cast<double>(std::max<std::size_t>(1, records * things.size())));
  OverlayPanels panels;
  for (std::size_t r = 0; r < records; ++r)
    for (std::size_t k = 0; k < things.size(); ++k) lay_over(things, r, k, points, panels, samples);

  return {{.name = "force-time", .title = {}, .caption = {}, .panels = {panels.time}},
          {.name = "loops",
           .title = {},
           .caption = {},
           .panels = {panels.velocity, panels.displacement},
           .columns = 2}};
}

Value number_json(double value) { return std::isfinite(value) ? Value(value) : Value(); }

Value difference_json(const Difference& d) {
  const std::optional<bool> clear = d.is_clear();
  return Value::object({{"first", number_json(d.first)},
                        {"second", number_json(d.second)},
                        {"difference", number_json(d.value())},
                        {"noise", number_json(d.noise)},
                        {"clear", clear ? Value(*clear) : Value()}});
}

Value differences_json(const std::vector<LevelDifference>& levels) {
  Value list = Value::array();
  for (const LevelDifference& level : levels) {
    Value speeds = Value::array();
    for (const SpeedDifference& s : level.speeds)
      speeds.push_back(Value::object({{"speed", s.speed},
                                      {"rebound", difference_json(s.rebound)},
                                      {"compression", difference_json(s.compression)},
                                      {"damping_force", difference_json(s.damping_force)}}));
    list.push_back(Value::object({{"drive", level.drive ? Value(*level.drive) : Value()},
                                  {"friction", difference_json(level.friction)},
                                  {"yield_force", difference_json(level.yield)},
                                  {"gas_force", difference_json(level.static_force)},
                                  {"gas_rate", difference_json(level.rate)},
                                  {"knee_rebound", difference_json(level.knee_rebound)},
                                  {"knee_compression", difference_json(level.knee_compression)},
                                  {"speeds", std::move(speeds)}}));
  }
  return list;
}

/// How many forces differ clearly, and where by the most.
std::string difference_sentence(const std::string& name, const std::vector<LevelDifference>& levels,
                                DriveUnit unit) {
  std::size_t count = 0, clear = 0, known = 0, quiet = 0;
  const SpeedDifference* most = nullptr;
  std::optional<double> where;

  // Noise of less than a thousandth is that of arithmetic: a model was computed.
  for (const LevelDifference& level : levels)
    for (const SpeedDifference& s : level.speeds) {
      ++count;
      known += s.damping_force.is_clear().has_value() ? 1 : 0;
      quiet += s.damping_force.noise < 1e-3 * std::abs(s.damping_force.first) ? 1 : 0;
      clear += s.damping_force.is_clear().value_or(false) ? 1 : 0;
      if (most && std::abs(s.damping_force.percent()) <= std::abs(most->damping_force.percent()))
        continue;
      most = &s;
      where = level.drive;
    }

  if (!most) return name + " has no speed and drive in common with the first.";
  const std::string told = quiet == count ? "computed, with hardly any noise"
                           : known == 0
                               ? "with no repeated cycles to say how much of it is noise"
                               : fmt::format("{} of them by more than twice the noise", clear);
  return fmt::format("{}: {} compared, {}; the most is {:+.1f} % at {} {} and {}.", name,
                     counted(count, "force"), told, most->damping_force.percent(),
                     quantity(most->speed, "m/s"), unit_name("m/s"), drive_name(where, unit));
}

}  // namespace

Document comparison_document(const ComparisonInput& input) {
  const std::vector<ComparedThing>& things = input.things;
  const ComparedThing& first = things.front();
  const DriveUnit unit = first.figures.drive_unit;
  Document document{.title = "Comparison with " + first.name,
                    .subtitle = counted(things.size() - 1, "other"),
                    .verdict = {},
                    .sections = {},
                    .command = input.command,
                    .version = input.version,
                    .date = input.date,
                    .kind = "comparison"};

  if (things.size() > 2)
    document.verdict =
        fmt::format("{} beside {}.", counted(things.size() - 1, "thing"), first.name);

  // Models by their errors on the recordings, and which of these taught them.
  Value others = Value::array();
  DocumentSection fits{.name = "fits",
                       .title = "Models over the recordings",
                       .paragraphs = {},
                       .tables = {fit_table(things)}};
  for (const ComparedThing& thing : things)
    if (thing.seen > 0)
      fits.remarks.push_back(
          fmt::format("{} was taught by {} of these: how well it follows them is "
                      "no judgement",
                      thing.name, counted(thing.seen, "record")));
  if (!fits.tables.front().rows.empty()) document.sections.push_back(std::move(fits));

  // Every other thing against the first.
  for (std::size_t k = 1; k < things.size(); ++k) {
    const std::vector<LevelDifference> levels =
        differences(first.figures, things[k].figures, input.speeds);
    const std::string sentence = difference_sentence(things[k].name, levels, unit);
    document.verdict += things.size() == 2 ? sentence : "\n* " + sentence;
    DocumentSection section{.name = fmt::format("differences-{}", k),
                            .title = things[k].name + " (second) against " + first.name,
                            .paragraphs = {}};
    if (DocumentTable forces = force_table(levels, unit); !forces.rows.empty())
      section.tables.push_back(std::move(forces));
    if (DocumentTable numbers = number_table(levels, unit); !numbers.rows.empty())
      section.tables.push_back(std::move(numbers));
    for (const Extrapolation& beyond : things[k].beyond)
      section.remarks.push_back(things[k].name + ": " + describe(beyond));
    if (!section.tables.empty()) document.sections.push_back(std::move(section));
    others.push_back(Value::object(
        {{"name", things[k].name},
         {"is_model", things[k].is_model},
         {"records_seen", things[k].seen},
         {"outside_domain", to_json(things[k].beyond)},
         {"fit_percent",
          things[k].evaluation ? number_json(things[k].evaluation->pooled.fit) : Value()},
         {"rmse_N",
          things[k].evaluation ? number_json(things[k].evaluation->pooled.rmse) : Value()},
         {"levels", differences_json(levels)}}));
  }

  // Peak curves per level, then the chosen record.
  DocumentSection peaks{
      .name = "peaks", .title = "Force over speed", .paragraphs = {}, .audience = Audience::Page};
  DocumentFigure curves{
      .name = "peak-curves", .title = {}, .caption = {}, .panels = {}, .columns = 2};
  for (const LevelFigures& level : first.figures.levels)
    curves.panels.push_back(peak_panel(things, level));
  peaks.figures.push_back(std::move(curves));
  if (!first.figures.levels.empty()) document.sections.push_back(std::move(peaks));
  DocumentSection closer{.name = "closer",
                         .title = "One record",
                         .paragraphs = {},
                         .choices = {{"record", "Record", {}}},
                         .audience = Audience::Page};
  for (const Record& record : first.dataset.records)
    closer.choices.front().options.push_back(record.name);
  closer.figures = overlay_figures(things, document.samples);
  document.sections.push_back(std::move(closer));
  document.provenance = provenance_section(
      first.dataset, "Of long records the least and greatest values of every stretch are shown.");
  document.data = Value::object({{"first", first.name},
                                 {"units", "SI"},
                                 {"drive_unit", to_string(unit)},
                                 {"others", std::move(others)}});
  return document;
}

}  // namespace dashpot
