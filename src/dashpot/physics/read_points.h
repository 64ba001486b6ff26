#pragma once
#include <string_view>
#include <utility>
#include <vector>

#include "dashpot/value.h"

namespace dashpot {

using CurvePoints = std::vector<std::pair<double, double>>;

/// A curve from "[[0 A/m, 0 T], [100 A/m, 0.2 T]]": pairs of numbers in these SI units or with a
/// unit of their own, whose first goes up from one to the next. Throws Error at the pair that does
/// not, and where there are fewer than two.
CurvePoints read_points(const Value& value, std::string_view first_unit,
                        std::string_view second_unit);
/// Refuses a curve that does not begin at a first number of 0, or whose second number falls (or, if
/// `strictly`, stays) from one point to the next; `what` names the second number.
void require_rising(const CurvePoints& points, const Value& at, std::string_view what,
                    bool strictly);
/// Straight between the points, held beyond the ends.
double curve_at(const CurvePoints& points, double x) noexcept;
Value points_json(const CurvePoints& points);

}  // namespace dashpot
