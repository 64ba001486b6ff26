#include "dashpot/report/residual.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dashpot {

Histogram histogram(std::span<const double> samples, std::size_t bins) {
  if (samples.empty() || bins == 0) return {};
  const auto [least, greatest] = std::ranges::minmax_element(samples);
  Histogram result{*least, (*greatest - *least) / static_cast<double>(bins),
                   std::vector<double>(bins)};
  // All samples equal: one bin of some width around them.
  if (!(result.width > 0)) return {*least - 0.5, 1, {100}};
  for (const double sample : samples) {
    const auto bin = static_cast<std::size_t>((sample - result.low) / result.width);
    result.shares[std::min(bin, bins - 1)] += 100.0 / static_cast<double>(samples.size());
  }
  return result;
}

Autocorrelation autocorrelation(std::span<const double> samples, std::size_t points,
                                std::size_t longest) {
  const std::size_t n = samples.size(), last = std::min(n / 10, longest);
  if (last == 0 || points == 0) return {};
  const double mean = std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(n);
  const auto product = [&](std::size_t lag) {
    double sum = 0;
    for (std::size_t i = lag; i < n; ++i) sum += (samples[i] - mean) * (samples[i - lag] - mean);
    return sum;
  };

  // Relative to the power, at evenly spaced lags.
  const double power = product(0);
  if (!(power > 0)) return {};
  Autocorrelation result;
  result.band = 1.96 / std::sqrt(static_cast<double>(n));
  const std::size_t step = (last + points - 1) / points;
  for (std::size_t lag = 1; lag <= last; lag += step) {
    result.lags.push_back(lag);
    result.values.push_back(product(lag) / power);
  }
  return result;
}

}  // namespace dashpot
