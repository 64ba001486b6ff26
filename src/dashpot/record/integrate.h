#pragma once
#include <span>
#include <string>
#include <vector>

namespace dashpot {

/// A displacement that was integrated from velocity, and what was taken out as drift.
struct IntegratedDisplacement {
  std::vector<double> x;     ///< m, one per sample, its mean 0
  double velocity_zero = 0;  ///< m/s, taken off the velocity beforehand
  double highpass_hz = 0;    ///< what is slower was taken out as well; 0: nothing was
  double drift = 0;          ///< m, span of all that was taken out over the record
};

/// Displacement from velocity by the trapezoidal rule. An integral knows neither its start nor the
/// zero of the sensor, so its drift is removed: first the mean of the velocity over whole cycles
/// (from its first rise through the middle of its range to its last, under a Hann window), then, in
/// a record of at least two periods of that frequency, what is slower than a tenth of the slowest
/// motion, by a second-order Butterworth filter run forward and backward over the record and its
/// mirror images; where it wanders by w m/s, some w / (3 cut-off) stays at either end. The slowest
/// motion: the frequency below which 1 % of the velocity's power lies. The true mean of the
/// displacement is lost, and with it every motion slower than the record tells. dt s, uniform.
/// Throws Error when the velocity has fewer than two whole cycles.
IntegratedDisplacement integrate_without_drift(std::span<const double> velocity, double dt);

/// "drift of 3.1 mm removed (a velocity zero of 0.4 mm/s, and what is slower than 0.1 Hz)".
std::string describe(const IntegratedDisplacement& integrated);

}  // namespace dashpot
