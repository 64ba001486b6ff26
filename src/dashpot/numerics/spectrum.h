#pragma once
#include <complex>
#include <span>
#include <vector>

namespace dashpot {

/// The share of a signal's power at the frequencies 0, spacing_hz, 2 spacing_hz ... up to half the
/// sample rate.
struct PowerSpectrum {
  double spacing_hz = 0;
  std::vector<double> power;  ///< unit of the signal squared, per line
};

/// Periodogram of x less its mean, under a Hann window, padded with zeros to a power of two. dt in
/// s. The powers add up to about the variance of x. Empty for an empty signal.
PowerSpectrum power_spectrum(std::span<const double> x, double dt);

/// The mean over equal parts of a long signal, on all cores: each is long enough to resolve a
/// motion.
PowerSpectrum mean_power_spectrum(std::span<const double> x, double dt);

/// sum over j of x_j exp(-2 pi i j k / n), n the samples, k = 0 ... n / 2. Quick where n has small
/// factors alone.
std::vector<std::complex<double>> half_spectrum(std::span<const double> x);

/// What half_spectrum made these lines of: `samples` numbers.
std::vector<double> from_half_spectrum(std::span<const std::complex<double>> lines,
                                       std::size_t samples);

/// The most samples up to `count` that are a product of 2, 3 and 5 alone.
std::size_t quick_length(std::size_t count);

/// Adds harmonics up: y_j = sum over k of Re(lines_k exp(2 pi i j k / points)), j = 0 ... points -
/// 1. points: a power of two, at least twice the lines.
std::vector<double> sum_of_harmonics(std::span<const std::complex<double>> lines,
                                     std::size_t points);

}  // namespace dashpot
