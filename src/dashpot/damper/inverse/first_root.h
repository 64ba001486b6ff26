#pragma once
#include <algorithm>
#include <cmath>
#include <span>

namespace dashpot {

/// A function's values at two places.
struct Bracket {
  double low, high;
  double f_low, f_high;
  bool holds() const noexcept { return (f_low <= 0) != (f_high <= 0) && !std::isnan(f_low + f_high); }
};

/// Where f crosses zero in a bracket that holds a crossing: secants that keep the bracket (Illinois), halving
/// it where they gain little. Right for a jump, too.
template <class Function>
double crossing(const Function& f, Bracket b, double tolerance) noexcept {
  constexpr int kMostSteps = 60;
  constexpr double kNarrow = 1e-12;
  const double enough = tolerance * std::abs(b.f_high - b.f_low), narrow = kNarrow * (b.high - b.low);
  int kept = 0;  // -1: the low end was kept by the last step, 1: the high end
  for (int k = 0; k < kMostSteps; ++k) {
    const double share = b.f_low / (b.f_low - b.f_high);
    const double x =
        k % 8 == 7 || !(share > 0 && share < 1) ? 0.5 * (b.low + b.high) : b.low + share * (b.high - b.low);
    const double f_x = f(x);
    if (!(std::abs(f_x) > enough) || b.high - b.low <= narrow) return x;
    if ((f_x <= 0) == (b.f_low <= 0)) {
      b.low = x;
      b.f_low = f_x;
      if (kept == 1) b.f_high *= 0.5;
      kept = 1;
    } else {
      b.high = x;
      b.f_high = f_x;
      if (kept == -1) b.f_low *= 0.5;
      kept = -1;
    }
  }
  return 0.5 * (b.low + b.high);
}

/// What a search along increasing places found.
struct FirstRoot {
  double place = 0;      ///< of the first crossing, or else where |f| is least
  bool crosses = false;  ///< f crosses zero there
  bool rises = false;    ///< ... upwards
  double variation = 0;  ///< greatest less least f, where nothing crosses
};

/// The first crossing between neighbours of `places` (increasing, at least two), or where f comes nearest to
/// zero.
template <class Function>
FirstRoot first_root(const Function& f, std::span<const double> places, double tolerance) noexcept {
  Bracket b{places[0], places[0], f(places[0]), 0};
  double nearest = std::abs(b.f_low), least = b.f_low, greatest = b.f_low;
  FirstRoot found{.place = places[0]};
  for (std::size_t k = 1; k < places.size(); ++k) {
    b.high = places[k];
    b.f_high = f(b.high);
    if (b.holds()) return {crossing(f, b, tolerance), true, b.f_high > b.f_low, 0};
    if (std::abs(b.f_high) < nearest) {
      nearest = std::abs(b.f_high);
      found.place = b.high;
    }
    least = std::min(least, b.f_high);
    greatest = std::max(greatest, b.f_high);
    b.low = b.high;
    b.f_low = b.f_high;
  }
  found.variation = greatest - least;
  return found;
}

}  // namespace dashpot
