#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dashpot {

/// How many residuals in a row count as one: 1 + 2 sum of the autocorrelation up to its first zero,
/// pooled over the segments (first index, length). 1 for white noise; 50...500 on real recordings,
/// where treating each sample as independent would make intervals absurdly narrow.
double correlation_length(std::span<const double> residuals,
                          const std::vector<std::pair<std::size_t, std::size_t>>& segments);

/// Covariance of least-squares unknowns, and what the data cannot tell apart.
struct Covariance {
  std::size_t n = 0;
  std::vector<double> matrix;                        ///< n x n; 0 for unknowns without effect
  std::vector<std::size_t> without_effect;           ///< unknowns that change nothing
  std::vector<std::vector<std::size_t>> confounded;  ///< groups that can be traded against each other
  double variance(std::size_t first,
                  std::span<const double> weights) const;  ///< of sum weights[k] x[first + k]
};

/// normal_matrix: J'J (n x n). residual_variance: of one effective sample. Unknowns are normalised to
/// unit curvature first; directions flatter than 1e-9 of the steepest count as undetermined.
Covariance covariance(std::span<const double> normal_matrix, std::size_t n, double residual_variance);

}  // namespace dashpot
