#include "dashpot/numerics/linear_algebra.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <unsupported/Eigen/MatrixFunctions>

#include "dashpot/error.h"

namespace dashpot {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// What comes in and goes out lies row by row; in here all matrices are of one type, since Eigen's
// decompositions are templates that take seconds to compile for each.

MatrixXd as_matrix(std::span<const double> values, std::size_t rows, std::size_t columns) {
  assert(values.size() == rows * columns);
  MatrixXd matrix(rows, columns);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j)
      matrix(static_cast<Index>(i), static_cast<Index>(j)) = values[i * columns + j];
  return matrix;
}
MatrixXd as_square(std::span<const double> values, std::size_t n) {
  return as_matrix(values, n, n);
}
Eigen::Map<const VectorXd> as_vector(std::span<const double> values) {
  return {values.data(), static_cast<Index>(values.size())};
}
std::vector<double> values_of(const MatrixXd& matrix) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(matrix.size()));
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j < matrix.cols(); ++j) values.push_back(matrix(i, j));
  return values;
}

/// [V1; V2]: a basis of the subspace of the Hamiltonian's eigenvalues left of the imaginary axis. A
/// pair of complex eigenvectors stands as its real and its imaginary part, which span the same.
MatrixXd stable_subspace(const MatrixXd& hamiltonian) {
  const Eigen::EigenSolver<MatrixXd> solver(hamiltonian);
  const MatrixXd vectors = solver.pseudoEigenvectors();
  const Index n = hamiltonian.rows() / 2;
  MatrixXd stable(2 * n, n);
  Index found = 0;
  for (Index k = 0; k < 2 * n; ++k)
    if (solver.eigenvalues()[k].real() < 0 && found < n) stable.col(found++) = vectors.col(k);
  if (found < n) throw Error("regulator", "a mode is neither damped nor reached by the input");
  return stable;
}

/// Factors of a small matrix by plain loops: a vehicle's integrator solves with one of five rows
/// six times per step, which Eigen's blocks and panels only delay. In Eigen's own order of sums,
/// and so the same to the bit.
class SmallFactors {
 public:
  static constexpr std::size_t kMost = 8;  // one panel of Eigen's

  void factorise(const double* columns, std::size_t n) {
    n_ = n;
    std::copy_n(columns, n * n, lu_.begin());
    for (std::size_t k = 0; k < n; ++k) {
      // The largest number of the column becomes the pivot.
      double* const column = &lu_[k * n];
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < n; ++i)
        if (std::abs(column[i]) > std::abs(column[pivot])) pivot = i;
      pivots_[k] = pivot;
      if (column[pivot] != 0) {
        for (std::size_t j = 0; pivot != k && j < n; ++j)
          std::swap(lu_[j * n + k], lu_[j * n + pivot]);
        for (std::size_t i = k + 1; i < n; ++i) column[i] /= column[k];
      }

      // What is left of the columns behind it.
      for (std::size_t j = k + 1; j < n; ++j)
        for (std::size_t i = k + 1; i < n; ++i) lu_[j * n + i] -= lu_[j * n + k] * column[i];
    }
  }

  void solve(const double* right, double* x) const {
    std::copy_n(right, n_, x);
    for (std::size_t k = 0; k < n_; ++k) std::swap(x[k], x[pivots_[k]]);
    for (std::size_t k = 0; k < n_; ++k)
      for (std::size_t i = k + 1; x[k] != 0 && i < n_; ++i) x[i] -= x[k] * lu_[k * n_ + i];
    for (std::size_t k = n_; k-- > 0;) {
      if (x[k] == 0) continue;
      x[k] /= lu_[k * n_ + k];
      for (std::size_t i = 0; i < k; ++i) x[i] -= x[k] * lu_[k * n_ + i];
    }
  }

 private:
  std::size_t n_ = 0;
  std::array<double, kMost * kMost> lu_{};  ///< column by column
  std::array<std::size_t, kMost> pivots_{};
};

}  // namespace

std::vector<double> product(std::span<const double> a, std::span<const double> b,
                            std::size_t inner) {
  assert(a.size() % inner == 0 && b.size() % inner == 0);
  const std::size_t rows = a.size() / inner, columns = b.size() / inner;
  std::vector<double> sum(rows * columns);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t k = 0; k < inner; ++k)
      for (std::size_t j = 0; j < columns; ++j)
        sum[i * columns + j] += a[i * inner + k] * b[k * columns + j];
  return sum;
}

std::vector<double> inverse(std::span<const double> matrix, std::size_t n) {
  return values_of(as_square(matrix, n).inverse());
}

std::vector<double> solve(std::span<const double> matrix, std::span<const double> right) {
  const Eigen::PartialPivLU<MatrixXd> factors(as_square(matrix, right.size()));
  std::vector<double> x(right.size());
  VectorXd::Map(x.data(), static_cast<Index>(x.size())) = factors.solve(as_vector(right));
  return x;
}

std::vector<std::complex<double>> solve(std::span<const std::complex<double>> matrix,
                                        std::span<const std::complex<double>> right) {
  // Real parts above imaginary ones: twice as large, but nothing complex to compile.
  const std::size_t n = right.size();
  assert(matrix.size() == n * n);
  std::vector<double> apart(4 * n * n), sides(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    sides[i] = right[i].real();
    sides[n + i] = right[i].imag();
    for (std::size_t j = 0; j < n; ++j) {
      const std::complex<double> entry = matrix[i * n + j];
      apart[2 * n * i + j] = apart[2 * n * (n + i) + n + j] = entry.real();
      apart[2 * n * (n + i) + j] = entry.imag();
      apart[2 * n * i + n + j] = -entry.imag();
    }
  }

  const std::vector<double> solved = solve(apart, sides);
  std::vector<std::complex<double>> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = {solved[i], solved[n + i]};
  return x;
}

std::vector<double> solve_columns(std::span<const double> matrix, std::span<const double> right,
                                  std::size_t n) {
  const Eigen::PartialPivLU<MatrixXd> factors(as_square(matrix, n));
  return values_of(factors.solve(as_matrix(right, n, right.size() / n)));
}

std::vector<double> exponential(std::span<const double> matrix, std::size_t n) {
  return values_of(as_square(matrix, n).exp());
}

SmallMatrix<7, 7> exponential(const SmallMatrix<7, 7>& matrix) {
  SmallMatrix<7, 7> result;
  std::ranges::copy(exponential(matrix.values, 7), result.values.begin());
  return result;
}

struct Factors::Decomposition {
  Eigen::PartialPivLU<MatrixXd> lu;  ///< of a larger matrix
  SmallFactors small;
  bool is_small = false;
};

Factors::Factors() : decomposition_(std::make_unique<Decomposition>()) {}
Factors::~Factors() = default;

void Factors::factorise_columns(std::span<const double> matrix, std::size_t n) {
  assert(matrix.size() == n * n);
  decomposition_->is_small = n <= SmallFactors::kMost;
  if (decomposition_->is_small) {
    decomposition_->small.factorise(matrix.data(), n);
    return;
  }
  decomposition_->lu.compute(
      MatrixXd::Map(matrix.data(), static_cast<Index>(n), static_cast<Index>(n)));
}

void Factors::solve(std::span<const double> right, std::span<double> x) const {
  assert(x.size() == right.size());
  if (decomposition_->is_small) {
    decomposition_->small.solve(right.data(), x.data());
    return;
  }
  VectorXd::Map(x.data(), static_cast<Index>(x.size())) =
      decomposition_->lu.solve(as_vector(right));
}

SymmetricInverse invert_symmetric(std::span<const double> matrix, std::size_t n, double tolerance) {
  SymmetricInverse result{std::vector<double>(n * n, 0.0), {}};
  if (n == 0) return result;

  // Decompose, and call an eigenvalue weak by comparison with the largest in magnitude.
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(as_square(matrix, n));
  const double floor = tolerance * eigen.eigenvalues().cwiseAbs().maxCoeff();

  // inverse = sum of v v' / lambda over the directions that are not weak.
  for (std::size_t k = 0; k < n; ++k) {
    const auto column = static_cast<Index>(k);
    const double value = eigen.eigenvalues()[column];
    const double* const direction = &eigen.eigenvectors()(0, column);
    if (!(value > floor)) {
      result.weak.emplace_back(direction, direction + n);
      continue;
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        result.inverse[i * n + j] += direction[i] * direction[j] / value;
  }
  return result;
}

std::vector<double> eigenvalues(std::span<const double> a, std::span<const double> b,
                                std::size_t n) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(as_square(a, n), as_square(b, n),
                                                                  Eigen::EigenvaluesOnly);
  return {solver.eigenvalues().begin(), solver.eigenvalues().end()};
}

bool solve_positive_definite(std::span<const double> matrix, std::span<const double> right,
                             std::span<double> x) {
  assert(x.size() == right.size());
  const Eigen::LLT<MatrixXd> factor(as_square(matrix, right.size()));
  if (factor.info() != Eigen::Success) return false;
  VectorXd::Map(x.data(), static_cast<Index>(x.size())) = factor.solve(as_vector(right));
  return true;
}

std::optional<double> trace_of_inverse(std::span<const double> matrix, std::size_t n) {
  const Eigen::LLT<MatrixXd> factor(as_square(matrix, n));
  if (factor.info() != Eigen::Success) return std::nullopt;
  // inverse = M' M with M the inverse of the factor: its trace is the sum of the squares of M.
  const auto size = static_cast<Index>(n);
  return factor.matrixL().solve(MatrixXd::Identity(size, size)).squaredNorm();
}

std::vector<double> regulator_gain(const RegulatorProblem& p) {
  const auto n = static_cast<Index>(p.states);
  const MatrixXd b = as_matrix(p.b, p.states, p.inputs), cross = as_matrix(p.n, p.states, p.inputs);

  // The weights on the inputs must be positive definite with digits to spare, since they are
  // inverted.
  const Eigen::LLT<MatrixXd> r(as_square(p.r, p.inputs));
  const VectorXd pivots = MatrixXd(r.matrixL()).diagonal();
  if (r.info() != Eigen::Success || pivots.minCoeff() < 1e-7 * pivots.maxCoeff())
    throw Error("regulator", "a combination of inputs costs nothing",
                "a weight on the inputs themselves");

  // Remove the cross term: with v = u + R^-1 N'x the weights are Q - N R^-1 N' and R alone.
  const MatrixXd a = as_square(p.a, p.states) - b * r.solve(cross.transpose());
  const MatrixXd q = as_square(p.q, p.states) - cross * r.solve(cross.transpose());

  // The stabilising solution P maps the upper half of the stable subspace onto the lower, column
  // by column: P V1 = V2.
  MatrixXd hamiltonian(2 * n, 2 * n);
  hamiltonian << a, -b * r.solve(b.transpose()), -q, -a.transpose();
  const MatrixXd stable = stable_subspace(hamiltonian);
  const Eigen::PartialPivLU<MatrixXd> upper(stable.topRows(n).transpose());
  const MatrixXd cost = upper.solve(stable.bottomRows(n).transpose());
  return values_of(r.solve(b.transpose() * cost.transpose() + cross.transpose()));
}

}  // namespace dashpot
