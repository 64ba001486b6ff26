#include "dashpot/suspension/plants/linear.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

#include "dashpot/suspension/plants/assemble.h"

namespace dashpot {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Complex = std::complex<double>;

Eigen::Map<const Matrix> map_of(const std::vector<double>& values, std::size_t n) {
  return {values.data(), static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n)};
}

void add_row(Eigen::VectorXcd& force, const std::vector<double>& row, Complex value) {
  for (std::size_t k = 0; k < row.size(); ++k)
    force[static_cast<Eigen::Index>(k)] += row[k] * value;
}

}  // namespace

LinearPlant linear_plant(const Plant& plant, const std::vector<double>& damper) {
  LinearPlant linear{plant.size(), plant.mass, plant.damping, plant.stiffness};
  for (const Tyre& tyre : plant.tyres) {
    add_along(linear.stiffness, tyre.row, tyre.stiffness);
    add_along(linear.damping, tyre.row, tyre.damping);
  }
  for (std::size_t k = 0; k < damper.size(); ++k)
    add_along(linear.damping, plant.struts[k].row, damper[k]);
  return linear;
}

std::vector<double> natural_frequencies(const LinearPlant& plant) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      map_of(plant.stiffness, plant.size), map_of(plant.mass, plant.size), Eigen::EigenvaluesOnly);
  std::vector<double> frequencies;
  for (const double square : solver.eigenvalues())
    frequencies.push_back(std::sqrt(std::max(square, 0.0)) / (2 * std::numbers::pi));
  return frequencies;
}

std::vector<Complex> frequency_response(const Plant& plant, const std::vector<double>& damper,
                                        double frequency, double speed) {
  const LinearPlant linear = linear_plant(plant, damper);
  const std::size_t n = linear.size;
  const Complex s(0, 2 * std::numbers::pi * frequency);

  // s^2 M + s C + K at s = 2 pi i f.
  const Eigen::MatrixXcd dynamic = s * s * map_of(linear.mass, n).cast<Complex>() +
                                   s * map_of(linear.damping, n).cast<Complex>() +
                                   map_of(linear.stiffness, n).cast<Complex>();

  // Forces of a ground that moves by 1: through tyres, and through dampers that stand on it.
  Eigen::VectorXcd force = Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(n));
  for (const Tyre& tyre : plant.tyres) {
    const Complex delay = speed > 0 ? std::exp(-s * tyre.behind / speed) : Complex(1);
    add_row(force, tyre.row, (tyre.stiffness + s * tyre.damping) * delay);
  }
  for (std::size_t k = 0; k < damper.size(); ++k)
    if (plant.struts[k].track) add_row(force, plant.struts[k].row, s * damper[k]);

  // Or of a ground that shakes by 1.
  if (plant.tyres.empty() && !plant.ground.empty())
    force = -(map_of(plant.mass, n) *
              Eigen::Map<const Eigen::VectorXd>(plant.ground.data(), static_cast<Eigen::Index>(n)))
                 .cast<Complex>();

  const Eigen::VectorXcd q = dynamic.partialPivLu().solve(force);
  return {q.begin(), q.end()};
}

}  // namespace dashpot
