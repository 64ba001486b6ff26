#include "dashpot/numerics/spectrum.h"

#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include <unsupported/Eigen/FFT>

namespace dashpot {

PowerSpectrum power_spectrum(std::span<const double> x, double dt) {
  if (x.empty()) return {};
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  const std::size_t padded = std::max<std::size_t>(2, std::bit_ceil(x.size()));
  std::vector<double> windowed(padded, 0.0);
  double window_power = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double phase =
        2 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(x.size());
    const double weight = 0.5 - 0.5 * std::cos(phase);
    windowed[i] = weight * (x[i] - mean);
    window_power += weight * weight;
  }

  Eigen::FFT<double> fft;
  std::vector<std::complex<double>> lines;
  fft.fwd(lines, windowed);

  // Lines of negative frequency are counted with their mirror images: all but the first and the last.
  PowerSpectrum spectrum{1 / (dt * static_cast<double>(padded)), std::vector<double>(padded / 2 + 1)};
  for (std::size_t k = 0; k < spectrum.power.size(); ++k) {
    const double sides = k == 0 || k == padded / 2 ? 1 : 2;
    spectrum.power[k] = sides * std::norm(lines[k]) / (window_power * static_cast<double>(padded));
  }
  return spectrum;
}

}  // namespace dashpot
