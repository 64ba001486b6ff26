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

/// Variance of one independent residual in each segment: its mean square times its own correlation
/// length, raised for the `used` degrees of freedom that a fit takes from all of them. Records
/// differ: sensors are noisier, and models worse, where forces are large.
std::vector<double> independent_variances(
    std::span<const double> residuals,
    const std::vector<std::pair<std::size_t, std::size_t>>& segments, std::size_t used);

/// Covariance of least-squares unknowns, and what the data cannot tell apart.
struct Covariance {
  std::size_t n = 0;
  std::vector<double> matrix;               ///< n x n; 0 for unknowns without effect
  std::vector<std::size_t> without_effect;  ///< unknowns that change nothing
  std::vector<std::vector<std::size_t>>
      confounded;  ///< groups that can be traded against each other
  double variance(std::size_t first,
                  std::span<const double> weights) const;  ///< of sum weights[k] x[first + k]
  /// Covariance of two such sums.
  double between(std::size_t first_a, std::span<const double> a, std::size_t first_b,
                 std::span<const double> b) const;
};

/// part_matrices: J'J (n x n) of each part of the residuals. variances: of one independent residual
/// in each part. With H the sum of the matrices and M their sum weighted by the variances, the
/// covariance of unknowns that the parts determine with equal weight is H^-1 M H^-1 (White,
/// Econometrica 48, 1980). Unknowns are normalised to unit curvature first; directions flatter than
/// 1e-9 of the steepest count as undetermined.
Covariance covariance(std::span<const std::vector<double>> part_matrices,
                      std::span<const double> variances, std::size_t n);

}  // namespace dashpot
