#pragma once
#include <cmath>

namespace dashpot {

/// The output of a first-order lag y' = rate (u - y) for an input that is linear over a step:
///   y1 = past y0 + from u0 + to u1.  Exact. The weights are positive and their sum is 1, so y
///   stays
/// between the inputs that it has seen, whatever the step.
struct LagWeights {
  double past, from, to;

  /// `turn`: rate times step, positive.
  explicit LagWeights(double turn) noexcept {
    const double gone = -std::expm1(-turn), mean = gone / turn;
    past = 1 - gone;
    from = mean - past;
    to = 1 - mean;
  }
  double of(double y0, double u0, double u1) const noexcept {
    return past * y0 + from * u0 + to * u1;
  }
};

/// Brings such a lag over a step; `slope`, when not null, is its derivative by the logarithm of its
/// rate.
inline void advance_lag(double from, double to, double turn, double& state,
                        double* slope) noexcept {
  const LagWeights weights(turn);
  if (slope) {
    const double fall = turn * weights.past, mean = weights.from + weights.past;
    *slope = weights.past * *slope - fall * state + (weights.past - mean + fall) * from +
             (mean - weights.past) * to;
  }
  state = weights.of(state, from, to);
}

}  // namespace dashpot
