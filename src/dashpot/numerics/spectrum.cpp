#include "dashpot/numerics/spectrum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <optional>

#include <unsupported/Eigen/FFT>

namespace dashpot {

PowerSpectrum power_spectrum(std::span<const double> x, double dt) {
  if (x.empty()) return {};
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());

  // Subtract the mean and apply the window; its power is divided out at the end.
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

  // Lines of negative frequency are counted with their mirror images: all but the first and the
  // last.
  PowerSpectrum spectrum{1 / (dt * static_cast<double>(padded)),
                         std::vector<double>(padded / 2 + 1)};
  for (std::size_t k = 0; k < spectrum.power.size(); ++k) {
    const double sides = k == 0 || k == padded / 2 ? 1 : 2;
    spectrum.power[k] = sides * std::norm(lines[k]) / (window_power * static_cast<double>(padded));
  }
  return spectrum;
}

PowerSpectrum mean_power_spectrum(std::span<const double> x, double dt) {
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

namespace {

/// One for half spectra of so many samples; a thread keeps its last one, since its factors cost as
/// much as a transform.
Eigen::FFT<double>& half_transform(std::size_t samples) {
  thread_local std::size_t length = 0;
  thread_local std::optional<Eigen::FFT<double>> fft;
  if (!fft || length != samples) {
    fft.emplace();
    fft->SetFlag(Eigen::FFT<double>::HalfSpectrum);
    length = samples;
  }
  return *fft;
}

}  // namespace

std::vector<std::complex<double>> half_spectrum(std::span<const double> x) {
  std::vector<std::complex<double>> lines;
  half_transform(x.size()).fwd(lines, std::vector<double>(x.begin(), x.end()));
  return lines;
}

std::vector<double> from_half_spectrum(std::span<const std::complex<double>> lines,
                                       std::size_t samples) {
  std::vector<double> x;
  half_transform(samples).inv(x, std::vector<std::complex<double>>(lines.begin(), lines.end()),
                              static_cast<Eigen::Index>(samples));
  return x;
}

std::size_t quick_length(std::size_t count) {
  for (;; --count) {
    std::size_t left = count;
    for (const std::size_t factor : {2u, 3u, 5u})
      while (left % factor == 0) left /= factor;
    if (left == 1) return count;
  }
}

std::vector<double> sum_of_harmonics(std::span<const std::complex<double>> lines,
                                     std::size_t points) {
  std::vector<std::complex<double>> half(points / 2 + 1);
  std::copy(lines.begin(), lines.end(), half.begin());
  half[0] *= 2;  // a constant has no mirror image

  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  fft.SetFlag(Eigen::FFT<double>::Unscaled);
  std::vector<double> sum;
  fft.inv(sum, half, static_cast<Eigen::Index>(points));
  for (double& value : sum) value *= 0.5;
  return sum;
}

}  // namespace dashpot
