#include "dashpot/record/cycles.h"

#include <algorithm>
#include <cmath>

#include "dashpot/error.h"

namespace dashpot {
namespace {

// A crossing must come from this share of the largest value below zero.
constexpr double kArmed = 0.1;

/// Places, in samples with their fraction, at which the signal rises through zero.
std::vector<double> upward_crossings(std::span<const double> samples) {
  double largest = 0;
  for (const double value : samples) largest = std::max(largest, std::abs(value));
  std::vector<double> crossings;

  // A crossing counts once the signal has been clearly below zero since the last one.
  bool is_armed = false;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double before = samples[i - 1], now = samples[i];
    is_armed = is_armed || before < -kArmed * largest;
    if (!is_armed || before >= 0 || now < 0) continue;
    crossings.push_back(static_cast<double>(i) - now / (now - before));
    is_armed = false;
  }
  return crossings;
}

}  // namespace

std::vector<Cycle> find_cycles(std::span<const double> samples) {
  const std::vector<double> crossings = upward_crossings(samples);
  std::vector<Cycle> cycles;
  for (std::size_t k = 1; k < crossings.size(); ++k) {
    const auto first = static_cast<std::size_t>(std::ceil(crossings[k - 1])),
               count = static_cast<std::size_t>(std::lround(crossings[k] - crossings[k - 1]));
    cycles.push_back({first, std::min(count, samples.size() - first)});
  }
  return cycles;
}

Record last_cycle(const Record& record) {
  const std::vector<Cycle> cycles = find_cycles(record.channel("velocity").samples);
  if (cycles.empty())
    throw Error("record '" + record.name + "'", "has no whole cycle",
                "motion with two rises of the velocity through zero");
  Record cycle = record.slice(cycles.back().first, cycles.back().first + cycles.back().count);
  cycle.warm_up = 0;
  return cycle;
}

}  // namespace dashpot
