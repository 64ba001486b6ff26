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

/// The spectrum of a long record is the mean over equal parts of it: each is long enough to resolve
/// the motion, and the memory does not grow with the record.
PowerSpectrum mean_spectrum(std::span<const double> x, double dt) {
  constexpr std::size_t kLongest = std::size_t{1} << 20;
  const std::size_t parts = std::max<std::size_t>(1, (x.size() + kLongest - 1) / kLongest);
  const std::size_t length = x.size() / parts;
  PowerSpectrum mean = power_spectrum(x.first(length), dt);
  for (std::size_t part = 1; part < parts; ++part) {
    const PowerSpectrum more = power_spectrum(x.subspan(part * length, length), dt);
    for (std::size_t k = 0; k < mean.power.size(); ++k) mean.power[k] += more.power[k];
  }
  for (double& power : mean.power) power /= static_cast<double>(parts);
  return mean;
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
  const PowerSpectrum spectrum = mean_spectrum(x, dt);
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
