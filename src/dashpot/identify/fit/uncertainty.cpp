#include "dashpot/identify/fit/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {

double correlation_length(std::span<const double> residuals,
                          const std::vector<std::pair<std::size_t, std::size_t>>& segments) {
  double variance = 0;
  for (const double r : residuals) variance += r * r;
  if (variance == 0) return 1;

  // Sum the autocorrelation over the lags, up to the first that is not positive.
  std::size_t longest = 0;
  for (const auto& [first, length] : segments) longest = std::max(longest, length);
  double sum = 1;
  for (std::size_t lag = 1; lag < longest; ++lag) {
    double product = 0;
    for (const auto& [first, length] : segments)
      for (std::size_t k = lag; k < length; ++k)
        product += residuals[first + k] * residuals[first + k - lag];
    if (product <= 0) break;
    sum += 2 * product / variance;
  }
  return sum;
}

double Covariance::variance(std::size_t first, std::span<const double> weights) const {
  return between(first, weights, first, weights);
}

double Covariance::between(std::size_t first_a, std::span<const double> a, std::size_t first_b,
                           std::span<const double> b) const {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      sum += a[i] * b[j] * matrix[(first_a + i) * n + first_b + j];
  return sum;
}

std::vector<double> independent_variances(
    std::span<const double> residuals,
    const std::vector<std::pair<std::size_t, std::size_t>>& segments, std::size_t used) {
  const auto count = static_cast<double>(residuals.size());
  const double freedom = std::max(1.0, count - static_cast<double>(used)) / count;
  std::vector<double> variances;
  for (const auto& [first, length] : segments) {
    const std::span<const double> own = residuals.subspan(first, length);
    const double squares = std::inner_product(own.begin(), own.end(), own.begin(), 0.0);
    variances.push_back(correlation_length(own, {{0, length}}) * squares /
                        (freedom * static_cast<double>(length)));
  }
  return variances;
}

namespace {

using Matrix = std::vector<double>;  // square, row by row

/// The rows and columns of the unknowns named, counted in the size of each.
Matrix scaled_part(const Matrix& whole, std::size_t n, const std::vector<std::size_t>& unknowns,
                   const std::vector<double>& size) {
  const std::size_t m = unknowns.size();
  Matrix part(m * m);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < m; ++j)
      part[i * m + j] = whole[unknowns[i] * n + unknowns[j]] / (size[i] * size[j]);
  return part;
}

}  // namespace

Covariance covariance(std::span<const std::vector<double>> part_matrices,
                      std::span<const double> variances, std::size_t n) {
  Covariance result{.n = n, .matrix = Matrix(n * n, 0.0), .without_effect = {}, .confounded = {}};
  Matrix curvature(n * n, 0.0), noise(n * n, 0.0);
  for (std::size_t p = 0; p < part_matrices.size(); ++p)
    for (std::size_t k = 0; k < n * n; ++k) {
      curvature[k] += part_matrices[p][k];
      noise[k] += variances[p] * part_matrices[p][k];
    }
  double steepest = 0;
  for (std::size_t k = 0; k < n; ++k) steepest = std::max(steepest, curvature[k * n + k]);
  std::vector<std::size_t> active;
  for (std::size_t k = 0; k < n; ++k)
    (curvature[k * n + k] > 1e-14 * steepest ? active : result.without_effect).push_back(k);

  if (active.empty()) return result;  // nothing tells any of them

  const std::size_t m = active.size();
  std::vector<double> size;
  for (const std::size_t k : active) size.push_back(std::sqrt(curvature[k * n + k]));
  const SymmetricInverse inverse =
      invert_symmetric(scaled_part(curvature, n, active, size), m, 1e-9);
  const Matrix scaled =
      product(product(inverse.inverse, scaled_part(noise, n, active, size), m), inverse.inverse, m);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < m; ++j)
      result.matrix[active[i] * n + active[j]] = scaled[i * m + j] / (size[i] * size[j]);
  for (const std::vector<double>& direction : inverse.weak) {
    std::vector<std::size_t> group;
    for (std::size_t i = 0; i < m; ++i)
      if (std::abs(direction[i]) > 0.2) group.push_back(active[i]);
    result.confounded.push_back(std::move(group));
  }
  return result;
}

}  // namespace dashpot
