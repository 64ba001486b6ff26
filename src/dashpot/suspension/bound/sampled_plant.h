#pragma once
#include <vector>

#include "dashpot/ground_motion.h"
#include "dashpot/numerics/small_matrix.h"
#include "dashpot/plant.h"

namespace dashpot {

/// The index that is to be small: comfort * mean(body acceleration^2) + holding * mean(tyre
/// force^2), of the tyre's force the part beyond its static load.
struct RideIndex {
  double comfort = 1;  ///< 1/(m/s^2)^2
  double holding = 0;  ///< 1/N^2
};

constexpr std::size_t kOnePlace = 4, kForcePlace = 5;  ///< places in [q, q', 1, F]

/// A quarter car as it moves under a damper's force F. All rows stand over [q, q', 1, F]: a
/// function that is affine in state and force is linear in these.
struct AffineCar {
  SmallMatrix<5, 6> motion;  ///< of [q, q', 1]: its rate, or its value one step later
  SmallMatrix<1, 6> acceleration, tyre_force;  ///< of the body; beyond the static load
  SmallMatrix<1, 6> speed, displacement;       ///< of the damper
};

/// A quarter car on its road, cell by cell of one step. Within a cell the road is straight.
class SampledPlant {
 public:
  /// `start`: s, the instant of the ride at which the first cell begins. Throws Error where
  /// require_quarter_car() does, and at times that make no sense.
  SampledPlant(const Plant& plant, const GroundMotion& ground, double duration, double step,
               double start = 0);

  std::size_t cells() const noexcept { return road_.size(); }
  double step() const noexcept { return step_; }
  /// The road within a cell.
  struct Road {
    double height, slope;  ///< m at the start of the cell, m/s
  };
  const Road& road(std::size_t cell) const noexcept { return road_[cell]; }
  /// Rates and outputs at `into` s in a cell.
  AffineCar at(std::size_t cell, double into) const noexcept;
  /// One step under a force that is held, exactly, with the outputs at the middle of the step.
  AffineCar over(std::size_t cell) const noexcept;

 private:
  /// After some time, by [q, q', 1, F] and by the tyre's push: 1 N that stays, and one that rises
  /// by 1 N/s.
  struct Flow {
    SmallMatrix<5, 6> motion;
    SmallMatrix<5, 1> constant, rising;
  };
  Flow flow(double time) const;
  void set_rates(const Plant& plant);
  /// Adds the column of the 1 in [q, q', 1, F]: what the road's push changes in the motion over the
  /// step (or its rate), and in the outputs by the state at which they are taken.
  void drive(AffineCar& car, const SmallMatrix<5, 1>& change, const SmallMatrix<5, 1>& state,
             double push) const noexcept;

  double step_, stiffness_ = 0, damping_ = 0;  ///< of the tyre
  double acceleration_by_push_ = 0;
  AffineCar rates_;
  SmallMatrix<5, 1> by_push_;
  Flow end_, middle_;
  AffineCar unpushed_;  ///< one step on a road that lies still at 0
  std::vector<Road> road_;
};

/// Throws Error at a plant that is not linear but for its one damper: not a quarter car, a tyre
/// that may lift, stops, friction.
void require_quarter_car(const Plant& plant);
/// The same plant with a spring, N/m, beside its first strut's damper.
Plant with_spring(Plant plant, double stiffness);

/// A form over [q, q', 1] as one over [q, q', 1, F] before a motion over a step, which keeps the 1.
SmallMatrix<6, 6> before_motion(const SmallMatrix<5, 5>& value,
                                const SmallMatrix<5, 6>& motion) noexcept;

/// The index's form over [q, q', 1, F].
SmallMatrix<6, 6> cost_form(const AffineCar& car, const RideIndex& index) noexcept;

}  // namespace dashpot
