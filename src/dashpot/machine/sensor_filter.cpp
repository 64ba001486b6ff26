#include "dashpot/machine/sensor_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dashpot/machine/between_samples.h"
#include "dashpot/numerics/spectrum.h"

namespace dashpot {
namespace {

using Complex = std::complex<double>;

/// A pole, 1/s, in the upper half plane or real, and how much of it the response has: the response
/// is the sum of residue / (s - pole), of complex ones with their conjugates.
struct PoleOfFilter {
  Complex pole, residue;
};

std::vector<Complex> poles_of(const SensorFilter& filter) {
  std::vector<Complex> poles;
  const double w = 2 * std::numbers::pi * filter.cutoff;
  for (int k = 0; k < filter.order; ++k)
    poles.push_back(
        std::polar(w, std::numbers::pi * (2 * k + filter.order + 1) / (2.0 * filter.order)));
  return poles;
}

std::vector<PoleOfFilter> fractions_of(const SensorFilter& filter) {
  const std::vector<Complex> poles = poles_of(filter);
  const double w = 2 * std::numbers::pi * filter.cutoff;
  std::vector<PoleOfFilter> fractions;
  for (std::size_t k = 0; 2 * k < poles.size(); ++k) {
    PoleOfFilter one{poles[k], w};
    for (std::size_t j = 0; j < poles.size(); ++j)
      if (j != k) one.residue *= w / (poles[k] - poles[j]);
    const bool is_real = 2 * k + 1 == poles.size();
    if (!is_real) one.residue *= 2.0;
    fractions.push_back(one);
  }
  return fractions;
}

}  // namespace

std::complex<double> response_at(const SensorFilter& filter, double w) {
  if (filter.cutoff == 0) return 1;
  Complex response = 1;
  for (const Complex& pole : poles_of(filter)) response *= -pole / (Complex(0, w) - pole);
  return response;
}

double delay_of(const SensorFilter& filter) {
  if (filter.cutoff == 0) return 0;
  Complex sum = 0;
  for (const Complex& pole : poles_of(filter)) sum -= 1.0 / pole;
  return sum.real();
}

SensorFilter as_late_as(double delay) { return {delay_of({1, 2}) / delay, 2}; }

double memory_of(const SensorFilter& filter) {
  if (filter.cutoff == 0) return 0;
  constexpr double kLeft = 1e-3;
  double slowest = INFINITY;
  for (const Complex& pole : poles_of(filter)) slowest = std::min(slowest, -pole.real());
  return -std::log(kLeft) / slowest;
}

std::vector<double> behind(const SensorFilter& filter, std::span<const double> samples,
                           double sample_time) {
  std::vector<double> out(samples.begin(), samples.end());
  if (filter.cutoff == 0) return out;
  std::ranges::fill(out, 0.0);
  for (const auto& [pole, residue] : fractions_of(filter)) {
    // Over a sample the pole forgets, and takes in what the signal did meanwhile.
    const Complex keeps = std::exp(pole * sample_time);
    const std::vector<Complex> taken = forgetting_integral(samples, pole * sample_time);
    Complex state = -samples.front() / pole;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (k > 0) state = keeps * state + sample_time * taken[k - 1];
      out[k] += (residue * state).real();
    }
  }
  return out;
}

std::vector<double> in_front_of(const SensorFilter& filter, std::span<const double> samples,
                                double sample_time) {
  constexpr double kLeast = std::numbers::sqrt2 / 2;  // of the amplitude: at the cut-off
  const std::size_t count = samples.size();
  if (filter.cutoff == 0) return {samples.begin(), samples.end()};

  // Reflected at both ends, further than the filter remembers where there is so much. A quarter
  // more leaves room for quick_length(), which goes down by an eighth at most.
  const auto remembers = static_cast<std::size_t>(memory_of(filter) / sample_time) + 1;
  const std::size_t length =
                        quick_length(count + count / 4 + 4 * std::min(2 * remembers, count - 1)),
                    margin = (length - count) / 2;
  std::vector<double> longer(length);
  for (std::size_t k = 0; k < length; ++k)
    longer[k] =
        k < margin ? 2 * samples.front() - samples[std::min(margin - k, count - 1)]
        : k < margin + count
            ? samples[k - margin]
            : 2 * samples.back() - samples[count - 1 - std::min(k - margin - count + 1, count - 1)];

  std::vector<Complex> lines = half_spectrum(longer);
  const double spacing = 2 * std::numbers::pi / (static_cast<double>(length) * sample_time);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Complex response = response_at(filter, static_cast<double>(k) * spacing);
    const double size = std::abs(response);
    lines[k] *= std::conj(response) / (size * std::max(size, kLeast));
  }
  longer = from_half_spectrum(lines, length);
  const auto first = longer.begin() + static_cast<std::ptrdiff_t>(margin);
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace dashpot
