#pragma once
#include <optional>
#include <span>
#include <vector>

namespace dashpot {

/// Inverse of a symmetric matrix (n x n, row by row) by eigenvalues; directions whose eigenvalue is
/// below `tolerance` times the largest are reported in `weak` (unit vectors) and left out.
struct SymmetricInverse {
  std::vector<double> inverse;
  std::vector<std::vector<double>> weak;
};
SymmetricInverse invert_symmetric(std::span<const double> matrix, std::size_t n,
                                  double tolerance = 1e-12);

/// Solves matrix * x = right for a positive definite matrix (n x n, row by row; the lower triangle
/// is read), n the size of `right`. False when the matrix is not positive definite.
bool solve_positive_definite(std::span<const double> matrix, std::span<const double> right,
                             std::span<double> x);

/// Of a positive definite matrix (as above); nothing when it is not.
std::optional<double> trace_of_inverse(std::span<const double> matrix, std::size_t n);

}  // namespace dashpot
