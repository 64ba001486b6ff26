#include "dashpot/damper/inverse/numeric.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/damper/inverse/first_root.h"

namespace dashpot {
namespace {

constexpr int kCells = 8;             // of the current range, each searched for a crossing
constexpr double kTolerance = 1e-5;   // of the force's change over a bracket
constexpr double kNegligible = 1e-6;  // of the current's largest effect

}  // namespace

NumericInverse::NumericInverse(const DamperModel& forward, const InverseLimits& limits)
    : InverseModel(limits), observer_(forward, limits) {}

void NumericInverse::rest(const DamperInput& input, std::span<double> state) const noexcept {
  observer_.rest(input, state);
  state[observer_.state_size()] = input.current;
  state[observer_.state_size() + 1] = 0;
}

double NumericInverse::wanted_current(const InverseInput& input, std::span<double> state) const noexcept {
  observer_.follow(input, state);
  double& last = state[observer_.state_size()];
  double& trend = state[observer_.state_size() + 1];
  const double low = limits().current_min, range = limits().current_max - low;
  const auto error = [&](double current) { return observer_.force(current, input, state) - input.wanted; };

  // Beside the last solution first, on the same side of a force that rises and falls with current.
  if (trend != 0) {
    Bracket near{std::max(low, last - range / (2 * kCells)),
                 std::min(limits().current_max, last + range / (2 * kCells)), 0, 0};
    near.f_low = error(near.low);
    near.f_high = error(near.high);
    if (near.holds() && (near.f_high > near.f_low) == (trend > 0))
      return last = crossing(error, near, kTolerance);
  }
  std::array<double, kCells + 1> places;
  for (int k = 0; k <= kCells; ++k) places[k] = k < kCells ? low + range * k / kCells : limits().current_max;
  const FirstRoot found = first_root(error, places, kTolerance);
  trend = !found.crosses ? 0 : found.rises ? 1 : -1;
  if (!found.crosses && found.variation <= kNegligible * observer_.current_effect()) return input.current;
  return last = found.place;
}

}  // namespace dashpot
