#pragma once

#include <limits>
#include <numbers>

namespace dashpot {

constexpr double kTurn = 2 * std::numbers::pi;  ///< radians
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

}  // namespace dashpot
