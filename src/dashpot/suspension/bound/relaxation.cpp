#include "dashpot/suspension/bound/relaxation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/error.h"
#include "dashpot/numerics/minimise.h"

namespace dashpot {
namespace {

using Form = SmallMatrix<6, 6>;    // over [q, q', 1, F]
using Value5 = SmallMatrix<5, 5>;  // over [q, q', 1]

SmallMatrix<1, 6> unit_row(std::size_t place) {
  SmallMatrix<1, 6> row;
  row(0, place) = 1;
  return row;
}

/// form += weight q(v, F)
void add_limit(Form& form, double weight, const ForceLimit& limit, const SmallMatrix<1, 6>& speed) {
  static const SmallMatrix<1, 6> force = unit_row(kForcePlace), one = unit_row(kOnePlace);
  add_product(form, weight * limit.ff, force, force);
  add_product(form, weight * limit.fv, force, speed);
  add_product(form, weight * limit.vv, speed, speed);
  add_product(form, weight * limit.one, one, one);
}

/// The integrand of L.
Form integrand(const AffineCar& car, const std::vector<ForceLimit>& limits, const RideIndex& index,
               const double* multipliers) {
  Form form = cost_form(car, index);
  for (std::size_t j = 0; j < limits.size(); ++j)
    add_limit(form, -multipliers[j], limits[j], car.speed);
  return form;
}

/// The minimum of a form over F: a form over [q, q', 1], and the F at which it lies, a row over the
/// same.
struct Minimum {
  Value5 value;
  SmallMatrix<1, 5> law;
};
Minimum minimum_over_force(const Form& form) {
  Minimum out;
  for (std::size_t j = 0; j < 5; ++j)
    out.law(0, j) = -form(kForcePlace, j) / form(kForcePlace, kForcePlace);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j)
      out.value(i, j) = form(i, j) + form(i, kForcePlace) * out.law(0, j);
  return out;
}

/// form += 2 z'P (rate of z), or z+'P z+ where `motion` is a whole step.
void add_value(Form& form, const Value5& p, const SmallMatrix<5, 6>& motion, bool whole_step) {
  const SmallMatrix<5, 6> moved = p * motion;
  if (whole_step) {
    form = form + transposed(motion) * moved;
    return;
  }
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      form(i, j) += moved(i, j);
      form(j, i) += moved(i, j);
    }
}

// The certificate: the Riccati equation in continuous time, by Runge-Kutta in as many steps as a
// cell needs.

class Certificate {
 public:
  Certificate(const SampledPlant& car, const std::vector<ForceLimit>& limits,
              const RideIndex& index, const Multipliers& multipliers)
      : car_(car), limits_(limits), index_(index), multipliers_(multipliers) {}

  std::optional<double> minimum() {
    Value5 p;
    for (std::size_t cell = car_.cells(); cell-- > 0;)
      if (!back_over(cell, p)) return {};
    return p(kOnePlace, kOnePlace);
  }

 private:
  /// A cell in `steps_` steps and in twice as many, until both agree; the next cell starts with
  /// half as many.
  bool back_over(std::size_t cell, Value5& p) {
    constexpr int kMost = 256;
    constexpr double kAgree = 1e-10;
    for (int steps = std::max(1, steps_ / 2); steps <= kMost; steps *= 2) {
      Value5 coarse = p, fine = p;
      if (!integrate(cell, steps, coarse) || !integrate(cell, 2 * steps, fine)) continue;
      if (!(size_of(fine + -1.0 * coarse) <= kAgree * size_of(fine))) continue;
      p = fine;
      steps_ = steps;
      return true;
    }
    return false;
  }

  bool integrate(std::size_t cell, int steps, Value5& p) const {
    const double h = car_.step() / steps;
    for (int k = steps; k > 0; --k) {
      const double end = h * k;
      Value5 slope[4];
      if (!slope_of(p, end, cell, slope[0])) return false;
      if (!slope_of(p + 0.5 * h * slope[0], end - 0.5 * h, cell, slope[1])) return false;
      if (!slope_of(p + 0.5 * h * slope[1], end - 0.5 * h, cell, slope[2])) return false;
      if (!slope_of(p + h * slope[2], end - h, cell, slope[3])) return false;
      p = p + h / 6 * (slope[0] + 2.0 * slope[1] + 2.0 * slope[2] + slope[3]);
    }
    return true;
  }

  /// -dP/dt.
  bool slope_of(const Value5& p, double into, std::size_t cell, Value5& slope) const {
    const AffineCar now = car_.at(cell, into);
    Form form = integrand(now, limits_, index_, multipliers_.in(cell));
    add_value(form, p, now.motion, false);
    if (!(form(kForcePlace, kForcePlace) > 0)) return false;
    slope = minimum_over_force(form).value;
    return true;
  }

  /// The greatest entry, states counted in cm and dm/s.
  static double size_of(const Value5& p) {
    constexpr double kUnit[] = {0.01, 0.01, 0.1, 0.1, 1};
    double greatest = 0;
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j < 5; ++j) {
        const double entry = std::abs(p(i, j)) * kUnit[i] * kUnit[j];
        if (entry > greatest || std::isnan(entry)) greatest = entry;  // and NaN stays
      }
    return greatest;
  }

  const SampledPlant& car_;
  const std::vector<ForceLimit>& limits_;
  const RideIndex& index_;
  const Multipliers& multipliers_;
  int steps_ = 1;
};

// The search for multipliers, on cells over which the force is held. A little noise keeps it off
// the edge, where the minimum of L falls to minus infinity: value + noise * sum of tr P falls there
// first, smoothly.

class Dual {
 public:
  /// noise: variance that each state gains per cell.
  Dual(const SampledPlant& car, const std::vector<ForceLimit>& limits, const RideIndex& index,
       const std::array<double, 4>& noise)
      : car_(car), limits_(limits), index_(index), noise_(noise), law_(car.cells()) {}

  /// Minimum of L on the cells, with the noise's; false where there is none.
  bool value(const Multipliers& multipliers, double& out) {
    Value5 p;
    double shaken = 0;
    for (std::size_t cell = car_.cells(); cell-- > 0;) {
      for (std::size_t i = 0; i < kOnePlace; ++i) shaken += noise_[i] * p(i, i);

      // One step back: the value over [q, q', 1], least by the force.
      const AffineCar car = car_.over(cell);
      Form form = car_.step() * integrand(car, limits_, index_, multipliers.in(cell));
      add_value(form, p, car.motion, true);
      if (!(form(kForcePlace, kForcePlace) > 0)) return false;
      const Minimum least = minimum_over_force(form);
      p = least.value;
      law_[cell] = least.law;
    }
    out = p(kOnePlace, kOnePlace) + shaken;
    return std::isfinite(out);
  }

  /// Its slope by each multiplier, at the multipliers of the last value(): less the mean of each
  /// limit under the law.
  void slope(const Multipliers& multipliers, std::span<double> out) const {
    std::fill(out.begin(), out.end(), 0.0);
    Value5 moment;  // of [q, q', 1]
    moment(kOnePlace, kOnePlace) = 1;
    for (std::size_t cell = 0; cell < car_.cells(); ++cell) {
      const AffineCar car = car_.over(cell);

      // The mean of each limit under the law, over this cell.
      const Form joint = with_force(moment, law_[cell]);
      for (std::size_t j = 0; j < limits_.size(); ++j) {
        Form limit;
        add_limit(limit, car_.step(), limits_[j], car.speed);
        double mean = 0;
        for (std::size_t k = 0; k < limit.values.size(); ++k)
          mean += limit.values[k] * joint.values[k];
        out[cell / multipliers.block * limits_.size() + j] -= mean;
      }

      // The moments one cell later, with the noise.
      moment = car.motion * joint * transposed(car.motion);
      for (std::size_t i = 0; i < kOnePlace; ++i) moment(i, i) += noise_[i];
    }
  }

  const std::vector<SmallMatrix<1, 5>>& law() const { return law_; }

 private:
  static Form with_force(const Value5& moment, const SmallMatrix<1, 5>& law) {
    SmallMatrix<6, 5> lift;
    for (std::size_t i = 0; i < 5; ++i) {
      lift(i, i) = 1;
      lift(kForcePlace, i) = law(0, i);
    }
    return lift * moment * transposed(lift);
  }

  const SampledPlant& car_;
  const std::vector<ForceLimit>& limits_;
  const RideIndex& index_;
  std::array<double, 4> noise_;
  std::vector<SmallMatrix<1, 5>> law_;
};

/// Mean squares of [q, q'] under a force in proportion to the speed: how far this car moves on this
/// road.
std::array<double, 4> typical_motion(const SampledPlant& car, double damping) {
  std::array<double, 4> sum{};
  SmallMatrix<5, 1> z;
  z(kOnePlace, 0) = 1;
  for (std::size_t cell = 0; cell < car.cells(); ++cell) {
    const AffineCar now = car.over(cell);

    // The force that F = damping v gives, which itself slows the motion.
    SmallMatrix<6, 1> with_force;
    for (std::size_t i = 0; i < 5; ++i) with_force(i, 0) = z(i, 0);
    const double free = (now.speed * with_force)(0, 0);
    with_force(kForcePlace, 0) = damping * free / (1 - damping * now.speed(0, kForcePlace));
    z = now.motion * with_force;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += z(i, 0) * z(i, 0);
  }
  for (double& value : sum) value /= static_cast<double>(car.cells());
  return sum;
}

/// The damping in the middle of limits q = -(F - a v)(F - b v), (a + b) / 2, in the mean over them,
/// N*s/m.
double middle_damping(const std::vector<ForceLimit>& limits) {
  double sum = 0;
  for (const ForceLimit& limit : limits) sum += limit.ff < 0 ? -0.5 * limit.fv / limit.ff : 0;
  return sum / static_cast<double>(limits.size());
}

/// The same multipliers on blocks of another length, over cells of another plant on the same road.
Multipliers on_blocks(const Multipliers& from, const SampledPlant& from_car,
                      const SampledPlant& car, std::size_t block) {
  Multipliers to{.block = block, .limits = from.limits, .values = {}};
  const double ratio = car.step() / from_car.step();
  for (std::size_t cell = 0; cell < car.cells(); cell += block) {
    const auto there = static_cast<std::size_t>((static_cast<double>(cell) + 0.5) * ratio);
    const double* values = from.in(std::min(there, from_car.cells() - 1));
    to.values.insert(to.values.end(), values, values + from.limits);
  }
  return to;
}

/// One climb, in logarithms: multipliers stay above 0 whatever their size.
Multipliers climb(Dual& dual, Multipliers multipliers, int iterations) {
  double scale = 0;
  if (!dual.value(multipliers, scale)) return multipliers;
  scale = std::abs(scale);

  // L-BFGS goes down, so the function that it is given is -L over its size at the start.
  Multipliers trial = multipliers;
  const auto set = [&](std::span<const double> logarithms) {
    for (std::size_t k = 0; k < trial.values.size(); ++k) trial.values[k] = std::exp(logarithms[k]);
  };
  const SmoothFunction fall = [&](std::span<const double> logarithms, double& value,
                                  std::span<double> gradient) {
    set(logarithms);
    if (!dual.value(trial, value)) return false;
    value /= -scale;
    if (gradient.empty()) return true;
    dual.slope(trial, gradient);
    for (std::size_t k = 0; k < gradient.size(); ++k) gradient[k] *= -trial.values[k] / scale;
    return true;
  };

  std::vector<double> start;
  for (const double value : multipliers.values) start.push_back(std::log(value));
  set(minimise(fall, std::move(start),
               {.max_iterations = iterations, .function_tolerance = 1e-6, .on_iteration = {}})
          .x);
  return trial;
}

}  // namespace

std::optional<double> certified_minimum(const SampledPlant& car,
                                        const std::vector<ForceLimit>& limits,
                                        const RideIndex& index, const Multipliers& multipliers) {
  return Certificate(car, limits, index, multipliers).minimum();
}

Relaxation relax(const SampledPlant& car, const SampledPlant& coarse,
                 const std::vector<ForceLimit>& limits, const RideIndex& index,
                 const RelaxationOptions& options) {
  // A first guess of their size: the weight that the index itself gives a force.
  const double by_force = coarse.at(0, 0).acceleration(0, kForcePlace);
  const double natural = index.comfort * by_force * by_force + index.holding;
  const std::array<double, 4> motion = typical_motion(coarse, middle_damping(limits));

  // Noise in proportion to how far this car moves on this road.
  const auto shaken = [&](double per_second) {
    std::array<double, 4> noise = motion;
    for (double& value : noise) value *= per_second * coarse.step();
    return Dual(coarse, limits, index, noise);
  };
  Dual much = shaken(1e-2), little = shaken(1e-4);

  // Multipliers that stay, then over shorter and shorter blocks, at last with less noise.
  const Multipliers constant =
      climb(much, {coarse.cells(), limits.size(), std::vector<double>(limits.size(), natural)},
            options.iterations);
  Multipliers found = constant;
  for (std::size_t block = 8 * options.block; block >= options.block; block /= 2)
    found = climb(much, on_blocks(found, coarse, coarse, block), options.iterations);
  found = climb(little, found, options.iterations);

  // A climb may end at an edge that only its cells have: then the constants pull it back, or less
  // of them.
  const double duration = car.step() * static_cast<double>(car.cells());
  const auto cells = static_cast<std::size_t>(
      std::max(1.0, std::round(static_cast<double>(options.block) * coarse.step() / car.step())));
  constexpr double kPulls[] = {0, 0.003, 0.01, 0.03, 0.1, 0.3, 1};
  for (double size = 1; size > 1e-6; size /= 10)
    for (const double pull : kPulls) {
      Multipliers mixed = found;
      for (std::size_t k = 0; k < mixed.values.size(); ++k)
        mixed.values[k] += pull * (size * constant.values[k % limits.size()] - found.values[k]);
      const Multipliers certified = on_blocks(mixed, coarse, car, cells);
      const std::optional<double> least = certified_minimum(car, limits, index, certified);
      if (least) return {certified, *least / duration};
    }
  throw Error("clairvoyant bound", "no multipliers have a certified minimum");
}

}  // namespace dashpot
