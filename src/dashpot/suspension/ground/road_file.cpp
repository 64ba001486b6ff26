#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/error.h"
#include "dashpot/record/readers/reader.h"
#include "dashpot/suspension/ground/deterministic.h"
#include "dashpot/suspension/ground/earthquake.h"
#include "dashpot/suspension/ground/road_profile.h"

namespace dashpot {
namespace {

/// "(ft)" at the end of a column's name, else what is stated.
std::string unit_text(const RawColumn& column, std::string_view stated) {
  if (!stated.empty()) return std::string(stated);
  if (!column.unit.empty()) return column.unit;
  const std::size_t open = column.name.rfind('('), close = column.name.rfind(')');
  if (open != std::string::npos && close != std::string::npos && close > open)
    return column.name.substr(open + 1, close - open - 1);
  return "m";
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

std::vector<double> in_metres(const RawColumn& column, std::string_view stated,
                              const std::string& file) {
  const std::vector<double>& numbers = numbers_of(column, file);
  const Unit unit = require_unit(unit_text(column, stated), file);
  if (unit.dimension != require_unit("m", file).dimension)
    throw Error(file, "'" + column.name + "' is counted in " + unit_text(column, stated),
                "a length, as m, ft or in");
  std::vector<double> values;
  for (const double value : numbers) values.push_back(unit.factor * value);
  return values;
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

void require_rising(const std::vector<double>& values, const std::string& file, const char* what) {
  if (values.size() < 3)
    throw Error(file, "has " + std::to_string(values.size()) + " rows", "three at least");
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(values[k] > values[k - 1]))
      throw Error(file, std::string(what) + " does not rise in row " + std::to_string(k + 1));
}

}  // namespace

RoadProfile load_road(const std::filesystem::path& path, std::string_view distance_unit,
                      std::string_view height_unit) {
  const std::string file = path.string();
  const RawTable table = read_tables(path).front();
  if (table.columns.size() < 2 || table.columns.size() % 2 != 0)
    throw Error(file, "has " + std::to_string(table.columns.size()) + " columns",
                "distance and height, in pairs: one per track");

  // The first track's distances give the spacing and the count of all.
  RoadProfile road{"measured road " + path.filename().string(), 0, {}};
  std::size_t count = 0;
  for (std::size_t k = 0; k < table.columns.size(); k += 2) {
    const std::vector<double> way = in_metres(table.columns[k], distance_unit, file);
    require_rising(way, file, "the distance");
    if (k == 0) {
      road.spacing = (way.back() - way.front()) / static_cast<double>(way.size() - 1);
      count = way.size();
    }
    road.tracks.push_back(
        resampled(way, in_metres(table.columns[k + 1], height_unit, file), road.spacing, count));
  }
  return road;
}

GroundPointer load_earthquake(const std::filesystem::path& path, std::string_view unit_stated,
                              double time_scale) {
  const std::string file = path.string();
  const RawTable table = read_tables(path).front();
  if (table.columns.size() < 2)
    throw Error(file, "has " + std::to_string(table.columns.size()) + " columns",
                "time and acceleration");

  // Time and acceleration, in SI.
  const std::vector<double>& time = numbers_of(table.columns[0], file);
  require_rising(time, file, "the time");
  const Unit unit = require_unit(unit_stated.empty() ? "m/s^2" : unit_stated, file);
  if (unit.dimension != require_unit("m/s^2", file).dimension)
    throw Error(file, "'" + std::string(unit_stated) + "' does not count an acceleration",
                "m/s^2 or g0");
  std::vector<double> acceleration;
  for (const double a : numbers_of(table.columns[1], file)) acceleration.push_back(unit.factor * a);

  // Equal steps of time, to a tenth of a step.
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (std::size_t k = 1; k < time.size(); ++k)
    if (std::abs(time[k] - time[0] - step * static_cast<double>(k)) > 0.1 * step)
      throw Error(file, "its time steps are not equal, at row " + std::to_string(k + 1));

  return shaking_ground(path.filename().string() + ", time scale " + format_number(time_scale),
                        step * time_scale, std::move(acceleration));
}

}  // namespace dashpot
