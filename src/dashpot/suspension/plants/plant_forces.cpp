#include "dashpot/suspension/plants/plant_forces.h"

#include <cmath>

#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {

PlantForces::PlantForces(const Plant& plant, const GroundMotion& ground)
    : plant_(plant),
      ground_(ground),
      linear_(linear_plant(plant)),
      sizes_{plant.size(), plant.struts.size(), plant.tyres.size()},
      is_quarter_car_(sizes_.coordinates == QuarterCarSizes::coordinates &&
                      sizes_.struts == QuarterCarSizes::struts &&
                      sizes_.tyres == QuarterCarSizes::tyres),
      resting_(plant.size() * plant.tyres.size()) {
  for (const Strut& strut : plant.struts) resistances_.push_back(resistance_of(strut));
  for (const Tyre& tyre : plant.tyres) contacts_.push_back(contact_of(tyre, plant.tyres_may_lift));

  // q'' by state, strut forces and road pushes: M^-1 times the columns of each.
  const std::size_t n = plant.size(), struts = plant.struts.size(), tyres = plant.tyres.size();
  std::vector<double> by_state, by_strut, by_tyre;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) by_state.push_back(-linear_.stiffness[i * n + j]);
    for (std::size_t j = 0; j < n; ++j) by_state.push_back(-linear_.damping[i * n + j]);
    for (const Strut& strut : plant.struts) by_strut.push_back(-strut.row[i]);
    for (const Tyre& tyre : plant.tyres) by_tyre.push_back(tyre.row[i]);
  }
  by_state_ = solve_columns(plant.mass, by_state, n);
  if (struts > 0) by_strut_ = solve_columns(plant.mass, by_strut, n);
  if (tyres > 0) by_tyre_ = solve_columns(plant.mass, by_tyre, n);

  // M e, the inertia that a shaking ground drives.
  if (!plant.ground.empty()) shaken_ = product(plant.mass, plant.ground, n);

  // Where the plant rests for each tyre lifted by 1 m.
  for (std::size_t t = 0; t < tyres; ++t) {
    std::vector<double> force = plant.tyres[t].row;
    for (double& value : force) value *= plant.tyres[t].stiffness;
    const std::vector<double> q = solve(linear_.stiffness, force);
    for (std::size_t k = 0; k < n; ++k) resting_[k * tyres + t] = q[k];
  }
}

void PlantForces::add_up(double t, std::span<const double> x, std::span<const double> strut_forces,
                         std::span<double> g) const noexcept {
  for (double& value : g) value = 0;
  for (std::size_t s = 0; s < plant_.struts.size(); ++s)
    for (std::size_t k = 0; k < g.size(); ++k) g[k] -= plant_.struts[s].row[k] * strut_forces[s];
  for (std::size_t w = 0; w < plant_.tyres.size(); ++w) {
    const double pushed = push(w, foot(w, t), x.data());
    for (std::size_t k = 0; k < g.size(); ++k) g[k] += plant_.tyres[w].row[k] * pushed;
  }
  if (shaken_.empty()) return;
  const double a = ground_.acceleration(t);
  for (std::size_t k = 0; k < g.size(); ++k) g[k] -= shaken_[k] * a;
}

void PlantForces::accelerate(double t, std::span<const double> x,
                             std::span<const double> strut_forces,
                             std::span<double> out) const noexcept {
  const auto foot_of = [&](std::size_t tyre) { return foot(tyre, t); };
  accelerate(sizes_, t, x.data(), strut_forces.data(), foot_of, out.data());
}

void PlantForces::resting_place(std::span<const FootMotion> feet,
                                std::span<double> q) const noexcept {
  for (double& value : q) value = 0;
  for (std::size_t w = 0; w < plant_.tyres.size(); ++w) add_resting(w, feet[w].height, q);
}

void PlantForces::resting_place(std::span<const double> heights,
                                std::span<double> q) const noexcept {
  for (double& value : q) value = 0;
  for (std::size_t w = 0; w < plant_.tyres.size(); ++w) add_resting(w, heights[w], q);
}

void PlantForces::add_resting(std::size_t tyre, double height, std::span<double> q) const noexcept {
  const std::size_t tyres = plant_.tyres.size();
  for (std::size_t k = 0; k < q.size(); ++k) q[k] += resting_[k * tyres + tyre] * height;
}

}  // namespace dashpot
