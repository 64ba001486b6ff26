#pragma once
#include <span>
#include <vector>

namespace dashpot {

/// A second-order section: H(z) = (b0 + b1/z + b2/z^2) / (1 + a1/z + a2/z^2).
struct Biquad {
  double b0, b1, b2, a1, a2;
};

/// Designs a digital Butterworth low-pass of even `order` by the bilinear transform with
/// pre-warping, as a cascade of order / 2 sections. cutoff_hz (-3 dB) lies above 0 and below half
/// the sample rate, dt in s. Throws Error otherwise.
std::vector<Biquad> butterworth_lowpass(int order, double cutoff_hz, double dt);

/// Runs a signal forward and backward through the cascade: no phase, gain |H|^2. Both ends are
/// extended by odd reflection of `margin` samples (or all that there are) and the sections start in
/// their steady state. The default margin, 0, is that of scipy.signal.sosfiltfilt: 3 (2 sections +
/// 1). Gives as many samples as `x` has.
std::vector<double> filter_zero_phase(const std::vector<Biquad>& sections,
                                      std::span<const double> x, std::size_t margin = 0);

}  // namespace dashpot
