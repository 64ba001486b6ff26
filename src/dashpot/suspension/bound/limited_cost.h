#pragma once
#include "dashpot/suspension/bound/force_range.h"
#include "dashpot/suspension/bound/sampled_plant.h"

namespace dashpot {

/// A form over [q, q', 1, F].
using CostForm = SmallMatrix<6, 6>;

/// The index's integrand, by its own form, less a limit.
inline CostForm limited_cost(CostForm form, const AffineCar& car,
                             const ForceLimit& limit) noexcept {
  form(kForcePlace, kForcePlace) -= limit.ff;
  add_product(form, -limit.fv, car.speed, kForcePlace);
  add_product(form, -limit.vv, car.speed, car.speed);
  form(kForcePlace, kOnePlace) -= 0.5 * limit.f;
  form(kOnePlace, kForcePlace) -= 0.5 * limit.f;
  add_product(form, -limit.v, car.speed, kOnePlace);
  if (limit.has_displacement()) {
    add_product(form, -limit.fx, car.displacement, kForcePlace);
    add_product(form, -limit.vx, car.speed, car.displacement);
    add_product(form, -limit.x, car.displacement, kOnePlace);
  }
  form(kOnePlace, kOnePlace) -= limit.one;
  return form;
}

/// The least of a form over F: a form over [q, q', 1], and the F at which it lies, a row over the
/// same.
struct LeastOverForce {
  SmallMatrix<5, 5> value;
  SmallMatrix<1, 5> law;
};
inline LeastOverForce least_over_force(const CostForm& form) noexcept {
  LeastOverForce out;
  for (std::size_t j = 0; j < 5; ++j)
    out.law(0, j) = -form(kForcePlace, j) / form(kForcePlace, kForcePlace);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j)
      out.value(i, j) = form(i, j) + form(i, kForcePlace) * out.law(0, j);
  return out;
}

}  // namespace dashpot
