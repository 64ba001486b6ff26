#pragma once

namespace dashpot {

/// Two-sided 95 % point of the normal distribution.
inline constexpr double kNormal95 = 1.959963984540054;

// Quantiles: the value that lies above a share `p` of all, 0 < p < 1. Computed by Boost.Math in
// double precision alone, so that they are the same on every processor and under valgrind.

double normal_quantile(double p);
double students_t_quantile(double degrees, double p);   ///< degrees > 0, of freedom
double chi_squared_quantile(double degrees, double p);  ///< likewise

/// The normal quantile at the probability that Student's t of so many degrees lies below `t`; to
/// either side as exact.
double normal_score(double degrees, double t);

/// How many of `trials` succeed, each with the probability `success`.
struct Binomial {
  double trials, success;

  double quantile(double p) const;     ///< rounded away from the middle
  double at_most(double count) const;  ///< the probability of `count` successes or fewer
};

}  // namespace dashpot
