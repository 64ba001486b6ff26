#include "dashpot/record/differentiate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/numerics/filter.h"
#include "dashpot/numerics/spectrum.h"

namespace dashpot {
namespace {

/// Central differences in place, one-sided of second order at the ends.
void to_slope(std::vector<double>& x, double dt) {
  const std::size_t last = x.size() - 1;
  const double first_slope = (-3 * x[0] + 4 * x[1] - x[2]) / (2 * dt);
  const double last_slope = (3 * x[last] - 4 * x[last - 1] + x[last - 2]) / (2 * dt);

  // Overwrite from the left, keeping the one value that the next difference still needs.
  double before = x[0];
  for (std::size_t i = 1; i < last; ++i) {
    const double here = x[i];
    x[i] = (x[i + 1] - before) / (2 * dt);
    before = here;
  }
  x[0] = first_slope;
  x[last] = last_slope;
}

}  // namespace

std::vector<double> differentiate_zero_phase(std::span<const double> x, double dt,
                                             double cutoff_hz) {
  constexpr std::size_t kFewest = 4;
  if (x.size() < kFewest)
    throw Error("velocity from displacement", "only " + std::to_string(x.size()) + " samples",
                "at least " + std::to_string(kFewest) + " are needed");
  const std::vector<Biquad> lowpass = butterworth_lowpass(2, cutoff_hz, dt);
  // Within two periods of the cut-off the filter forgets its start to exp(-2 pi sqrt(2)) = 1e-4.
  const auto margin = static_cast<std::size_t>(std::ceil(2 / (cutoff_hz * dt)));
  std::vector<double> velocity = filter_zero_phase(lowpass, x, margin);
  to_slope(velocity, dt);
  return velocity;
}

double choose_cutoff_hz(std::span<const double> x, double dt) {
  constexpr double kPowerShare = 0.99, kMargin = 10, kLowest = 10, kHighestTimesDt = 0.4;
  const PowerSpectrum spectrum = mean_power_spectrum(x, dt);
  const double wanted =
      kPowerShare * std::accumulate(spectrum.power.begin(), spectrum.power.end(), 0.0);

  // The lowest frequency below which the wanted share of the power lies.
  double power = 0, motion_hz = 0;
  for (std::size_t k = 0; k < spectrum.power.size() && power < wanted; ++k) {
    power += spectrum.power[k];
    motion_hz = spectrum.spacing_hz * static_cast<double>(k);
  }
  return std::min(std::max(kMargin * motion_hz, kLowest), kHighestTimesDt / dt);
}

}  // namespace dashpot
