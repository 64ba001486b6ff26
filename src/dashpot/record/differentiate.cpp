#include "dashpot/record/differentiate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"
#include "dashpot/numerics/filter.h"
#include "dashpot/numerics/spectrum.h"

namespace dashpot {
namespace {

/// Second-order differences: central inside, one-sided at the ends. At least 3 samples.
std::vector<double> differences(const std::vector<double>& x, double dt) {
  const std::size_t last = x.size() - 1;
  std::vector<double> slope(x.size());
  slope[0] = (-3 * x[0] + 4 * x[1] - x[2]) / (2 * dt);
  for (std::size_t i = 1; i < last; ++i) slope[i] = (x[i + 1] - x[i - 1]) / (2 * dt);
  slope[last] = (3 * x[last] - 4 * x[last - 1] + x[last - 2]) / (2 * dt);
  return slope;
}

}  // namespace

std::vector<double> differentiate_zero_phase(std::span<const double> x, double dt, double cutoff_hz) {
  constexpr std::size_t kFewest = 4;
  if (x.size() < kFewest)
    throw Error("velocity from displacement", "only " + std::to_string(x.size()) + " samples",
                "at least " + std::to_string(kFewest) + " are needed");
  const std::vector<Biquad> lowpass = butterworth_lowpass(2, cutoff_hz, dt);
  // Within two periods of the cut-off the filter forgets its start to exp(-2 pi sqrt(2)) = 1e-4.
  const auto margin = static_cast<std::size_t>(std::ceil(2 / (cutoff_hz * dt)));
  return differences(filter_zero_phase(lowpass, x, margin), dt);
}

double choose_cutoff_hz(std::span<const double> x, double dt) {
  constexpr double kPowerShare = 0.99, kMargin = 10, kLowest = 10, kHighestTimesDt = 0.4;
  const PowerSpectrum spectrum = power_spectrum(x, dt);
  const double wanted = kPowerShare * std::accumulate(spectrum.power.begin(), spectrum.power.end(), 0.0);
  double power = 0, motion_hz = 0;
  for (std::size_t k = 0; k < spectrum.power.size() && power < wanted; ++k) {
    power += spectrum.power[k];
    motion_hz = spectrum.spacing_hz * static_cast<double>(k);
  }
  return std::min(std::max(kMargin * motion_hz, kLowest), kHighestTimesDt / dt);
}

}  // namespace dashpot
