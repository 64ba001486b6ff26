#pragma once
#include "dashpot/suspension/bound/force_range.h"
#include "dashpot/suspension/bound/sampled_plant.h"

namespace dashpot {

/// A form over [q, q', 1, F].
using CostForm = SmallMatrix<6, 6>;

/// The index's integrand less a limit.
inline CostForm limited_cost(const AffineCar& car, const ForceLimit& limit,
                             const RideIndex& index) noexcept {
  SmallMatrix<1, 6> force, one;
  force(0, kForcePlace) = 1;
  one(0, kOnePlace) = 1;
  CostForm form = cost_form(car, index);
  add_product(form, -limit.ff, force, force);
  add_product(form, -limit.fv, force, car.speed);
  add_product(form, -limit.vv, car.speed, car.speed);
  add_product(form, -limit.f, force, one);
  add_product(form, -limit.v, car.speed, one);
  add_product(form, -limit.fx, force, car.displacement);
  add_product(form, -limit.vx, car.speed, car.displacement);
  add_product(form, -limit.x, car.displacement, one);
  add_product(form, -limit.one, one, one);
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
