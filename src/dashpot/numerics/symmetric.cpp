#include "dashpot/numerics/symmetric.h"

#include <cassert>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace dashpot {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Map<const RowMajor> as_matrix(std::span<const double> values, std::size_t n) {
  assert(values.size() == n * n);
  return {values.data(), static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n)};
}

}  // namespace

SymmetricInverse invert_symmetric(std::span<const double> matrix, std::size_t n, double tolerance) {
  SymmetricInverse result{std::vector<double>(n * n, 0.0), {}};
  if (n == 0) return result;

  // Decompose, and call an eigenvalue weak by comparison with the largest in magnitude.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(as_matrix(matrix, n));
  const double floor = tolerance * eigen.eigenvalues().cwiseAbs().maxCoeff();

  // inverse = sum of v v' / lambda over the directions that are not weak.
  Eigen::Map<RowMajor> inverse(result.inverse.data(), eigen.eigenvalues().size(),
                               eigen.eigenvalues().size());
  for (Eigen::Index i = 0; i < eigen.eigenvalues().size(); ++i) {
    const Eigen::VectorXd direction = eigen.eigenvectors().col(i);
    if (eigen.eigenvalues()[i] > floor)
      inverse.noalias() += direction * direction.transpose() / eigen.eigenvalues()[i];
    else
      result.weak.emplace_back(direction.begin(), direction.end());
  }
  return result;
}

bool solve_positive_definite(std::span<const double> matrix, std::span<const double> right,
                             std::span<double> x) {
  assert(x.size() == right.size());
  const Eigen::LLT<Eigen::MatrixXd> factor(as_matrix(matrix, right.size()));
  if (factor.info() != Eigen::Success) return false;
  const auto n = static_cast<Eigen::Index>(right.size());
  Eigen::Map<Eigen::VectorXd>(x.data(), n) =
      factor.solve(Eigen::Map<const Eigen::VectorXd>(right.data(), n));
  return true;
}

std::optional<double> trace_of_inverse(std::span<const double> matrix, std::size_t n) {
  const Eigen::LLT<Eigen::MatrixXd> factor(as_matrix(matrix, n));
  if (factor.info() != Eigen::Success) return std::nullopt;
  // inverse = M' M with M the inverse of the factor: its trace is the sum of the squares of M.
  const auto size = static_cast<Eigen::Index>(n);
  return factor.matrixL().solve(Eigen::MatrixXd::Identity(size, size)).squaredNorm();
}

}  // namespace dashpot
