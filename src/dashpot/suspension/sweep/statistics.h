#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "dashpot/suspension/sweep/sweep.h"

namespace dashpot {

constexpr std::array kSweepShares{0.05, 0.25, 0.5, 0.75, 0.95};
constexpr double kSweepConfidence = 0.95;

/// An estimate, from a sample, of the value below which a share of all vehicles lies.
struct Quantile {
  double value = 0;
  /// Where it lies with kSweepConfidence, whatever the distribution: order statistics at binomial
  /// ranks. None where there are too few values.
  std::optional<double> low, high;
};
/// sorted: rising, not empty. Between order statistics in a straight line (Hyndman and Fan's type
/// 7).
Quantile quantile_of(std::span<const double> sorted, double share);

/// The finite ones, rising.
std::vector<double> sorted_finite(std::vector<double> values);

/// Over the vehicles of one controller, or over their ratios to those of another.
struct SweepSpread {
  std::size_t count = 0;  ///< finite values
  std::array<Quantile, kSweepShares.size()> quantiles{};
  double mean = 0, deviation = 0;
};
/// Nothing where no value is finite.
std::optional<SweepSpread> spread_of(std::vector<double> values);

/// Spearman's: how monotonously y follows x, -1 ... 1. Pairs with a number that is not finite do
/// not count; nothing with fewer than 3 pairs or where one of the two does not vary.
std::optional<double> rank_correlation(std::span<const double> x, std::span<const double> y);
/// Magnitude that chance reaches with a probability of 1 - kSweepConfidence at most.
double chance_correlation(std::size_t pairs);

/// Values of a sweep, by vehicle.
std::vector<double> measure_values(const Sweep& sweep, std::size_t controller,
                                   const SweepMeasure& measure);
std::vector<double> input_values(const Sweep& sweep, std::size_t input);
/// The measure over the baseline's, vehicle by vehicle.
std::vector<double> baseline_ratios(const Sweep& sweep, std::size_t controller,
                                    const SweepMeasure& measure);
std::size_t diverged_rides(const Sweep& sweep, std::size_t controller);

}  // namespace dashpot
