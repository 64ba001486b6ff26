#include "dashpot/physics/read_points.h"

#include <algorithm>
#include <string>

#include "dashpot/base/read_quantity.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

CurvePoints read_points(const Value& value, std::string_view first_unit,
                        std::string_view second_unit) {
  CurvePoints points;
  for (const Value& item : value.items()) {
    if (item.items().size() != 2)
      throw Error(item.where(), "is no pair",
                  "two numbers, " + std::string(first_unit) + " and " + std::string(second_unit));
    const double first = read_quantity(item.items()[0], first_unit);
    if (!points.empty() && !(first > points.back().first))
      throw Error(item.where(),
                  "the points are out of order: " + format_number(first) + " " +
                      std::string(first_unit) + " comes after " +
                      format_number(points.back().first) + " " + std::string(first_unit),
                  "points that go upwards");
    points.emplace_back(first, read_quantity(item.items()[1], second_unit));
  }
  if (points.size() < 2) throw Error(value.where(), "has no curve", "two points at least");
  return points;
}

void require_rising(const CurvePoints& points, const Value& at, std::string_view what,
                    bool strictly) {
  const std::string name(what);
  if (points.front().first != 0)
    throw Error(at.where(), name + " begins at " + format_number(points.front().first),
                "a first point at 0");
  if (points.front().second < 0)
    throw Error(at.where(), name + " is " + format_number(points.front().second), "0 or more");
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double before = points[k - 1].second, now = points[k].second;
    if (now > before || (now == before && !strictly)) continue;
    throw Error(at.items()[k].where(),
                name + (now < before ? " falls from " : " stays at ") + format_number(before) +
                    (now < before ? " to " + format_number(now) : "") +
                    " as the field grows from " + format_number(points[k - 1].first) + " to " +
                    format_number(points[k].first) + " A/m",
                strictly ? "a curve that rises" : "a curve that rises or holds");
  }
}

double curve_at(const CurvePoints& points, double x) noexcept {
  for (std::size_t k = 1; k < points.size(); ++k) {
    const auto &a = points[k - 1], &b = points[k];
    if (x < b.first) return a.second + (b.second - a.second) * (x - a.first) / (b.first - a.first);
  }
  return points.back().second;
}

Value points_json(const CurvePoints& points) {
  Value list = Value::array();
  for (const auto& [first, second] : points)
    list.push_back(Value::array(std::vector<double>{first, second}));
  return list;
}

}  // namespace dashpot
