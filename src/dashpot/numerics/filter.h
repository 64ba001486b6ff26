#pragma once
#include <span>
#include <vector>

namespace dashpot {

/// A cascade of second-order sections, b0 b1 b2 1 a1 a2 each.
struct Biquad {
  double b0, b1, b2, a1, a2;
};

/// Digital Butterworth low-pass of even `order` by the bilinear transform with pre-warping.
/// cutoff_hz below half of 1/dt. Throws Error otherwise.
std::vector<Biquad> butterworth_lowpass(int order, double cutoff_hz, double dt);

/// Forward and backward through the cascade: zero phase, |H|^2. Ends are extended by odd reflection
/// and the sections start in their steady state (as scipy.signal.sosfiltfilt does by default).
std::vector<double> filter_zero_phase(const std::vector<Biquad>& sections, std::span<const double> x);

}  // namespace dashpot
