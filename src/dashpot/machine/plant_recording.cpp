#include "dashpot/machine/plant_recording.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "dashpot/base/sensor_unit.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/reader.h"

namespace dashpot {
namespace {

/// A column's name and the unit that stands in it.
struct NameAndUnit {
  std::string name, unit;
};

NameAndUnit name_and_unit(const RawColumn& column) {
  const std::string_view text = trim(column.name);
  const std::size_t open = text.find_first_of("[(");
  if (open == std::string_view::npos || (text.back() != ']' && text.back() != ')'))
    return {std::string(text), column.unit};
  return {std::string(trim(text.substr(0, open))),
          std::string(trim(text.substr(open + 1, text.size() - open - 2)))};
}

bool is_time(std::string_view name) {
  const std::string word = lower(name);
  return word == "time" || word == "t" || word == "t_s" || word == "time_s";
}

/// The unit in which a quantity of this dimension is kept.
std::string si_text(const Unit& unit) {
  static constexpr std::string_view kSi[] = {"1", "m", "m/s", "m/s^2", "N", "rad", "rad/s",
                                             "A", "V", "s",   "kg",    "K", "Pa"};
  for (const std::string_view si : kSi)
    if (const auto known = parse_unit(si); known && known->dimension == unit.dimension)
      return std::string(si);
  return "SI";
}

bool is_of_drive(const std::string& text) {
  const auto unit = parse_unit(text);
  return unit && (unit->dimension == parse_unit("A")->dimension ||
                  unit->dimension == parse_unit("V")->dimension);
}

/// The step of stamps that lie on a uniform grid to a hundredth of it, as logs of few digits do; 0
/// where they do not. A step that is a whole rate to a millionth is exactly that.
double mean_step(std::span<const double> stamps) {
  constexpr double kJitter = 0.01, kSame = 1e-6;
  if (stamps.size() < 2) return 0;
  const double step = (stamps.back() - stamps.front()) / static_cast<double>(stamps.size() - 1);
  for (std::size_t k = 0; k < stamps.size(); ++k)
    if (!(std::abs(stamps[k] - stamps.front() - step * static_cast<double>(k)) <= kJitter * step))
      return 0;
  const double rate = std::round(1 / step);
  return rate >= 1 && std::abs(rate * step - 1) < kSame ? 1 / rate : step;
}

/// Throws Error that names the first step which is not the usual one.
[[noreturn]] void refuse_steps(const RawTable& table, std::span<const double> stamps,
                               double factor) {
  constexpr double kUnusual = 0.02;
  std::vector<double> steps;
  for (std::size_t k = 1; k < stamps.size(); ++k) steps.push_back(stamps[k] - stamps[k - 1]);
  const std::string right =
      "sample the plant at one rate, or resample the recording; at a gap cut it into two files";
  if (steps.empty()) throw Error(table.file, "has no two samples", right);
  std::vector<double> sorted = steps;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  const auto odd = std::ranges::find_if(
      steps, [&](double step) { return !(std::abs(step - *middle) <= kUnusual * *middle); });
  if (odd == steps.end()) throw Error(table.file, "its time stamps are not uniform", right);
  throw Error(table.where(static_cast<std::size_t>(odd - steps.begin()) + 1),
              "its time stamps are not uniform: here they go on by " +
                  format_number(factor * *odd, 3) + " s, elsewhere by " +
                  format_number(factor * *middle, 3) + " s",
              right);
}

/// Steps of half a second and more are samples or a logger's ms, whatever unit stands above them:
/// no plant of a damper is recorded so slowly.
void require_plausible_step(const RawTable& table, const NameAndUnit& time, double step) {
  constexpr double kLongest = 0.5;  // s
  if (step < kLongest) return;
  const bool has_unit = !time.unit.empty();
  throw Error(table.file,
              (has_unit ? "time in " + time.unit + " has steps of " + format_number(step, 3) + " s"
                        : "time has no unit and steps of " + format_number(step, 3)) +
                  ", which are no seconds of a plant",
              "name the column '" + time.name + " [ms]', or write its seconds");
}

void require_numbers(const RawTable& table, const RawColumn& column) {
  if (!column.bad) return;
  throw Error(table.where(column.bad->row),
              "'" + column.name + "' is '" + column.bad->text + "', not a number",
              "write it as 12.5; a plant is run through all samples, so fill a gap, or cut the "
              "recording there into two files");
}

}  // namespace

const Channel& PlantRecording::channel(std::string_view wanted) const {
  std::vector<std::string> known;
  for (const Channel& channel : channels) {
    if (channel.name == wanted) return channel;
    known.push_back(channel.name);
  }
  throw Error(name, "has no channel '" + std::string(wanted) + "'", suggest(wanted, known));
}

std::string without_units(std::span<const PlantRecording> recordings) {
  std::vector<std::string> names;
  for (const PlantRecording& recording : recordings)
    for (const std::string& name : recording.without_unit)
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  if (names.empty()) return {};
  return join(names, ", ") + ": no unit in the columns' names, taken as SI; name them with it, " +
         "as 'level [mm]' or 'coil [A]'";
}

std::string unread_drives(std::span<const PlantRecording> recordings) {
  for (const PlantRecording& recording : recordings)
    if (!recording.unread_drives.empty())
      return join(recording.unread_drives, ", ") +
             ": not read, as the plant's file names no channel that drives the damper; state it "
             "as 'current: NAME' or 'voltage: NAME' if it does";
  return {};
}

PlantRecording read_plant_recording(const std::filesystem::path& path,
                                    const std::vector<std::string>& wanted,
                                    const std::vector<std::string>& also) {
  // One table per file.
  std::vector<RawTable> tables = read_tables(path);
  if (tables.size() != 1)
    throw Error(path.string(), "holds " + std::to_string(tables.size()) + " tables",
                "one recording of the plant per file");
  PlantRecording recording = plant_recording(std::move(tables.front()), wanted, also);
  recording.name = path.filename().string();
  return recording;
}

PlantRecording plant_recording(RawTable table, const std::vector<std::string>& wanted,
                               const std::vector<std::string>& also) {
  PlantRecording recording{.name = table.file, .samples = table.rows()};

  // Its time base: stated by the format, or by a column of time.
  if (table.sample_time) recording.sample_time = *table.sample_time;
  NameAndUnit timed;
  for (const RawColumn& column : table.columns) {
    const auto [name, unit] = name_and_unit(column);
    if (!is_time(name) || recording.sample_time > 0) continue;
    require_numbers(table, column);
    timed = {name, unit};
    const double factor = unit.empty() ? 1 : require_unit(unit, table.file + ", time").factor;
    recording.sample_time = factor * mean_step(column.values);
    if (recording.sample_time <= 0) refuse_steps(table, column.values, factor);
  }
  if (recording.sample_time <= 0)
    throw Error(table.file, "has no column of time (it has " + table.column_list() + ")",
                "name one 'time [s]'");

  // The channels that are asked for, in SI.
  for (RawColumn& column : table.columns) {
    const auto [name, unit] = name_and_unit(column);
    if (std::ranges::find(wanted, name) == wanted.end() &&
        std::ranges::find(also, name) == also.end()) {
      if (is_of_drive(unit)) recording.unread_drives.push_back(column.name);
      continue;
    }
    require_numbers(table, column);
    if (std::ranges::find(recording.channels, name, &Channel::name) != recording.channels.end())
      throw Error(table.file, "has two columns '" + name + "' (it has " + table.column_list() + ")",
                  "another name for the one that is not meant");
    const std::string where = table.file + ", column '" + column.name + "'";
    Channel channel{.name = name, .unit = "SI", .samples = std::move(column.values), .origin = {}};
    if (unit.empty()) {
      channel.origin = "column " + name + ", taken as SI: no unit given";
      recording.without_unit.push_back(name);
    } else {
      const std::optional<Unit> known = parse_sensor_unit(unit);
      const Unit of = known ? *known : require_unit(unit, where);
      for (double& value : channel.samples) value = of.factor * value + of.offset;
      channel.unit = si_text(of);
      channel.origin = "column " + name + ", " + unit;
    }
    recording.channels.push_back(std::move(channel));
  }
  for (const std::string& name : wanted)
    if (std::ranges::find(recording.channels, name, &Channel::name) == recording.channels.end())
      throw Error(table.file, "has no column '" + name + "'", "it has " + table.column_list());
  if (!timed.name.empty()) require_plausible_step(table, timed, recording.sample_time);
  return recording;
}

}  // namespace dashpot
