#include "dashpot/suspension/sweep/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dashpot/numerics/distributions.h"

namespace dashpot {
namespace {

/// Ranks from 1 on; equal values share the mean of theirs.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });

  // Equal values stand side by side now.
  std::vector<double> result(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last < order.size() && values[order[last]] == values[order[first]]) ++last;
    for (std::size_t k = first; k < last; ++k)
      result[order[k]] = 0.5 * static_cast<double>(first + 1 + last);
    first = last;
  }
  return result;
}

std::optional<double> correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double my = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mx) * (x[k] - mx);
    yy += (y[k] - my) * (y[k] - my);
    xy += (x[k] - mx) * (y[k] - my);
  }
  if (!(xx > 0 && yy > 0)) return std::nullopt;
  return xy / std::sqrt(xx * yy);
}

}  // namespace

Quantile quantile_of(std::span<const double> sorted, double share) {
  const std::size_t count = sorted.size();
  const double place = share * static_cast<double>(count - 1);
  const auto below = static_cast<std::size_t>(place);
  Quantile quantile{.value = sorted[below]};
  if (below + 1 < count)
    quantile.value += (place - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);

  // Of `count` values, B lie below the quantile, and B is binomial. The value of rank j, from 1,
  // is above the quantile with the probability that B < j.
  const Binomial below_it{static_cast<double>(count), share};
  const double tail = 0.5 * (1 - kSweepConfidence);
  auto j = static_cast<std::size_t>(below_it.quantile(tail)) + 1;
  while (j > 0 && below_it.at_most(static_cast<double>(j - 1)) > tail) --j;
  if (j > 0) quantile.low = sorted[j - 1];
  auto k = static_cast<std::size_t>(below_it.quantile(1 - tail)) + 1;
  while (k <= count && below_it.at_most(static_cast<double>(k - 1)) < 1 - tail) ++k;
  if (k <= count) quantile.high = sorted[k - 1];
  return quantile;
}

std::vector<double> sorted_finite(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  std::ranges::sort(values);
  return values;
}

std::optional<SweepSpread> spread_of(std::vector<double> values) {
  const std::vector<double> sorted = sorted_finite(std::move(values));
  if (sorted.empty()) return std::nullopt;
  SweepSpread spread{.count = sorted.size()};
  for (std::size_t q = 0; q < kSweepShares.size(); ++q)
    spread.quantiles[q] = quantile_of(sorted, kSweepShares[q]);

  const auto n = static_cast<double>(sorted.size());
  spread.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / n;
  double squares = 0;
  for (const double value : sorted) squares += (value - spread.mean) * (value - spread.mean);
  spread.deviation = sorted.size() > 1 ? std::sqrt(squares / (n - 1)) : 0;
  return spread;
}

std::optional<double> rank_correlation(std::span<const double> x, std::span<const double> y) {
  constexpr std::size_t kFewest = 3;
  std::vector<double> a, b;
  for (std::size_t k = 0; k < x.size(); ++k)
    if (std::isfinite(x[k]) && std::isfinite(y[k])) {
      a.push_back(x[k]);
      b.push_back(y[k]);
    }

  if (a.size() < kFewest) return std::nullopt;
  return correlation(ranks(a), ranks(b));
}

double chance_correlation(std::size_t pairs) {
  const double z = normal_quantile(0.5 * (1 + kSweepConfidence));
  return pairs > 1 ? std::min(1.0, z / std::sqrt(static_cast<double>(pairs - 1))) : 1;
}

std::vector<double> measure_values(const Sweep& sweep, std::size_t controller,
                                   const SweepMeasure& measure) {
  std::vector<double> values;
  for (const RideMeasures& ride : sweep.rides[controller]) values.push_back(ride.*measure.field);
  return values;
}

std::vector<double> input_values(const Sweep& sweep, std::size_t input) {
  std::vector<double> values;
  for (const SweepDraw& draw : sweep.vehicles) values.push_back(draw.values[input]);
  return values;
}

std::vector<double> baseline_ratios(const Sweep& sweep, std::size_t controller,
                                    const SweepMeasure& measure) {
  std::vector<double> ratios = measure_values(sweep, controller, measure);
  const std::vector<double> base = measure_values(sweep, sweep.request.baseline, measure);
  for (std::size_t k = 0; k < ratios.size(); ++k) ratios[k] /= base[k];  // 0 / 0 is no number
  return ratios;
}

std::size_t diverged_rides(const Sweep& sweep, std::size_t controller) {
  return static_cast<std::size_t>(
      std::ranges::count_if(sweep.rides[controller], &RideMeasures::has_diverged));
}

}  // namespace dashpot
