#include "dashpot/suspension/steps/propagator.h"

#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

namespace dashpot {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

RowMajor matrix_of(const std::vector<double>& values, std::size_t n) {
  const auto size = static_cast<Eigen::Index>(n);
  return Eigen::Map<const RowMajor>(values.data(), size, size);
}

/// The part of x after `time` by x at the start and by g, g' and g'' / 2 there: one exponential of
/// the chain x' = A x + B g, g' = g1, g1' = 2 g2.
RowMajor by_derivatives(const LinearPlant& plant, double time) {
  const auto n = static_cast<Eigen::Index>(plant.size);
  const RowMajor inverse = matrix_of(plant.mass, plant.size).inverse();
  RowMajor chain = RowMajor::Zero(5 * n, 5 * n);
  chain.block(0, n, n, n).setIdentity();
  chain.block(n, 0, n, n) = -inverse * matrix_of(plant.stiffness, plant.size);
  chain.block(n, n, n, n) = -inverse * matrix_of(plant.damping, plant.size);
  chain.block(n, 2 * n, n, n) = inverse;
  chain.block(2 * n, 3 * n, n, n).setIdentity();
  chain.block(3 * n, 4 * n, n, n) = 2 * RowMajor::Identity(n, n);
  return RowMajor((chain * time).exp()).topRows(2 * n);
}

/// The same by g at the start, the middle and the end of a step of length h.
std::vector<double> by_values(const RowMajor& rows, std::size_t size, double h) {
  const auto n = static_cast<Eigen::Index>(size);
  const auto g0 = rows.middleCols(2 * n, n), g1 = rows.middleCols(3 * n, n),
             g2 = rows.middleCols(4 * n, n);
  RowMajor out(2 * n, 5 * n);
  out << rows.leftCols(2 * n), g0 - 3 / h * g1 + 2 / (h * h) * g2, 4 / h * g1 - 4 / (h * h) * g2,
      -1 / h * g1 + 2 / (h * h) * g2;
  return {out.data(), out.data() + out.size()};
}

}  // namespace

Propagator::Propagator(const LinearPlant& plant, double step)
    : size_(plant.size),
      step_(step),
      middle_(by_values(by_derivatives(plant, step / 2), plant.size, step)),
      end_(by_values(by_derivatives(plant, step), plant.size, step)) {}

void Propagator::apply(const Rows& rows, std::span<const double> x, const double* const g[3],
                       std::span<double> out) const noexcept {
  const double* row = rows.data();
  for (std::size_t i = 0; i < 2 * size_; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < 2 * size_; ++k) sum += *row++ * x[k];
    for (int node = 0; node < 3; ++node)
      for (std::size_t k = 0; k < size_; ++k) sum += *row++ * g[node][k];
    out[i] = sum;
  }
}

}  // namespace dashpot
