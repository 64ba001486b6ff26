#include "dashpot/suspension/ground/recorded_ground.h"

#include <algorithm>
#include <array>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/parameter_table.h"
#include "dashpot/suspension/ground/earthquake.h"
#include "dashpot/suspension/ground/road_profile.h"

namespace dashpot {
namespace {

using Values = std::span<const std::string>;

GroundPointer make_earthquake(Values v, const std::string& where) {
  constexpr ParameterRow kScale{"time_scale", "1", 1, 1e-3, 1e3, ""};
  return load_earthquake(v[0], v[1], parse_value(kScale, v[2], where));
}

GroundPointer make_measured(Values v, const std::string& where) {
  constexpr ParameterRow kSpeed{"speed", "m/s", 20, 0.1, 200, ""};
  return drive_over(load_road(v[0], v[2], v[3]), parse_value(kSpeed, v[1], where));
}

const std::array kRecorded{
    RecordedGround{
        .name = "earthquake",
        .title = "Recorded ground acceleration",
        .remarks = "For buildings; a file with time and acceleration at equal steps.",
        .settings = {{"file", "with the record", ""},
                     {"unit", "where the column names none: m/s^2, cm/s^2, g0", ""},
                     {"time_scale", "0.2: five times as fast, for a model of a fifth of the size",
                      "1"}},
        .make = make_earthquake},
    RecordedGround{.name = "measured",
                   .title = "Measured road profile",
                   .remarks = "Distance and height in columns, in pairs: one per track.",
                   .settings = {{"file", "with the profile", ""},
                                {"speed", "of the vehicle", "20 m/s"},
                                {"distance_unit", "where the column names none: m, ft", ""},
                                {"height_unit", "where the column names none: m, mm, in", ""}},
                   .make = make_measured}};

}  // namespace

std::span<const RecordedGround> recorded_grounds() { return kRecorded; }

GroundPointer make_recorded_ground(const RecordedGround& kind, std::span<const std::string> parts,
                                   const std::string& where) {
  std::vector<std::string> values, known;
  for (const auto& [name, meaning, value] : kind.settings) {
    values.emplace_back(value);
    known.emplace_back(name);
  }

  // Each part replaces the default of the setting that it names.
  for (const std::string& part : parts) {
    const std::size_t equals = part.find('=');
    const std::string name(trim(part.substr(0, equals)));
    const auto found = std::ranges::find(known, name);
    if (found == known.end() || equals == std::string::npos)
      throw Error(where, std::string(kind.name) + " has no parameter '" + name + "'",
                  suggest(name, known));
    values[static_cast<std::size_t>(found - known.begin())] = trim(part.substr(equals + 1));
  }

  if (values.front().empty())
    throw Error(where, std::string(kind.name) + " names no file",
                std::string(kind.name) + ",file=...");
  return kind.make(values, where);
}

}  // namespace dashpot
