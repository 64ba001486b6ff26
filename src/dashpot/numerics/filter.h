#pragma once
#include <span>
#include <vector>

namespace dashpot {

/// A second-order section: H(z) = (b0 + b1/z + b2/z^2) / (1 + a1/z + a2/z^2).
struct Biquad {
  double b0, b1, b2, a1, a2;
};

/// Digital Butterworth low-pass of even `order` by the bilinear transform with pre-warping, as a
/// cascade. cutoff_hz (-3 dB) above 0 and below half of 1/dt. Throws Error otherwise.
std::vector<Biquad> butterworth_lowpass(int order, double cutoff_hz, double dt);

/// Forward and backward through the cascade: zero phase, |H|^2. Both ends are extended by odd
/// reflection of `margin` samples (or all that there are) and the sections start in their steady
/// state. The default margin, 0, is that of scipy.signal.sosfiltfilt: 3 (2 sections + 1).
std::vector<double> filter_zero_phase(const std::vector<Biquad>& sections,
                                      std::span<const double> x, std::size_t margin = 0);

}  // namespace dashpot
