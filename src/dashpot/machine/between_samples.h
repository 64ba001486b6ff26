#pragma once
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace dashpot {

// A measured input between its samples. An integrator asks for it there, and a straight line would
// be wrong by several percent at a fifth of the sample rate.

/// How many samples to either side a value between samples is made of.
constexpr std::size_t kSamplesAround = 24;

/// A signal and its rate on a finer grid: `times` points per sample, the last one at the last
/// sample.
struct FinerSignal {
  std::vector<double> value, rate;  ///< of the signal; of the signal, per s
};

/// The band-limited signal through the samples: sinc interpolation under a Kaiser window of 24
/// samples to either side, exact to 1e-5 of the amplitude (its rate to 1e-3) up to 0.4 of the
/// sample rate. Before the first and behind the last sample the signal is continued by odd
/// reflection, so that within 24 samples of either end less is known. Needs two samples or more.
FinerSignal band_limited(std::span<const double> samples, double sample_time, std::size_t times);

/// Straight lines between the samples, for what jumps: a current that is switched.
FinerSignal straight_lines(std::span<const double> samples, double sample_time, std::size_t times);

/// The signal `delay` seconds earlier at each sample, what a sensor shows that is late, by the same
/// interpolation; a delay below 0 looks ahead.
std::vector<double> delayed(std::span<const double> samples, double sample_time, double delay);

/// From each sample to the next, in samples t: the integral of exp(rate (1 - t)) times the
/// band-limited signal, what a pole takes in whose rate is this per sample. As many numbers as
/// steps, one less than samples.
std::vector<std::complex<double>> forgetting_integral(std::span<const double> samples,
                                                      std::complex<double> rate);

}  // namespace dashpot
