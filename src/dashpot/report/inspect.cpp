#include "dashpot/report/inspect.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/record/differentiate.h"
#include "dashpot/report/page.h"
#include "dashpot/report/report_json.h"
#include "dashpot/report/safe_text.h"
#include "dashpot/report/series.h"

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
  const double cutoff = choose_cutoff_hz(displacement->samples, record.sample_time);
  return {"derived_velocity", "m/s",
          differentiate_zero_phase(displacement->samples, record.sample_time, cutoff),
          fmt::format("derived from displacement, {:.3g} Hz zero-phase", cutoff)};
}

/// The curves of one record; channels that are missing are null.
Value curves_json(const Record& record, DriveUnit drive_unit, const Channel& derived,
                  std::size_t points) {
  const std::pair<const char*, const Channel*> shown[] = {
      {"displacement", record.find("displacement")},
      {"velocity", record.find("velocity")},
      {"force", record.find("force")},
      {"drive", record.find(drive_channel(drive_unit))},
      {"derived_velocity", derived.samples.empty() ? nullptr : &derived}};
  std::vector<std::span<const double>> leading{record.time};
  for (const auto& [name, channel] : shown)
    if (channel) leading.push_back(channel->samples);
  const std::vector<std::size_t> chosen = thinned_indices(leading, points);
  Value series = Value::object({{"time", pack_float32(record.time, chosen)}});
  for (const auto& [name, channel] : shown)
    series.add(name, channel ? pack_int16(channel->samples, chosen) : Value());
  return series;
}

void add_range(Value& json, const Channel* channel, const std::string& low,
               const std::string& high) {
  if (!channel || channel->samples.empty()) return;
  const auto [least, greatest] = std::ranges::minmax(channel->samples);
  json.add(low, least);
  json.add(high, greatest);
}

std::string role_name(Role role) {
  return role == Role::Training ? "training" : role == Role::LeftOut ? "left out" : "";
}

Value record_json(const Record& record, DriveUnit drive_unit, std::size_t points) {
  const Channel derived = derived_velocity(record);
  const Channel* velocity = record.find("velocity");
  Value json =
      Value::object({{"name", record.name},
                     {"condition", record.condition},
                     {"source", record.source},
                     {"drive_level", record.drive_level ? Value(*record.drive_level) : Value()},
                     {"samples", record.size()},
                     {"duration", record.size() ? record.time.back() - record.time.front() : 0.0},
                     {"rate", record.sample_time > 0 ? Value(1 / record.sample_time) : Value()},
                     {"role", role_name(record.role)},
                     {"notes", Value::array(record.notes)},
                     {"velocity_origin", velocity ? velocity->origin : ""},
                     {"derived_origin", derived.origin},
                     {"series", curves_json(record, drive_unit, derived, points)}});
  add_range(json, record.find("displacement"), "displacement_min", "displacement_max");
  add_range(json, record.find("force"), "force_min", "force_max");
  if (velocity && velocity->samples.size()) {
    const auto [least, greatest] = std::ranges::minmax(velocity->samples);
    json.add("speed_max", std::max(std::abs(least), std::abs(greatest)));
  }
  return json;
}

Value readings_json(const Dataset& dataset) {
  Value readings = Value::array();
  for (const ColumnReading& r : dataset.readings)
    readings.push_back(Value::object({{"file", r.file},
                                      {"column", r.column},
                                      {"channel", r.channel},
                                      {"unit", r.unit},
                                      {"factor", r.factor},
                                      {"basis", r.basis}}));
  return readings;
}

}  // namespace

std::string inspect_html(const Dataset& dataset, const std::string& command,
                         const std::string& date) {
  const auto points = static_cast<std::size_t>(
      kPointsOfPage / static_cast<double>(std::max<std::size_t>(1, dataset.records.size())));
  Value records = Value::array();
  for (const Record& record : dataset.records)
    records.push_back(record_json(record, dataset.drive_unit, points));
  const std::string display = fmt::format(
      "Up to {} samples of a record are shown; of longer ones, the least and greatest values of "
      "every "
      "stretch.",
      points);
  const Value data = Value::object({{"page", "inspect"},
                                    {"date", date},
                                    {"version", DASHPOT_VERSION},
                                    {"command", command},
                                    {"dataset", dataset_json(dataset)},
                                    {"readings", readings_json(dataset)},
                                    {"records", std::move(records)},
                                    {"series", Value::object({{"display", display}})}});
  return make_page(dataset.name + ", recordings", describe(dataset), presentable(data));
}

}  // namespace dashpot
