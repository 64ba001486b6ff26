#include "dashpot/identify/uncertainty.h"

#include <algorithm>
#include <cmath>

#include "dashpot/numerics/least_squares.h"

namespace dashpot {

double correlation_length(std::span<const double> residuals,
                          const std::vector<std::pair<std::size_t, std::size_t>>& segments) {
  double variance = 0;
  for (const double r : residuals) variance += r * r;
  if (variance == 0) return 1;
  std::size_t longest = 0;
  for (const auto& [first, length] : segments) longest = std::max(longest, length);
  double sum = 1;
  for (std::size_t lag = 1; lag < longest; ++lag) {
    double product = 0;
    for (const auto& [first, length] : segments)
      for (std::size_t k = lag; k < length; ++k) product += residuals[first + k] * residuals[first + k - lag];
    if (product <= 0) break;
    sum += 2 * product / variance;
  }
  return sum;
}

double Covariance::variance(std::size_t first, std::span<const double> weights) const {
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t j = 0; j < weights.size(); ++j)
      sum += weights[i] * weights[j] * matrix[(first + i) * n + first + j];
  return sum;
}

Covariance covariance(std::span<const double> normal_matrix, std::size_t n, double residual_variance) {
  Covariance result{
      .n = n, .matrix = std::vector<double>(n * n, 0.0), .without_effect = {}, .confounded = {}};
  double steepest = 0;
  for (std::size_t k = 0; k < n; ++k) steepest = std::max(steepest, normal_matrix[k * n + k]);
  std::vector<std::size_t> active;
  for (std::size_t k = 0; k < n; ++k)
    (normal_matrix[k * n + k] > 1e-14 * steepest ? active : result.without_effect).push_back(k);

  const std::size_t m = active.size();
  std::vector<double> size(m), correlation(m * m);
  for (std::size_t i = 0; i < m; ++i) size[i] = std::sqrt(normal_matrix[active[i] * n + active[i]]);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < m; ++j)
      correlation[i * m + j] = normal_matrix[active[i] * n + active[j]] / (size[i] * size[j]);

  const SymmetricInverse inverse = invert_symmetric(correlation, m, 1e-9);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < m; ++j)
      result.matrix[active[i] * n + active[j]] =
          residual_variance * inverse.inverse[i * m + j] / (size[i] * size[j]);
  for (const std::vector<double>& direction : inverse.weak) {
    std::vector<std::size_t> group;
    for (std::size_t i = 0; i < m; ++i)
      if (std::abs(direction[i]) > 0.2) group.push_back(active[i]);
    result.confounded.push_back(std::move(group));
  }
  return result;
}

}  // namespace dashpot
