#pragma once
#include <cmath>

namespace dashpot {

/// One end of a bracket: a place and the function's value there.
struct RootEnd {
  double x, value;
};

/// Finds where f is within `tolerance` of 0, between a place where it is negative (`low`) and one
/// where it is not (`high`). Regula falsi with Illinois' weights (Dowell and Jarratt 1971), at most
/// 100 evaluations. f may be of any type that is called with a double.
template <class Function>
double find_root(Function f, RootEnd low, RootEnd high, double tolerance) {
  constexpr int kMost = 100;
  double x = high.x;
  for (int k = 0, side = 0; k < kMost && high.value > tolerance; ++k) {
    // The secant through both ends; where it no longer moves, the tolerance is below rounding.
    x = (low.x * high.value - high.x * low.value) / (high.value - low.value);
    const double value = f(x);
    if (std::abs(value) <= tolerance || x == low.x || x == high.x) break;

    // The new point replaces the end of its own sign. An end that stays twice gets half its weight
    // (Illinois), else convergence would be linear from one side.
    const int now = value < 0 ? -1 : 1;
    (value < 0 ? low : high) = {x, value};
    if (side == now) (value < 0 ? high : low).value *= 0.5;  // the end that stays draws less
    side = now;
  }
  return x;
}

}  // namespace dashpot
