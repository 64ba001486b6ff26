#include "dashpot/numerics/spectrum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include <unsupported/Eigen/FFT>

#include "dashpot/base/parallel.h"

namespace dashpot {

namespace {

/// Gives the lines of no negative frequency. It keeps its factors, which cost as much as a
/// transform, and room for one.
Eigen::FFT<double> half_transform() {
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  return fft;
}

std::vector<double> hann_window(std::size_t samples) {
  std::vector<double> window(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const double phase =
        2 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(samples);
    window[i] = 0.5 - 0.5 * std::cos(phase);
  }
  return window;
}

/// The periodogram under a window of as many samples.
PowerSpectrum windowed_spectrum(std::span<const double> x, double dt,
                                std::span<const double> window, Eigen::FFT<double>& fft) {
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());

  // Subtract the mean and apply the window; its power is divided out at the end.
  const std::size_t padded = std::max<std::size_t>(2, std::bit_ceil(x.size()));
  std::vector<double> windowed(padded, 0.0);
  double window_power = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    windowed[i] = window[i] * (x[i] - mean);
    window_power += window[i] * window[i];
  }

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

}  // namespace

PowerSpectrum power_spectrum(std::span<const double> x, double dt) {
  if (x.empty()) return {};
  Eigen::FFT<double> fft = half_transform();
  return windowed_spectrum(x, dt, hann_window(x.size()), fft);
}

PowerSpectrum mean_power_spectrum(std::span<const double> x, double dt) {
  constexpr std::size_t kLongest = std::size_t{1} << 20;
  if (x.empty()) return {};
  const std::size_t parts = (x.size() + kLongest - 1) / kLongest, length = x.size() / parts;
  const std::vector<double> window = hann_window(length);

  // Each core takes every so many-th part.
  std::vector<PowerSpectrum> spectra(parts);
  const std::size_t cores = std::min(parts, static_cast<std::size_t>(default_threads()));
  parallel_for(cores, 0, [&](std::size_t core) {
    Eigen::FFT<double> fft = half_transform();
    for (std::size_t part = core; part < parts; part += cores)
      spectra[part] = windowed_spectrum(x.subspan(part * length, length), dt, window, fft);
  });

  // In the order of the parts, whichever was ready first.
  PowerSpectrum mean = std::move(spectra.front());
  for (const PowerSpectrum& more : std::span(spectra).subspan(1))
    for (std::size_t k = 0; k < mean.power.size(); ++k) mean.power[k] += more.power[k];
  for (double& power : mean.power) power /= static_cast<double>(parts);
  return mean;
}

namespace {

/// One for half spectra of so many samples; a thread keeps its last one.
Eigen::FFT<double>& kept_transform(std::size_t samples) {
  thread_local std::size_t length = 0;
  thread_local std::optional<Eigen::FFT<double>> fft;
  if (!fft || length != samples) {
    fft = half_transform();
    length = samples;
  }
  return *fft;
}

}  // namespace

std::vector<std::complex<double>> half_spectrum(std::span<const double> x) {
  std::vector<std::complex<double>> lines;
  kept_transform(x.size()).fwd(lines, std::vector<double>(x.begin(), x.end()));
  return lines;
}

std::vector<double> from_half_spectrum(std::span<const std::complex<double>> lines,
                                       std::size_t samples) {
  std::vector<double> x;
  kept_transform(samples).inv(x, std::vector<std::complex<double>>(lines.begin(), lines.end()),
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
