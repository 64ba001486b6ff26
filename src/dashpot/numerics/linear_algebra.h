#pragma once
#include <complex>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dashpot/numerics/small_matrix.h"

// Linear algebra of dense matrices, of some ten to some hundred rows. Whatever decomposes a matrix
// stands here, so that one file alone pays the compile time of the library that does it.
//
// Matrices are row by row, without gaps. A size that does not fit is a bug of the caller (assert).

namespace dashpot {

// Any square matrix, n x n.

/// a b, where a has `inner` columns and b has `inner` rows.
std::vector<double> product(std::span<const double> a, std::span<const double> b,
                            std::size_t inner);

/// The inverse of a regular matrix. One that is singular gives numbers that are not finite.
std::vector<double> inverse(std::span<const double> matrix, std::size_t n);

/// x of matrix * x = right for a regular matrix; n is the size of `right`.
std::vector<double> solve(std::span<const double> matrix, std::span<const double> right);
std::vector<std::complex<double>> solve(std::span<const std::complex<double>> matrix,
                                        std::span<const std::complex<double>> right);

/// The same for each column of `right`, which has n rows.
std::vector<double> solve_columns(std::span<const double> matrix, std::span<const double> right,
                                  std::size_t n);

/// exp(matrix), the sum of its powers over their factorials.
std::vector<double> exponential(std::span<const double> matrix, std::size_t n);
SmallMatrix<7, 7> exponential(const SmallMatrix<7, 7>& matrix);

/// The factors of one matrix for many right sides. Allocates nothing after the first matrix.
class Factors {
 public:
  Factors();
  ~Factors();
  /// Columns, unlike all else here, are given one after the other.
  void factorise_columns(std::span<const double> matrix, std::size_t n);
  /// x of matrix * x = right, for the matrix given last.
  void solve(std::span<const double> right, std::span<double> x) const;

 private:
  struct Decomposition;
  std::unique_ptr<Decomposition> decomposition_;
};

// Symmetric matrices, n x n. Of a positive definite one the lower triangle is read.

/// Inverse of a symmetric matrix by eigenvalues, for covariances: directions whose eigenvalue is
/// below `tolerance` times the largest are reported in `weak` (unit vectors of n numbers) and left
/// out of the inverse.
struct SymmetricInverse {
  std::vector<double> inverse;
  std::vector<std::vector<double>> weak;
};
SymmetricInverse invert_symmetric(std::span<const double> matrix, std::size_t n,
                                  double tolerance = 1e-12);

/// The numbers w, ascending, for which some v has a v = w b v; b is positive definite.
std::vector<double> eigenvalues(std::span<const double> a, std::span<const double> b,
                                std::size_t n);

/// Solves matrix * x = right for a positive definite matrix, n the size of `right` and of `x`.
/// False when the matrix is not positive definite; x is then untouched.
bool solve_positive_definite(std::span<const double> matrix, std::span<const double> right,
                             std::span<double> x);

/// The trace of the inverse of a positive definite matrix; nothing when it is not.
std::optional<double> trace_of_inverse(std::span<const double> matrix, std::size_t n);

// Linear-quadratic regulators.

/// x' = A x + B u with the cost x'Q x + 2 x'N u + u'R u, integrated over all time.
struct RegulatorProblem {
  std::size_t states = 0, inputs = 0;
  std::vector<double> a;  ///< states x states
  std::vector<double> b;  ///< states x inputs
  std::vector<double> q;  ///< states x states, symmetric
  std::vector<double> n;  ///< states x inputs
  std::vector<double> r;  ///< inputs x inputs, positive definite
};

/// The gain K (inputs x states) of the input u = -K x that costs least, from the stable subspace of
/// the Hamiltonian matrix. Throws Error where there is none: a mode on the imaginary axis that the
/// cost does not see or the input does not reach, or inputs that cost nothing.
std::vector<double> regulator_gain(const RegulatorProblem& problem);

}  // namespace dashpot
