#include "dashpot/suspension/plants/linear.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/suspension/plants/assemble.h"

namespace dashpot {
namespace {

using Complex = std::complex<double>;

void add_row(std::vector<Complex>& force, const std::vector<double>& row, Complex value) {
  for (std::size_t k = 0; k < row.size(); ++k) force[k] += row[k] * value;
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
  std::vector<double> frequencies;
  for (const double square : eigenvalues(plant.stiffness, plant.mass, plant.size))
    frequencies.push_back(std::sqrt(std::max(square, 0.0)) / (2 * std::numbers::pi));
  return frequencies;
}

std::vector<Complex> frequency_response(const Plant& plant, const std::vector<double>& damper,
                                        double frequency, double speed) {
  const LinearPlant linear = linear_plant(plant, damper);
  const std::size_t n = linear.size;
  const Complex s(0, 2 * std::numbers::pi * frequency);

  // s^2 M + s C + K at s = 2 pi i f.
  std::vector<Complex> dynamic(n * n);
  for (std::size_t k = 0; k < dynamic.size(); ++k)
    dynamic[k] = s * s * linear.mass[k] + s * linear.damping[k] + linear.stiffness[k];

  // Forces of a ground that moves by 1: through tyres, and through dampers that stand on it.
  std::vector<Complex> force(n);
  for (const Tyre& tyre : plant.tyres) {
    const Complex delay = speed > 0 ? std::exp(-s * tyre.behind / speed) : Complex(1);
    add_row(force, tyre.row, (tyre.stiffness + s * tyre.damping) * delay);
  }
  for (std::size_t k = 0; k < damper.size(); ++k)
    if (plant.struts[k].track) add_row(force, plant.struts[k].row, s * damper[k]);

  // Or of a ground that shakes by 1.
  if (plant.tyres.empty() && !plant.ground.empty()) {
    const std::vector<double> shaken = product(plant.mass, plant.ground, n);
    for (std::size_t k = 0; k < n; ++k) force[k] = -shaken[k];
  }

  return solve(dynamic, force);
}

}  // namespace dashpot
