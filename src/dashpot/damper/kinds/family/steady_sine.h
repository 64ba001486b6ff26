#pragma once
#include <functional>
#include <span>

#include "dashpot/damper_model.h"

namespace dashpot {

/// A sine at a constant current that has long gone on: x = a sin(p), v = a w cos(p) at a phase p.
struct SteadySine {
  double amplitude = 0, rate = 0, current = 0;  ///< m, rad/s (above 0), A
  DamperInput at(double phase) const noexcept;
  double speed() const noexcept { return amplitude * rate; }
  /// p of p' = follower_rate (v - p) there, m/s.
  double follower(double phase, double follower_rate) const noexcept;
};

/// Moves a state to one that a cycle brings back. A cycle may take long to forget where it began,
/// so each number goes where the line through its last two cycles returns: at once where the number
/// sees only itself and the motion, and linearly; else after some cycles more. `begun`: the state a
/// cycle before, where the first has been run already.
void find_cycle(std::span<double> state, const std::function<void(std::span<double>)>& cycle,
                std::span<const double> begun = {});

}  // namespace dashpot
