#pragma once
#include <array>
#include <optional>
#include <vector>

#include "dashpot/numerics/summed.h"
#include "dashpot/plant.h"
#include "dashpot/suspension/bound/force_range.h"
#include "dashpot/suspension/bound/sampled_plant.h"

// The proof of a bound, in intervals and sums whose roundings are bounded. It relies on nothing
// that the search or the Riccati equation claim: both only propose, what is not proven here is
// refused.

namespace dashpot {

/// Limits over time, each the sum of force limits by their multipliers, constant over `block`
/// cells.
struct LimitCourse {
  std::size_t block = 1;
  std::vector<ForceLimit> limits;

  const ForceLimit& in(std::size_t cell) const { return limits[cell / block]; }
};

/// A form over [q, q', 1].
using StateForm = SmallMatrix<5, 5>;

/// A bound on  T J(F) = integral of cost(x, F, t) dt,  x' = A x + B F + w(t),  x(0) = 0,  over all
/// forces F(t) that lie in a range at each instant.
///
/// What is proposed is a course of limits q and a function V(t, x) = z'P(t)z, z = [x, 1], piecewise
/// cubic and continuous in t, with P(T) = 0. What is proven is
///   q(v, F) >= 0 for every velocity and force of the range, by a constant that is found here, and
///   cost(x, F, t) - q(v, F) + dV/dt >= 0 for ALL x, F and t.
/// Then T J(F) >= T J(F) - integral of q = V(0, 0) + integral of (cost - q + dV/dt) >= P(0)[1, 1].
///
/// The second is a form over [x, 1, F] whose entries are polynomials of degree 4 at most in t, once
/// F is counted from a law K(t) z, which changes no sign. It is at least 0 all over a piece where
/// the five forms of its Bernstein coefficients are positive definite: their pivots are above 0.
class Certificate {
 public:
  /// The limits' own constants are not looked at. Plant, car, index and course must stay.
  Certificate(const Plant& plant, const SampledPlant& car, const ForceRange& range,
              const RideIndex& index, const LimitCourse& course);

  /// The limit of a cell with a constant that makes it at least 0 on the range; nothing where no
  /// constant does.
  const std::optional<ForceLimit>& limit(std::size_t cell) const {
    return limits_[cell / course_.block];
  }

  /// One piece further back in time, from the place that is proven, in the same cell: from `into` s
  /// in that cell on, V is the cubic with these values and slopes by time at its start, and these
  /// slopes at its end; its value there is known. False, and nothing changed, where the inequality
  /// is not proven.
  bool back_to(double into, const StateForm& value, const StateForm& slope,
               const StateForm& slope_at_end);

  /// Where all of the time is proven: a number that T J(F) is not below.
  std::optional<double> bound() const;

 private:
  struct Cubic;
  bool holds(const Cubic& value, double from, double to) const;
  void set_car(const Plant& plant);
  bool car_is_moderate() const;

  const SampledPlant& car_;
  const RideIndex& index_;
  const LimitCourse& course_;
  std::vector<std::optional<ForceLimit>> limits_;

  // The place that is proven, and the value there.
  std::size_t cell_;
  double into_;
  StateForm value_;

  // The car over [q, q'], by the force and by the tyre's push.
  std::array<std::array<Summed, 4>, 4> motion_;
  std::array<Summed, 4> by_force_, by_push_, acceleration_, tyre_force_, speed_, displacement_;
  Summed acceleration_by_force_, acceleration_by_push_, stiffness_, damping_;
};

}  // namespace dashpot
