#include "dashpot/damper/kinds/family/steady_sine.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dashpot {

DamperInput SteadySine::at(double phase) const noexcept {
  return {amplitude * std::sin(phase), speed() * std::cos(phase), current};
}

double SteadySine::follower(double phase, double follower_rate) const noexcept {
  const double late = rate / follower_rate;
  return speed() * (std::cos(phase) + late * std::sin(phase)) / (1 + late * late);
}

void find_cycle(std::span<double> state, const std::function<void(std::span<double>)>& cycle,
                std::span<const double> begun) {
  constexpr int kMostCycles = 12;
  constexpr double kSettled = 1e-3, kStill = 1e-9, kMostKept = 1 - 1e-6;
  std::vector<double> from(state.begin(), state.end()), to(from), last_from, last_to;
  for (int k = 0; k < kMostCycles; ++k) {
    const bool is_run = k == 0 && !begun.empty();
    if (is_run)
      from.assign(begun.begin(), begun.end());
    else
      from.assign(state.begin(), state.end());
    if (!is_run) cycle(state);
    to.assign(state.begin(), state.end());

    // What a cycle keeps of a change in where it began; and from there what comes of many.
    bool settled = true;
    for (std::size_t n = 0; n < state.size(); ++n) {
      const double moved = to[n] - from[n];
      if (std::abs(moved) <= kStill * std::abs(to[n])) continue;
      if (k == 0) {
        settled = false;
        continue;
      }
      const double apart = from[n] - last_from[n];
      const double kept = apart == 0 ? 0 : std::clamp((to[n] - last_to[n]) / apart, 0., kMostKept);
      const double step = moved / (1 - kept);
      state[n] = from[n] + step;
      if (kept * std::abs(step) > kSettled * std::abs(state[n])) settled = false;
    }
    if (settled) return;
    last_from.swap(from);
    last_to.swap(to);
  }
}

}  // namespace dashpot
