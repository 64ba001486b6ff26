#pragma once
#include <optional>
#include <span>
#include <vector>

namespace dashpot {

/// How a signal answers a step and comes to rest.
struct StepMeasures {
  /// s after which it stays within `band` of its end value; the last sample's time where it does
  /// not.
  double settling_time = 0;
  std::optional<double> decay_ratio;  ///< second positive peak over the first; none without two
  double greatest_deviation = 0;      ///< signed, from the end value
};
/// band: in the signal's unit, above 0. final_value: where it comes to rest. dt s; the step is at
/// the first sample.
StepMeasures step_measures(std::span<const double> signal, double dt, double final_value,
                           double band);

/// Gain at one frequency over whole periods of a steady response.
struct Gain {
  double variance = 0;     ///< sqrt(sum y^2 / sum u^2): at all frequencies
  double fundamental = 0;  ///< |Y(f)| / |U(f)|: at f alone
};
/// The last `periods` whole periods of f Hz count. Throws Error where the signals are shorter.
Gain gain_at(std::span<const double> y, std::span<const double> u, double dt, double f,
             int periods);

/// sqrt of the integral of the squared gain over frequency: the scalar that the gain curves are
/// compared by.
double gain_integral(std::span<const double> frequency, std::span<const double> gain);

}  // namespace dashpot
