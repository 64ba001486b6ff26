#pragma once
#include <vector>

#include "dashpot/monitor.h"
#include "dashpot/simulate.h"
#include "dashpot/suspension/bound/force_range.h"
#include "dashpot/suspension/bound/range_damper.h"
#include "dashpot/suspension/bound/sampled_plant.h"

// A bound on what any semi-active suspension can do on a road, even one that knows the road in
// advance (docs/bound.md).
namespace dashpot {

/// Means over a ride.
struct RideSquares {
  double acceleration = 0;  ///< of the body, (m/s^2)^2
  double tyre_force = 0;    ///< beyond the static load, N^2

  double of(const RideIndex& index) const {
    return index.comfort * acceleration + index.holding * tyre_force;
  }
};
/// The means of a quarter car's trace, by trapezes between its samples.
RideSquares ride_squares(const Trace& trace, const Plant& plant);

/// A motion of a strut: the greatest of a ride either way.
struct StrutMotion {
  double travel = 0;  ///< m
  double speed = 0;   ///< m/s
  void include(const StrutMotion& other);
};
/// Of the plant's first strut.
StrutMotion strut_motion(const Trace& trace, const Plant& plant);
/// The motion within which a range holds; infinite where it goes on outside.
StrutMotion motion_of(const ForceRange& range);

/// Comfort and road holding as shares of a reference: `comfort` of one, 1 - `comfort` of the other;
/// the reference itself has the index 1.
RideIndex weighted_index(double comfort, const RideSquares& reference);

struct BoundOptions {
  double duration = 10;       ///< s
  double step = 1e-3;         ///< s, for which the optimum holds its demand
  double search_step = 4e-3;  ///< s, of the cells on which limits are sought
  int iterations = 100;       ///< of each climb to better limits
  std::vector<std::vector<double>>
      starts;  ///< shares per step that the optimum shall not fall behind
  int threads = 0;
  Monitor monitor = {};
};

/// Bound and optimum of one index on one road.
struct ClairvoyantBound {
  RideIndex index;
  double bound = 0;            ///< no force within the range makes the index less
  double optimum = 0;          ///< simulated: what the demands below reach
  RideSquares squares;         ///< of the optimum
  StrutMotion motion;          ///< of the optimum
  bool leaves = false;         ///< the optimum goes beyond the range, so that nothing is proven
  std::vector<double> shares;  ///< demands, per step, from softest (0) to hardest (1)
  bool proven = false;  ///< the bound, by a certificate that limits every rounding; else it is 0

  double gap() const { return optimum > 0 ? (optimum - bound) / optimum : 0; }
};

/// For every force F(t) within the range at each instant, however made, the index of this quarter
/// car on this road, straight within steps, is at least `bound`. Where the range ends, or holds for
/// a travel only, that is said of the rides that stay within these, and of none where the optimum
/// does not. With one force for each motion,
/// where there is nothing to choose, the bound is the index of the one ride there is, simulated.
/// Throws Error at a plant that is not a linear quarter car.
ClairvoyantBound clairvoyant_bound(const Plant& plant, const GroundMotion& ground,
                                   const ForceRange& range, const RideIndex& index,
                                   const BoundOptions& options);
/// Bounds of several indices at once: a front of comfort against road holding. The same bits on any
/// number of threads.
std::vector<ClairvoyantBound> clairvoyant_front(const Plant& plant, const GroundMotion& ground,
                                                const ForceRange& range,
                                                const std::vector<RideIndex>& indices,
                                                const BoundOptions& options);

/// How much of what is possible a controller reaches: (passive - controller) / (passive - optimum).
/// NaN where next to nothing is possible: the optimum is less than kLeastPossible better.
double share_of_possible(double passive, double controller, double optimum);
inline constexpr double kLeastPossible = 0.05;  ///< of passive

/// Demands one share after another, as currents of a RangeDamper; the last one stays.
ControllerPointer play_shares(std::vector<double> shares);

}  // namespace dashpot
