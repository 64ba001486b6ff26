#include "dashpot/machine/between_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dashpot {
namespace {

constexpr int kReach = static_cast<int>(kSamplesAround);
constexpr double kKaiser = 10.0;  // about 100 dB below what passes

/// Modified Bessel function of order 0, by its series.
double bessel(double x) {
  double term = 1, sum = 1;
  for (int k = 1; term > 1e-17 * sum; ++k) {
    term *= (x / (2 * k)) * (x / (2 * k));
    sum += term;
  }
  return sum;
}

/// sinc under its window, at a distance in samples.
double kernel(double distance) {
  const double share = distance / kReach;
  if (std::abs(share) >= 1) return 0;
  const double x = std::numbers::pi * distance;
  const double sinc = std::abs(x) < 1e-8 ? 1 : std::sin(x) / x;
  return sinc * bessel(kKaiser * std::sqrt(1 - share * share)) / bessel(kKaiser);
}

/// The samples, continued by odd reflection at both ends.
double continued(std::span<const double> samples, std::ptrdiff_t k) {
  const auto last = static_cast<std::ptrdiff_t>(samples.size()) - 1;
  const auto at = [&](std::ptrdiff_t index) {
    return samples[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(index, 0, last))];
  };
  if (k < 0) return 2 * at(0) - at(-k);
  if (k > last) return 2 * at(last) - at(2 * last - k);
  return at(k);
}

/// The weights of the samples -kReach + 1 ... kReach around a point that lies `fraction` of a
/// sample behind sample 0: of its value, which is right for a constant, and of its rate per sample,
/// which is right for a constant and a line.
struct Weights {
  std::vector<double> value, rate;
};

Weights weights_at(double fraction) {
  constexpr double kStep = 1e-4;  // of a sample: the kernel is smooth
  Weights w;
  double sum = 0, drift = 0, slope = 0;
  for (int k = -kReach + 1; k <= kReach; ++k) {
    const double distance = fraction - k;
    w.value.push_back(kernel(distance));
    w.rate.push_back((kernel(distance + kStep) - kernel(distance - kStep)) / (2 * kStep));
    sum += w.value.back();
    drift += w.rate.back();
  }
  for (std::size_t k = 0; k < w.value.size(); ++k) {
    w.value[k] /= sum;
    w.rate[k] -= drift * w.value[k];
    slope += w.rate[k] * (static_cast<double>(k) - kReach + 1);
  }
  for (double& weight : w.rate) weight /= slope;
  return w;
}

}  // namespace

FinerSignal band_limited(std::span<const double> samples, double sample_time, std::size_t times) {
  const std::size_t points = (samples.size() - 1) * times + 1;
  FinerSignal finer{std::vector<double>(points), std::vector<double>(points)};
  for (std::size_t phase = 0; phase < times; ++phase) {
    const Weights w = weights_at(static_cast<double>(phase) / static_cast<double>(times));
    for (std::size_t point = phase, k = 0; point < points; point += times, ++k) {
      double value = 0, rate = 0;
      const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(k) - kReach + 1;
      for (std::size_t j = 0; j < w.value.size(); ++j) {
        const double sample = continued(samples, first + static_cast<std::ptrdiff_t>(j));
        value += w.value[j] * sample;
        rate += w.rate[j] * sample;
      }
      finer.value[point] = phase == 0 ? samples[k] : value;
      finer.rate[point] = rate / sample_time;
    }
  }
  return finer;
}

FinerSignal straight_lines(std::span<const double> samples, double sample_time, std::size_t times) {
  const std::size_t points = (samples.size() - 1) * times + 1;
  FinerSignal finer{std::vector<double>(points), std::vector<double>(points)};
  for (std::size_t point = 0; point < points; ++point) {
    const std::size_t k = std::min(point / times, samples.size() - 2);
    const double share = static_cast<double>(point - k * times) / static_cast<double>(times);
    finer.value[point] = samples[k] + share * (samples[k + 1] - samples[k]);
    finer.rate[point] = (samples[k + 1] - samples[k]) / sample_time;
  }
  return finer;
}

std::vector<double> delayed(std::span<const double> samples, double sample_time, double delay) {
  // All samples lie at the same place between two of the others: one set of weights serves.
  const double place = -delay / sample_time, whole = std::floor(place);
  const Weights w = weights_at(place - whole);
  const auto shift = static_cast<std::ptrdiff_t>(whole) - kReach + 1;
  std::vector<double> late(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k)
    for (std::size_t j = 0; j < w.value.size(); ++j)
      late[k] += w.value[j] * continued(samples, static_cast<std::ptrdiff_t>(k + j) + shift);
  return late;
}

std::vector<std::complex<double>> forgetting_integral(std::span<const double> samples,
                                                      std::complex<double> rate) {
  // The weights of the samples around a step, by Simpson's rule over the part of it that a quick
  // pole does not forget.
  constexpr int kFewest = 16;         // the kernel is smooth over a sample
  constexpr double kForgotten = -30;  // of the logarithm: 1e-13 is left
  constexpr double kFinest = 0.1;     // of the rate, over half a part
  const double length = std::min(1.0, kForgotten / std::min(rate.real(), -1e-300));
  const int parts =
      std::max(kFewest, static_cast<int>(std::ceil(std::abs(rate) * length / (2 * kFinest))));
  std::vector<std::complex<double>> weights(2 * kSamplesAround);
  for (int part = 0; part <= 2 * parts; ++part) {
    const double before = length * (1 - part / (2.0 * parts));  // the end of the step
    const double share = length *
                         (part == 0 || part == 2 * parts ? 1.0
                          : part % 2 == 1                ? 4.0
                                                         : 2.0) /
                         (6.0 * parts);
    const Weights w = weights_at(1 - before);
    for (std::size_t j = 0; j < weights.size(); ++j)
      weights[j] += share * std::exp(rate * before) * w.value[j];
  }

  std::vector<std::complex<double>> taken(samples.size() - 1);
  for (std::size_t k = 0; k < taken.size(); ++k)
    for (std::size_t j = 0; j < weights.size(); ++j)
      taken[k] += weights[j] * continued(samples, static_cast<std::ptrdiff_t>(k + j) - kReach + 1);
  return taken;
}

}  // namespace dashpot
