#include "dashpot/suspension/ride/ride.h"

#include <cmath>
#include <complex>
#include <numbers>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

StepMeasures step_measures(std::span<const double> signal, double dt, double final_value,
                           double band) {
  StepMeasures measures;
  std::vector<double> peaks;
  for (std::size_t k = 0; k < signal.size(); ++k) {
    const double y = signal[k] - final_value;
    if (std::abs(y) > band) measures.settling_time = dt * static_cast<double>(k);
    if (std::abs(y) > std::abs(measures.greatest_deviation)) measures.greatest_deviation = y;
    const bool inside = k > 0 && k + 1 < signal.size();
    if (inside && y > 0 && signal[k] >= signal[k - 1] && signal[k] > signal[k + 1])
      peaks.push_back(y);
  }
  if (peaks.size() > 1) measures.decay_ratio = peaks[1] / peaks[0];
  return measures;
}

Gain gain_at(std::span<const double> y, std::span<const double> u, double dt, double f,
             int periods) {
  const auto count = static_cast<std::size_t>(std::lround(periods / (f * dt)));
  if (count == 0 || count > y.size() || y.size() != u.size())
    throw Error(
        "gain at " + format_number(f) + " Hz",
        "the response has " + format_number(dt * f * static_cast<double>(y.size())) + " periods",
        std::to_string(periods));

  // The last whole periods: sums of squares, and the line of the spectrum at f.
  std::complex<double> fy = 0, fu = 0;
  double yy = 0, uu = 0;
  for (std::size_t k = y.size() - count; k < y.size(); ++k) {
    const std::complex<double> turn =
        std::polar(1.0, -2 * std::numbers::pi * f * dt * static_cast<double>(k));
    fy += y[k] * turn;
    fu += u[k] * turn;
    yy += y[k] * y[k];
    uu += u[k] * u[k];
  }
  return {uu > 0 ? std::sqrt(yy / uu) : 0, std::abs(fu) > 0 ? std::abs(fy) / std::abs(fu) : 0};
}

double gain_integral(std::span<const double> frequency, std::span<const double> gain) {
  double sum = 0;
  for (std::size_t k = 1; k < frequency.size(); ++k)
    sum +=
        0.5 * (frequency[k] - frequency[k - 1]) * (gain[k] * gain[k] + gain[k - 1] * gain[k - 1]);
  return std::sqrt(sum);
}

}  // namespace dashpot
