#pragma once
#include <optional>
#include <span>
#include <vector>

namespace dashpot {

/// Inverse of a symmetric matrix (n x n, row by row) by eigenvalues, for covariances: directions
/// whose eigenvalue is below `tolerance` times the largest are reported in `weak` (unit vectors of
/// n numbers) and left out of the inverse.
struct SymmetricInverse {
  std::vector<double> inverse;
  std::vector<std::vector<double>> weak;
};
SymmetricInverse invert_symmetric(std::span<const double> matrix, std::size_t n,
                                  double tolerance = 1e-12);

/// Solves matrix * x = right for a positive definite matrix (n x n, row by row; the lower triangle
/// is read), n the size of `right` and of `x`. False when the matrix is not positive definite; x is
/// then untouched.
bool solve_positive_definite(std::span<const double> matrix, std::span<const double> right,
                             std::span<double> x);

/// The trace of the inverse of a positive definite matrix (as above); nothing when it is not.
std::optional<double> trace_of_inverse(std::span<const double> matrix, std::size_t n);

}  // namespace dashpot
