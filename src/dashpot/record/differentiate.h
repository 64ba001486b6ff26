#pragma once
#include <span>
#include <vector>

namespace dashpot {

/// Its slope, per s; dt s, uniform, 3 samples or more. By the compact differences of order four
/// (Lele, J. Comput. Phys. 103, 1992, eq. 2.1.6), s[k-1] + 4 s[k] + s[k+1] = 3 (x[k+1] - x[k-1]) /
/// dt, which is 0.1 % off for a sine with ten samples in a period; one-sided at the ends.
std::vector<double> slope_of(std::span<const double> x, double dt);

/// Velocity from displacement: second-order Butterworth low-pass at cutoff_hz applied forward and
/// backward (zero phase, -6 dB at the cut-off), then slope_of(). dt s, uniform. Throws Error when
/// the cut-off is not below half the sample rate or fewer than 4 samples.
std::vector<double> differentiate_zero_phase(std::span<const double> x, double dt,
                                             double cutoff_hz);

/// A cut-off for it: ten times the frequency below which 99 % of the motion's power (its mean
/// apart) lies, within [10 Hz, 0.4 / dt]; doubled for as long as it takes 2 % or more of the speed
/// from a stretch of the record that is fast, and no noise looks like that.
double choose_cutoff_hz(std::span<const double> x, double dt);

/// A slope, and the cut-off with which it was taken.
struct Derivative {
  double cutoff_hz = 0;
  std::vector<double> slope;
};

/// differentiate_zero_phase() at that cut-off, or where it is 0 at the one of choose_cutoff_hz(),
/// which takes the slope on its way.
Derivative smooth_derivative(std::span<const double> x, double dt, double cutoff_hz = 0);

}  // namespace dashpot
