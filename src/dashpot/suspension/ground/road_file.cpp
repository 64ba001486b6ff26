#include <algorithm>
#include <cmath>
#include <optional>

#include "dashpot/base/sensor_unit.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/channel_names.h"
#include "dashpot/record/readers/reader.h"
#include "dashpot/suspension/ground/deterministic.h"
#include "dashpot/suspension/ground/earthquake.h"
#include "dashpot/suspension/ground/road_profile.h"

namespace dashpot {
namespace {

constexpr Dimension kOfLength{0, 1, 0, 0, 0}, kOfTime{0, 0, 1, 0, 0},
    kOfAcceleration{0, 1, -2, 0, 0};

/// What stands in the last brackets of a name, which may hold others: "ft" of "track (2 (left)) -
/// way (ft)". Nothing where there are none.
std::optional<std::string_view> in_last_brackets(std::string_view name) {
  const std::size_t close = name.find_last_of("])");
  if (close == std::string_view::npos) return std::nullopt;
  int depth = 0;
  for (std::size_t k = close + 1; k-- > 0;) {
    if (name[k] == ']' || name[k] == ')') ++depth;
    if ((name[k] == '[' || name[k] == '(') && --depth == 0)
      return trim(name.substr(k + 1, close - k - 1));
  }
  return std::nullopt;
}

/// The unit that a column states: below its name, in brackets behind it ("height [mm]"), or behind
/// its last underscore ("z_mm"); "" where it states none. "(2)" counts columns and is none, and so
/// is a capital behind the underscore that is no unit of what is `wanted`: "height_A" is of track
/// A.
std::string unit_of(const RawColumn& column, const Dimension& wanted) {
  if (!column.unit.empty()) return column.unit;
  const std::string_view name = trim(column.name);
  if (const auto inside = in_last_brackets(name))
    return parse_number(*inside) ? "" : std::string(*inside);
  const std::size_t mark = name.rfind('_');
  if (mark == std::string_view::npos || mark == 0) return {};
  const std::string_view ending = name.substr(mark + 1);
  const std::optional<Unit> unit = parse_unit(ending);
  const bool is_label = ending.size() == 1 && ending[0] >= 'A' && ending[0] <= 'Z';
  if (!unit || parse_number(ending) || (is_label && unit->dimension != wanted)) return {};
  return std::string(ending);
}

/// What is stated, else what the column states, else `si`; of the dimension of `si`.
Unit unit_for(const RawColumn& column, std::string_view stated, std::string_view si,
              const std::string& file, const std::string& right) {
  const Dimension wanted = require_unit(si, file).dimension;
  std::string text(stated.empty() ? unit_of(column, wanted) : stated);
  if (text.empty()) text = si;
  const std::optional<Unit> unit = parse_sensor_unit(text);
  if (!unit || unit->dimension != wanted)
    throw Error(file, "'" + column.name + "' is counted in '" + text + "'", right);
  return *unit;
}

/// Throws Error where a cell is no number, or one that no road and no earthquake has.
const std::vector<double>& numbers_of(const RawColumn& column, const std::string& file) {
  constexpr double kGreatest = 1e9;
  const auto refused = [&](std::size_t row, const std::string& what) {
    return Error(file, "row " + std::to_string(row + 1) + " of '" + column.name + "' is " + what);
  };
  if (column.bad) throw refused(column.bad->row, "no number");
  for (std::size_t k = 0; k < column.values.size(); ++k)
    if (!(std::abs(column.values[k]) <= kGreatest))
      throw refused(k, format_number(column.values[k]));
  return column.values;
}

void require_rising(const std::vector<double>& values, const std::string& file, const char* what) {
  if (values.size() < 3)
    throw Error(file, "has " + std::to_string(values.size()) + " rows", "three at least");
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(values[k] > values[k - 1]))
      throw Error(file, std::string(what) + " does not rise in row " + std::to_string(k + 1));
}

std::vector<double> in_metres(const RawColumn& column, std::string_view stated,
                              const std::string& file) {
  const double factor =
      unit_for(column, stated, "m", file, "a length: m, mm, ft or in, there or as height_unit=mm")
          .factor;
  std::vector<double> values;
  for (const double value : numbers_of(column, file)) values.push_back(factor * value);
  return values;
}

/// Seconds. Steps of half a second and more without a unit are samples or milliseconds.
std::vector<double> in_seconds(const RawColumn& column, const std::string& file) {
  constexpr double kLongest = 0.5;
  const double factor = unit_for(column, {}, "s", file, "a time: s or ms").factor;
  std::vector<double> values;
  for (const double value : numbers_of(column, file)) values.push_back(factor * value);
  require_rising(values, file, "the time");
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  if (unit_of(column, kOfTime).empty() && step >= kLongest)
    throw Error(file,
                "its time has no unit and steps of " + format_number(step) +
                    ", which are no seconds of an earthquake",
                "name the column 'time [ms]', or write its seconds");
  return values;
}

/// A road is heights over distance: a column that is named a time is not taken for metres.
void require_distance(const RawColumn& column, std::string_view stated, const std::string& file) {
  if (stated.empty() && recognise_channel(column.name, column.unit).channel == "time")
    throw Error(file, "'" + column.name + "' is a time, and a road is heights over distance",
                "a distance (time times speed); distance_unit=m where it is one");
}

/// The mean step where all are alike to a tenth, as in a profiler's file. Else a quarter of the
/// least step, so that of what a point stands above its neighbours an eighth is lost at most.
double spacing_of(const std::vector<double>& way, const std::string& file) {
  constexpr double kMostPoints = 1e7;
  const double length = way.back() - way.front();
  const double mean = length / static_cast<double>(way.size() - 1);
  double least = mean, greatest = mean;
  for (std::size_t k = 1; k < way.size(); ++k) {
    least = std::min(least, way[k] - way[k - 1]);
    greatest = std::max(greatest, way[k] - way[k - 1]);
  }
  if (least >= 0.9 * mean && greatest <= 1.1 * mean) return mean;

  // Uneven: as fine as the least step asks for, within reason.
  if (length > 0.25 * least * kMostPoints)
    throw Error(file,
                "its distance has steps from " + format_number(least, 3) + " to " +
                    format_number(greatest, 3) + " m",
                "steps that are more alike");
  return length / std::ceil(length / (0.25 * least));
}

/// Tracks lie side by side: a second one that begins or ends elsewhere than the first, by more than
/// a step, would be shifted or cut. Throws Error with where both lie.
void require_beside(const std::vector<double>& first, const std::vector<double>& other,
                    const std::string& file) {
  const auto mean_step = [](const std::vector<double>& way) {
    return (way.back() - way.front()) / static_cast<double>(way.size() - 1);
  };
  const double step = std::max(mean_step(first), mean_step(other));
  if (std::abs(other.front() - first.front()) <= step &&
      std::abs(other.back() - first.back()) <= step)
    return;
  const auto range = [](const std::vector<double>& way) {
    return format_number(way.front()) + " to " + format_number(way.back()) + " m";
  };
  throw Error(file, "its first track is from " + range(first) + ", another from " + range(other),
              "tracks that begin and end at the same distances");
}

/// Heights at equal steps of the way, straight between the samples, from 0.
std::vector<double> resampled(const std::vector<double>& way, const std::vector<double>& height,
                              double spacing, std::size_t count) {
  std::vector<double> out;
  std::size_t k = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double s = way.front() + spacing * static_cast<double>(i);
    while (k + 2 < way.size() && way[k + 1] < s) ++k;
    const double share = std::clamp((s - way[k]) / (way[k + 1] - way[k]), 0.0, 1.0);
    out.push_back(height[k] + share * (height[k + 1] - height[k]) - height[0]);
  }
  return out;
}

}  // namespace

RoadProfile load_road(const std::filesystem::path& path, std::string_view distance_unit,
                      std::string_view height_unit) {
  const std::string file = path.string();
  const RawTable table = read_tables(path).front();
  if (table.columns.size() < 2 || table.columns.size() % 2 != 0)
    throw Error(file, "has " + std::to_string(table.columns.size()) + " columns",
                "distance and height, in pairs: one per track");

  // The least spacing of all tracks serves each; the road is as long as its first.
  RoadProfile road{"measured road " + path.filename().string(), 0, {}};
  std::vector<std::vector<double>> ways;
  for (std::size_t k = 0; k < table.columns.size(); k += 2) {
    require_distance(table.columns[k], distance_unit, file);
    ways.push_back(in_metres(table.columns[k], distance_unit, file));
    require_rising(ways.back(), file, "the distance");
    require_beside(ways.front(), ways.back(), file);
    const double spacing = spacing_of(ways.back(), file);
    road.spacing = k == 0 ? spacing : std::min(road.spacing, spacing);
  }
  const double length = ways.front().back() - ways.front().front();
  const std::size_t count = static_cast<std::size_t>(std::lround(length / road.spacing)) + 1;
  for (std::size_t k = 0; k < ways.size(); ++k)
    road.tracks.push_back(resampled(ways[k], in_metres(table.columns[2 * k + 1], height_unit, file),
                                    road.spacing, count));

  // Whoever reads the result sees whether the units were the right ones.
  double lowest = 0, highest = 0;
  for (const std::vector<double>& track : road.tracks) {
    const auto [low, high] = std::ranges::minmax(track);
    lowest = std::min(lowest, low);
    highest = std::max(highest, high);
  }
  road.description += ", " + format_number(length, 4) + " m, heights over " +
                      format_number(1e3 * (highest - lowest), 3) + " mm";
  if (height_unit.empty() && unit_of(table.columns[1], kOfLength).empty())
    road.description += " (its column '" + table.columns[1].name + "' names no unit: taken as m)";
  return road;
}

GroundPointer load_earthquake(const std::filesystem::path& path, std::string_view unit_stated,
                              double time_scale) {
  const std::string file = path.string();
  const RawTable table = read_tables(path).front();
  if (table.columns.size() != 2)
    throw Error(file, "has " + std::to_string(table.columns.size()) + " columns",
                "two: time and the acceleration of one direction");

  // Time and acceleration, in SI.
  const std::vector<double> time = in_seconds(table.columns[0], file);
  const RawColumn& shaking = table.columns[1];
  const double factor = unit_for(shaking, unit_stated, "m/s^2", file,
                                 "an acceleration: m/s^2, cm/s^2 or g0, there or as unit=g0")
                            .factor;
  std::vector<double> acceleration;
  double greatest = 0;
  for (const double a : numbers_of(shaking, file)) {
    acceleration.push_back(factor * a);
    greatest = std::max(greatest, std::abs(acceleration.back()));
  }

  // Equal steps of time, to a tenth of a step.
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (std::size_t k = 1; k < time.size(); ++k)
    if (std::abs(time[k] - time[0] - step * static_cast<double>(k)) > 0.1 * step)
      throw Error(file, "its time steps are not equal, at row " + std::to_string(k + 1),
                  "one step all along");

  // Whoever reads the result sees whether the unit was the right one.
  const bool silent = unit_stated.empty() && unit_of(shaking, kOfAcceleration).empty();
  return shaking_ground(
      path.filename().string() + ", greatest acceleration " + format_number(greatest, 3) +
          " m/s^2" +
          (silent ? " (its column '" + shaking.name + "' names no unit: taken as m/s^2)" : "") +
          ", time scale " + format_number(time_scale),
      step * time_scale, std::move(acceleration));
}

}  // namespace dashpot
