#include "dashpot/record/integrate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/numerics/filter.h"
#include "dashpot/numerics/spectrum.h"

namespace dashpot {
namespace {

/// The samples at which the velocity rises through the middle of its range. A band of 20 % of the
/// half range about the middle keeps noise from counting.
std::vector<std::size_t> rises(std::span<const double> v) {
  if (v.empty()) return {};
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  const double middle = 0.5 * (*low + *high), band = 0.2 * 0.5 * (*high - *low);
  std::vector<std::size_t> found;
  bool below = false;
  for (std::size_t k = 0; k < v.size(); ++k) {
    if (v[k] < middle - band) below = true;
    if (!below || v[k] <= middle + band) continue;
    below = false;
    found.push_back(k);
  }
  return found;
}

/// Mean over whole cycles under a Hann window: the first and last cycle weigh little, so that a
/// motion that is not periodic leaves little of itself in the mean.
double mean_of_cycles(std::span<const double> v) {
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k < v.size(); ++k) {
    const double phase =
        2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(v.size());
    const double weight = 1 - std::cos(phase);
    sum += weight * v[k];
    weights += weight;
  }
  return sum / weights;
}

/// The frequency below which 1 % of the power lies, the mean apart.
double slowest_motion_hz(std::span<const double> v, double dt) {
  constexpr double kShare = 0.01;
  const PowerSpectrum spectrum = mean_power_spectrum(v, dt);
  const double wanted = kShare * std::accumulate(spectrum.power.begin(), spectrum.power.end(), 0.0);
  double power = 0;
  std::size_t k = 0;
  while (k + 1 < spectrum.power.size() && (power += spectrum.power[k]) < wanted) ++k;
  return spectrum.spacing_hz * static_cast<double>(k);
}

/// Takes out what is slower than the cut-off. Both ends are mirrored: the filter's own
/// continuation, turned about the last sample, would shift the middle of an oscillation that ends
/// at its top.
void take_slow_part(std::vector<double>& x, double cutoff_hz, double dt) {
  const std::size_t margin =
      std::min(x.size() - 1, static_cast<std::size_t>(std::ceil(2 / (cutoff_hz * dt))));
  const auto length = static_cast<std::ptrdiff_t>(margin);
  std::vector<double> mirrored(x.rend() - length - 1, x.rend() - 1);
  mirrored.insert(mirrored.end(), x.begin(), x.end());
  mirrored.insert(mirrored.end(), x.rbegin() + 1, x.rbegin() + 1 + length);
  const std::vector<double> slow =
      filter_zero_phase(butterworth_lowpass(2, cutoff_hz, dt), mirrored);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] -= slow[margin + k];
}

/// By the trapezoidal rule, from 0.
std::vector<double> integral(std::span<const double> v, double dt) {
  std::vector<double> x(v.size());
  for (std::size_t k = 1; k < v.size(); ++k) x[k] = x[k - 1] + dt * 0.5 * (v[k - 1] + v[k]);
  return x;
}

void take_mean(std::vector<double>& x) {
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  for (double& value : x) value -= mean;
}

}  // namespace

IntegratedDisplacement integrate_without_drift(std::span<const double> velocity, double dt) {
  constexpr std::size_t kFewestCycles = 2;
  const std::vector<std::size_t> starts = rises(velocity);
  const std::size_t cycles = starts.empty() ? 0 : starts.size() - 1;
  if (cycles < kFewestCycles)
    throw Error(
        "", "only " + counted(cycles, "whole cycle"),
        "at least " + std::to_string(kFewestCycles) + " are needed to tell drift from motion");

  // The zero of the velocity.
  IntegratedDisplacement out;
  out.velocity_zero =
      mean_of_cycles(velocity.subspan(starts.front(), starts.back() - starts.front()));
  std::vector<double> v(velocity.begin(), velocity.end());
  for (double& value : v) value -= out.velocity_zero;

  // Integrate. Then what wanders more slowly than the motion, where the record is long enough to
  // tell the two.
  out.x = integral(v, dt);
  constexpr double kBelowMotion = 10, kFewestPeriods = 2;
  const double cutoff = slowest_motion_hz(velocity, dt) / kBelowMotion;
  if (cutoff * dt * static_cast<double>(v.size()) >= kFewestPeriods) {
    out.highpass_hz = cutoff;
    take_slow_part(out.x, cutoff, dt);
  }
  take_mean(out.x);

  // How much was taken out in all.
  const std::vector<double> plain = integral(velocity, dt);
  double low = INFINITY, high = -INFINITY;
  for (std::size_t k = 0; k < plain.size(); ++k) {
    low = std::min(low, plain[k] - out.x[k]);
    high = std::max(high, plain[k] - out.x[k]);
  }
  out.drift = high - low;
  return out;
}

std::string describe(const IntegratedDisplacement& integrated) {
  constexpr double kMillimetres = 1e3, kLeast = 1e-6;  // m
  if (integrated.drift < kLeast) return "without any drift";
  std::string text = "drift of " + format_number(kMillimetres * integrated.drift, 3) +
                     " mm removed (a velocity zero of " +
                     format_number(kMillimetres * integrated.velocity_zero, 2) + " mm/s";
  if (integrated.highpass_hz > 0)
    text += ", and what is slower than " + format_number(integrated.highpass_hz, 2) + " Hz";
  return text + ")";
}

}  // namespace dashpot
