#pragma once
#include <span>
#include <vector>

namespace dashpot {

/// Shares, in %, of equal bins from `low` on.
struct Histogram {
  double low = 0, width = 0;
  std::vector<double> shares;
};
Histogram histogram(std::span<const double> samples, std::size_t bins);

/// Correlation of a series with itself at lags of whole samples, about its mean.
struct Autocorrelation {
  std::vector<std::size_t> lags;
  std::vector<double> values;
  double band = 0;  ///< 1.96 / sqrt(n): white noise stays within it with 95 %
};
/// Up to `points` lags, evenly from 1 to a tenth of the series, at most `longest`.
Autocorrelation autocorrelation(std::span<const double> samples, std::size_t points,
                                std::size_t longest);

}  // namespace dashpot
