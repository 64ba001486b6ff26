#include "dashpot/suspension/steps/propagator.h"

#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

/// The part of x after `time` by x at the start and by g, g' and g'' / 2 there: one exponential of
/// the chain x' = A x + B g, g' = g1, g1' = 2 g2. 5 n columns.
std::vector<double> by_derivatives(const LinearPlant& plant, double time) {
  const std::size_t n = plant.size;
  const std::vector<double> inverse = dashpot::inverse(plant.mass, n),
                            by_q = product(inverse, plant.stiffness, n),
                            by_v = product(inverse, plant.damping, n);

  // The chain, times the time: rows of q, q', g and g1; g2 stays.
  std::vector<double> chain(5 * n * 5 * n);
  const auto at = [&](std::size_t row, std::size_t column) -> double& {
    return chain[row * 5 * n + column];
  };
  for (std::size_t i = 0; i < n; ++i) {
    at(i, n + i) = time;
    for (std::size_t j = 0; j < n; ++j) {
      at(n + i, j) = -by_q[i * n + j] * time;
      at(n + i, n + j) = -by_v[i * n + j] * time;
      at(n + i, 2 * n + j) = inverse[i * n + j] * time;
    }
    at(2 * n + i, 3 * n + i) = time;
    at(3 * n + i, 4 * n + i) = 2 * time;
  }

  std::vector<double> moved = exponential(chain, 5 * n);
  moved.resize(2 * n * 5 * n);
  return moved;
}

/// The same by g at the start, the middle and the end of a step of length h.
std::vector<double> by_values(std::vector<double> rows, std::size_t n, double h) {
  for (std::size_t i = 0; i < 2 * n; ++i) {
    double* const g = &rows[i * 5 * n + 2 * n];
    for (std::size_t k = 0; k < n; ++k) {
      const double g0 = g[k], g1 = g[n + k], g2 = g[2 * n + k];
      g[k] = g0 - 3 / h * g1 + 2 / (h * h) * g2;
      g[n + k] = 4 / h * g1 - 4 / (h * h) * g2;
      g[2 * n + k] = -1 / h * g1 + 2 / (h * h) * g2;
    }
  }
  return rows;
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
