#pragma once
#include <span>
#include <vector>

namespace dashpot {

/// Share of a signal's power at the frequencies 0, spacing_hz, 2 spacing_hz ... up to half the sample rate.
struct PowerSpectrum {
  double spacing_hz = 0;
  std::vector<double> power;  ///< unit of the signal squared, per line
};

/// Periodogram of x less its mean, under a Hann window, padded with zeros to a power of two. dt s.
PowerSpectrum power_spectrum(std::span<const double> x, double dt);

}  // namespace dashpot
