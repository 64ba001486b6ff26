#include "dashpot/report/inspection.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/record/describe.h"
#include "dashpot/record/differentiate.h"
#include "dashpot/report/provenance.h"
#include "dashpot/report/quantity.h"
#include "dashpot/report/series.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

constexpr double kPointsOfPage = 250000;  ///< about 16 bytes each in base64
/// A second velocity, from displacement, for a record that brings a velocity of its own.
Channel derived_velocity(const Record& record) {
  const Channel* velocity = record.find("velocity");
  const Channel* displacement = record.find("displacement");
  if (!velocity || !displacement || velocity->origin.starts_with("derived") ||
      record.sample_time <= 0 || record.size() < 4)
    return {};
  Derivative derived = smooth_derivative(displacement->samples, record.sample_time);
  return {"derived_velocity", "m/s", std::move(derived.slope),
          fmt::format("derived from displacement, {:.3g} Hz zero-phase", derived.cutoff_hz)};
}

/// A label, and the SI unit behind it.
using ChannelAxis = std::pair<std::string, std::string>;

FigurePanel panel_of(const std::string& title, const ChannelAxis& x, const ChannelAxis& y,
                     int height) {
  return {.title = title,
          .x_label = x.first,
          .y_label = y.first,
          .series = {},
          .height = height,
          .empty = "The record holds no such channel.",
          .x_unit = x.second,
          .y_unit = y.second};
}

/// Fills the panels record by record; each shows the chosen record.
class ChannelPanels {
 public:
  ChannelPanels(DriveUnit drive_unit, std::size_t points, std::vector<SharedSamples>& samples)
      : drive_unit_(drive_unit), points_(points), samples_(samples) {
    for (const auto& [title, unit] : {std::pair<std::string, std::string>{"Displacement", "m"},
                                      {"Velocity", "m/s"},
                                      {"Force", "N"},
                                      {"Drive", to_string(drive_unit)}}) {
      in_time_.push_back(panel_of(title, {"Time", "s"}, {title, unit}, 220));
      in_time_.back().reads_along_x = true;
    }
    in_time_[1].note =
        "Where the recording has a velocity channel of its own, the velocity derived from "
        "displacement stands beside it.";
    crossed_ = {panel_of("Force against velocity", {"Velocity", "m/s"}, {"Force", "N"}, 320),
                panel_of("Force against displacement", {"Displacement", "m"}, {"Force", "N"}, 320)};
  }

  void add(const Record& record, std::size_t place) {
    // Choose the samples that are shown.
    const Channel derived = derived_velocity(record);
    const Channel* shown[] = {
        record.find("displacement"), record.find("velocity"), record.find("force"),
        drive_unit_ == DriveUnit::None ? nullptr : record.find(drive_channel(drive_unit_))};
    std::vector<std::span<const double>> leading{record.time};
    for (const Channel* channel : shown)
      if (channel) leading.push_back(channel->samples);
    if (!derived.samples.empty()) leading.push_back(derived.samples);
    const std::vector<std::size_t> chosen = thinned_indices(leading, points_);

    // Every channel over time.
    const std::size_t time = keep(record.time, chosen, "s");
    std::optional<std::size_t> kept[4];
    for (std::size_t k = 0; k < 4; ++k)
      if (shown[k]) {
        kept[k] = keep(shown[k]->samples, chosen, in_time_[k].y_unit);
        add_series(in_time_[k], k == 1 ? shown[k]->origin : in_time_[k].title, "measured",
                   {.x = time, .y = *kept[k]}, place, k == 1);
      }
    if (!derived.samples.empty())
      add_series(in_time_[1], derived.origin, "modelled",
                 {.x = time, .y = keep(derived.samples, chosen, derived.unit)}, place, true);

    // Force over velocity and displacement.
    for (const auto& [panel, axis] : {std::pair{0, 1}, {1, 0}})
      if (kept[axis] && kept[2])
        add_series(crossed_[static_cast<std::size_t>(panel)], "measured", "measured",
                   {.x = *kept[axis], .y = *kept[2]}, place, false);
  }

  std::vector<DocumentFigure> take() {
    return {{.name = "time", .title = {}, .caption = {}, .panels = in_time_, .columns = 2},
            {.name = "loops", .title = {}, .caption = {}, .panels = crossed_, .columns = 2}};
  }

 private:
  std::size_t keep(const std::vector<double>& values, const std::vector<std::size_t>& chosen,
                   const std::string& si_unit) {
    SharedSamples shared{{}, si_unit == "s", si_unit};
    for (const std::size_t i : chosen) shared.values.push_back(values[i]);
    samples_.push_back(std::move(shared));
    return samples_.size() - 1;
  }

  static void add_series(FigurePanel& panel, const std::string& label, const std::string& colour,
                         const SharedCurve& curve, std::size_t place, bool is_listed) {
    panel.series.push_back({.label = label,
                            .colour = colour,
                            .x = {},
                            .y = {},
                            .is_listed = is_listed,
                            .shared = curve,
                            .when = {{"record", {place}}}});
  }

  const DriveUnit drive_unit_;
  const std::size_t points_;
  std::vector<SharedSamples>& samples_;
  std::vector<FigurePanel> in_time_, crossed_;
};

std::string role_name(Role role) {
  return role == Role::Training ? "training" : role == Role::LeftOut ? "left out" : "";
}

/// Least and greatest sample of a channel.
std::pair<double, double> extent_of(const Channel* channel) {
  if (!channel || channel->samples.empty()) return {kNoNumber, kNoNumber};
  const auto [least, greatest] = std::ranges::minmax(channel->samples);
  return {least, greatest};
}

/// NaN where the drive varies or is not known.
double level_of(const Record& record, const Dataset& dataset) {
  return dataset.drive_unit == DriveUnit::None ? kNoNumber : record.drive_level.value_or(kNoNumber);
}

DocumentTable record_table(const Dataset& dataset) {
  DocumentTable table{.title = {}, .columns = {{"Record"}, {"Condition"}}, .rows = {}};
  const std::vector<std::pair<std::string, std::string>> columns{
      {"Drive", to_string(dataset.drive_unit)},
      {"Samples", ""},
      {"Duration", "s"},
      {"Rate", "Hz"},
      {"Least x", "m"},
      {"Greatest x", "m"},
      {"Greatest |v|", "m/s"},
      {"Least F", "N"},
      {"Greatest F", "N"}};
  for (const auto& [title, si_unit] : columns)
    table.columns.push_back({si_unit.empty() ? title : title + ' ' + unit_name(si_unit), true});
  table.columns.push_back({"Role"});

  // A channel that is missing leaves a dash.
  for (const Record& record : dataset.records) {
    const auto x = extent_of(record.find("displacement")), v = extent_of(record.find("velocity")),
               force = extent_of(record.find("force"));
    std::vector<DocumentCell> row{{record.name}, {record.condition}};
    for (const double value :
         {level_of(record, dataset), static_cast<double>(record.size()),
          record.size() ? record.time.back() - record.time.front() : 0.0,
          record.sample_time > 0 ? 1 / record.sample_time : kNoNumber, x.first, x.second,
          std::max(std::abs(v.first), std::abs(v.second)), force.first, force.second})
      row.push_back({plain_quantity(value, columns[row.size() - 2].second), value});
    row[3].text = std::to_string(record.size());
    row.push_back({role_name(record.role)});
    table.chooses.push_back({{"record", table.rows.size()}});
    add_row(table, row);
  }
  table.leads_to = "closer";
  table.audience = Audience::Page;
  return table;
}

DocumentTable reading_table(const Dataset& dataset) {
  DocumentTable table{
      .title = {},
      .columns = {{"Files"}, {"Column"}, {"Channel"}, {"Unit"}, {"Factor to SI", true}, {"Basis"}},
      .rows = {},
      .audience = Audience::Page};
  for (const FilesAlike& group : files_alike(dataset.readings))
    for (const ColumnReading& r : group.columns)
      table.rows.push_back({group.heading(), r.column, r.channel.empty() ? "–" : r.channel, r.unit,
                            number_text(r.factor, 6), r.basis});
  return table;
}

DocumentTable velocity_table(const std::vector<VelocityCheck>& checks) {
  DocumentTable table{.title = "Velocity derived from displacement, against the measured one",
                      .columns = {{"Record"}, {"Cut-off Hz", true}, {"Difference, rms %", true}},
                      .rows = {}};
  for (const VelocityCheck& check : checks)
    table.rows.push_back({check.record, format_number(check.cutoff_hz, 3),
                          fmt::format("{:.2f}", check.rms_percent)});
  return table;
}

/// One record, as the reader of the page chooses, with its source and what was noted about it.
DocumentSection closer_section(const Dataset& dataset, std::size_t points,
                               std::vector<SharedSamples>& samples) {
  DocumentSection section{.name = "closer",
                          .title = "Record",
                          .paragraphs = {},
                          .choices = {{"record", "Record", {}}},
                          .audience = Audience::Page};

  // Source, notes and curves depend on the chosen record.
  ChannelPanels panels(dataset.drive_unit, points, samples);
  for (std::size_t r = 0; r < dataset.records.size(); ++r) {
    const Record& record = dataset.records[r];
    const When here{{"record", {r}}};
    section.choices.front().options.push_back(record.name);
    section.lists.push_back({.title = {}, .lines = {record.source}, .when = here});
    if (!record.notes.empty())
      section.lists.push_back({.title = "Notes", .lines = record.notes, .when = here});
    panels.add(record, r);
  }
  section.figures = panels.take();
  return section;
}

Value json_inspection(const Dataset& dataset, const std::vector<VelocityCheck>& checks) {
  Value columns = Value::array(), records = Value::array(), velocities = Value::array();
  for (const ColumnReading& c : dataset.readings)
    columns.push_back(Value::object({{"file", c.file},
                                     {"column", c.column},
                                     {"channel", c.channel},
                                     {"unit", c.unit},
                                     {"factor", c.factor},
                                     {"raw_offset", c.raw_offset},
                                     {"basis", c.basis}}));

  // Records by their conditions and channels.
  for (const Record& r : dataset.records) {
    std::vector<std::string> channels;
    for (const Channel& channel : r.channels) channels.push_back(channel.name);
    Value record = Value::object(
        {{"name", r.name},
         {"source", r.source},
         {"condition", r.condition},
         {"drive_level", std::isnan(level_of(r, dataset)) ? Value() : Value(level_of(r, dataset))},
         {"samples", r.size()},
         {"sample_time", r.sample_time},
         {"channels", Value::array(channels)},
         {"notes", Value::array(r.notes)}});
    if (!r.conditions.empty()) record.add("conditions", conditions_json(r.conditions));
    records.push_back(std::move(record));
  }

  // Files that were not read, and how well velocity can be derived.
  Value passed_over = Value::array();
  for (const PassedOver& passed : dataset.passed_over)
    passed_over.push_back(Value::object({{"file", passed.file}, {"why", passed.why}}));
  for (const VelocityCheck& check : checks)
    velocities.push_back(Value::object({{"record", check.record},
                                        {"cutoff_hz", check.cutoff_hz},
                                        {"rms_percent", check.rms_percent}}));
  return Value::object({{"name", dataset.name},
                        {"drive_unit", to_string(dataset.drive_unit)},
                        {"columns", std::move(columns)},
                        {"records", std::move(records)},
                        {"derived_velocity", std::move(velocities)},
                        {"passed_over", std::move(passed_over)},
                        {"notes", Value::array(dataset.notes)}});
}

}  // namespace

Document inspection_document(const InspectionInput& input) {
  const Dataset& dataset = input.dataset;
  Document document{.title = dataset.name,
                    .subtitle = counted(dataset.records.size(), "record") + " · " +
                                counted(dataset.files.size(), "file"),
                    .verdict = summary(dataset),
                    .sections = {},
                    .command = input.command,
                    .version = input.version,
                    .date = input.date,
                    .kind = "recordings",
                    .units = input.units,
                    .data = json_inspection(dataset, input.checks)};
  document.sections.push_back({.name = "records",
                               .title = "Records",
                               .paragraphs = {},
                               .tables = {record_table(dataset)},
                               .lead = "A click on a row shows its record below.",
                               .audience = Audience::Page});

  const auto points = static_cast<std::size_t>(
      kPointsOfPage / static_cast<double>(std::max<std::size_t>(1, dataset.records.size())));
  if (!dataset.records.empty() && input.has_curves)
    document.sections.push_back(closer_section(dataset, points, document.samples));

  document.sections.push_back({.name = "readings",
                               .title = "How the recordings were understood",
                               .paragraphs = {},
                               .tables = {reading_table(dataset)},
                               .plain = describe(dataset, input.units)});
  if (!input.checks.empty())
    document.sections.push_back({.name = "velocity",
                                 .title = "Derived velocity",
                                 .paragraphs = {},
                                 .tables = {velocity_table(input.checks)}});
  document.provenance = provenance_section(
      dataset,
      fmt::format("Up to {} samples of a record are shown; of longer ones, samples at even "
                  "distances and the least and greatest values of every stretch.",
                  points));
  return document;
}

}  // namespace dashpot
