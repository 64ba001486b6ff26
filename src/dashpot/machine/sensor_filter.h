#pragma once
#include <complex>
#include <span>
#include <vector>

namespace dashpot {

/// A low-pass of Butterworth's between a sensor and its channel, as loggers have against aliases.
struct SensorFilter {
  double cutoff = 0;  ///< Hz, where 0.707 of the amplitude is left; 0: there is none
  int order = 2;      ///< 1 to 8

  bool operator==(const SensorFilter&) const = default;
};
inline constexpr int kMostFilterOrder = 8;

/// What it makes of a signal of frequency w, rad/s.
std::complex<double> response_at(const SensorFilter& filter, double w);
/// How much later a slow signal comes out, s: the delay that it nearly is below its cut-off.
double delay_of(const SensorFilter& filter);
/// That of the second order which a slow signal leaves so much later, s.
SensorFilter as_late_as(double delay);
/// After so long, s, a thousandth is left of what it held before.
double memory_of(const SensorFilter& filter);

/// What comes out at each sample. Between the samples the signal is band-limited, as
/// between_samples.h has it, and the filter is exact; before the first one it stood there.
/// Source: S. Butterworth, Experimental Wireless 7 (1930) 536-541; by partial fractions, a pole
/// after the other.
std::vector<double> behind(const SensorFilter& filter, std::span<const double> samples,
                           double sample_time);
/// What went in, where this comes out: up to the cut-off within 0.2 % of a sine's amplitude (but
/// near the ends, as long as the filter remembers), and beyond it a growing part is left out with
/// the noise. Needs two samples or more.
std::vector<double> in_front_of(const SensorFilter& filter, std::span<const double> samples,
                                double sample_time);

}  // namespace dashpot
