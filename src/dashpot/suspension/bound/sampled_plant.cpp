#include "dashpot/suspension/bound/sampled_plant.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/suspension/plants/assemble.h"
#include "dashpot/suspension/plants/linear.h"

namespace dashpot {
namespace {

template <std::size_t Rows, std::size_t Columns>
SmallMatrix<Rows, Columns> small(const std::vector<double>& values) {
  SmallMatrix<Rows, Columns> matrix;
  std::copy_n(values.begin(), Rows * Columns, matrix.values.begin());
  return matrix;
}

/// A row over [q, q', 1, F], looked at after a motion.
SmallMatrix<1, 6> after(const SmallMatrix<1, 6>& row, const SmallMatrix<5, 6>& motion) {
  SmallMatrix<1, 6> out;
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 6; ++j) out(0, j) += row(0, i) * motion(i, j);
  out(0, kForcePlace) += row(0, kForcePlace);
  return out;
}

}  // namespace

void require_quarter_car(const Plant& plant) {
  const std::string right = "a quarter car without stops, friction and lifting tyre";
  if (plant.size() != 2 || plant.struts.size() != 1 || plant.tyres.size() != 1 ||
      plant.struts[0].track)
    throw Error(plant.name, "has no clairvoyant bound", right);
  const Strut& strut = plant.struts[0];
  if (plant.tyres_may_lift || strut.friction > 0 || strut.extension_stop > 0 ||
      strut.compression_stop > 0)
    throw Error(plant.name, "is not linear but for its damper: the clairvoyant bound asks for that",
                right);
}

SampledPlant::SampledPlant(const Plant& plant, const GroundMotion& ground, double duration,
                           double step, double start)
    : step_(step) {
  require_quarter_car(plant);
  if (!(step > 0 && duration >= step))
    throw Error("clairvoyant bound", "a duration of " + format_number(duration) +
                                         " s in steps of " + format_number(step) + " s");

  set_rates(plant);
  end_ = flow(step);
  middle_ = flow(step / 2);
  unpushed_ = {end_.motion, after(rates_.acceleration, middle_.motion),
               after(rates_.tyre_force, middle_.motion), after(rates_.speed, middle_.motion),
               after(rates_.displacement, middle_.motion)};

  // Through two points inside the cell, so that a jump between cells stays between them.
  const Tyre& tyre = plant.tyres[0];
  const auto cells = static_cast<std::size_t>(std::llround(duration / step));
  for (std::size_t k = 0; k < cells; ++k) {
    const double from = start + static_cast<double>(k) * step;
    const double early = ground.foot(from + 0.25 * step, tyre.track, tyre.behind).height;
    const double late = ground.foot(from + 0.75 * step, tyre.track, tyre.behind).height;
    road_.push_back({1.5 * early - 0.5 * late, (late - early) / (0.5 * step)});
  }
}

void SampledPlant::set_rates(const Plant& plant) {
  const LinearPlant linear = linear_plant(plant);
  const Tyre& tyre = plant.tyres[0];
  const Strut& strut = plant.struts[0];
  stiffness_ = tyre.stiffness;
  damping_ = tyre.damping;

  // M q'' = -K q - C q' - row F + tyre P, divided by M.
  const SmallMatrix<2, 2> over_mass = inverse(small<2, 2>(linear.mass)),
                          by_q = -1 * (over_mass * small<2, 2>(linear.stiffness)),
                          by_v = -1 * (over_mass * small<2, 2>(linear.damping));
  const SmallMatrix<2, 1> by_force = -1 * (over_mass * small<2, 1>(strut.row)),
                          by_push = over_mass * small<2, 1>(tyre.row);

  // Coordinate by coordinate into the rows: rates of motion, damper speed and tyre force.
  for (std::size_t i = 0; i < 2; ++i) {
    rates_.motion(i, i + 2) = 1;
    for (std::size_t j = 0; j < 2; ++j) {
      rates_.motion(i + 2, j) = by_q(i, j);
      rates_.motion(i + 2, j + 2) = by_v(i, j);
    }
    rates_.motion(i + 2, kForcePlace) = by_force(i, 0);
    by_push_(i + 2, 0) = by_push(i, 0);
    rates_.speed(0, i + 2) = strut.row[i];
    rates_.displacement(0, i) = strut.row[i];
    rates_.tyre_force(0, i) = -tyre.stiffness * tyre.row[i];
    rates_.tyre_force(0, i + 2) = -tyre.damping * tyre.row[i];
    acceleration_by_push_ += strut.body_row[i] * by_push(i, 0);
  }

  // The body's acceleration is a sum of these rows.
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      rates_.acceleration(0, j) += strut.body_row[i] * rates_.motion(i + 2, j);
}

SampledPlant::Flow SampledPlant::flow(double time) const {
  // The chain of x with F and the push, which stay or rise, [x, F, push, its rate]' = chain [...].
  SmallMatrix<7, 7> chain;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) chain(i, j) = rates_.motion(i, j);
    chain(i, 4) = rates_.motion(i, kForcePlace);
    chain(i, 5) = by_push_(i, 0);
  }
  chain(5, 6) = 1;

  // One exponential moves them all.
  const SmallMatrix<7, 7> moved = exponential(time * chain);
  Flow out;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) out.motion(i, j) = moved(i, j);
    out.motion(i, kForcePlace) = moved(i, 4);
    out.constant(i, 0) = moved(i, 5);
    out.rising(i, 0) = moved(i, 6);
  }
  out.motion(kOnePlace, kOnePlace) = 1;
  return out;
}

void SampledPlant::drive(AffineCar& car, const SmallMatrix<5, 1>& change,
                         const SmallMatrix<5, 1>& state, double push) const noexcept {
  for (std::size_t i = 0; i < 4; ++i) {
    car.motion(i, kOnePlace) = change(i, 0);
    car.acceleration(0, kOnePlace) += rates_.acceleration(0, i) * state(i, 0);
    car.tyre_force(0, kOnePlace) += rates_.tyre_force(0, i) * state(i, 0);
    car.speed(0, kOnePlace) += rates_.speed(0, i) * state(i, 0);
    car.displacement(0, kOnePlace) += rates_.displacement(0, i) * state(i, 0);
  }
  car.acceleration(0, kOnePlace) += acceleration_by_push_ * push;
  car.tyre_force(0, kOnePlace) += push;
}

AffineCar SampledPlant::at(std::size_t cell, double into) const noexcept {
  const Road& road = road_[cell];
  const double push = stiffness_ * (road.height + road.slope * into) + damping_ * road.slope;
  AffineCar car = rates_;
  drive(car, push * by_push_, {}, push);
  return car;
}

AffineCar SampledPlant::over(std::size_t cell) const noexcept {
  const Road& road = road_[cell];
  const double push = stiffness_ * road.height + damping_ * road.slope,
               rising = stiffness_ * road.slope;
  AffineCar car = unpushed_;
  drive(car, push * end_.constant + rising * end_.rising,
        push * middle_.constant + rising * middle_.rising, push + 0.5 * step_ * rising);
  return car;
}

Plant with_spring(Plant plant, double stiffness) {
  add_along(plant.stiffness, plant.struts.front().row, stiffness);
  return plant;
}

SmallMatrix<6, 6> before_motion(const SmallMatrix<5, 5>& value,
                                const SmallMatrix<5, 6>& motion) noexcept {
  // V M. The motion's last row leaves the 1 as it is.
  SmallMatrix<5, 6> moved;
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t k = 0; k < kOnePlace; ++k)
      for (std::size_t j = 0; j < 6; ++j) moved(i, j) += value(i, k) * motion(k, j);
    moved(i, kOnePlace) += value(i, kOnePlace);
  }

  // M'(V M).
  SmallMatrix<6, 6> form;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t k = 0; k < kOnePlace; ++k)
      for (std::size_t j = 0; j < 6; ++j) form(i, j) += motion(k, i) * moved(k, j);
  for (std::size_t j = 0; j < 6; ++j) form(kOnePlace, j) += moved(kOnePlace, j);
  return form;
}

SmallMatrix<6, 6> cost_form(const AffineCar& car, const RideIndex& index) noexcept {
  SmallMatrix<6, 6> form;
  add_product(form, index.comfort, car.acceleration, car.acceleration);
  add_product(form, index.holding, car.tyre_force, car.tyre_force);
  return form;
}

}  // namespace dashpot
