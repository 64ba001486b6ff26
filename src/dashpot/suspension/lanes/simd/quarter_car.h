#pragma once
#include "dashpot/suspension/lanes/simd/dampers.h"

namespace dashpot {
namespace {

/// The driver's current in the coil, and the one that drives the model behind one or both of their
/// lags.
struct Currents {
  Lane coil{}, inner{};
};

/// What moves, and what it feels.
template <std::size_t kStates>
struct Moving {
  Lane x[4]{};            ///< body, wheel, their speeds
  Lane z[kStates + 1]{};  ///< the damper's
  Currents currents;
};

/// The equations of a quarter car in each lane.
template <class Damper>
class QuarterCarLanes {
 public:
  static constexpr std::size_t kStates = Damper::kStates;
  using State = Moving<kStates>;
  explicit QuarterCarLanes(const LaneRide& ride)
      : damper(ride), numbers(*reinterpret_cast<const Numbers*>(ride.numbers)), ride_(ride) {}

  /// Force of the damper at its present current, N.
  Lane damper_force(const Lane* x, const Lane* z) const {
    return damper.force(x[0] - x[1], x[2] - x[3], z);
  }
  /// Friction and stops of the strut, N.
  Lane strut_extra(const Lane* x) const {
    if (!ride_.resists_more) return Lane{};
    const Lane sliding = tanh(numbers.friction_slope * (x[2] - x[3]));
    return strut_resistance(numbers.strut, x[0] - x[1], sliding);
  }
  /// Load of the tyre on the road under this push, N.
  Lane load_on_road(const Lane* x, Lane pushed) const {
    return tyre_load(numbers.tyre, pushed, x[1], x[3]);
  }
  /// What of the road's push reaches the wheel, N.
  Lane push_at_wheel(const Lane* x, Lane pushed) const {
    if (!ride_.resists_more) return pushed;
    return push_on_wheel(numbers.tyre, pushed, load_on_road(x, pushed));
  }
  /// Of coordinate k, m/s^2.
  Lane acceleration(std::size_t k, const Lane* x, Lane strut, Lane pushed) const {
    const Lane(&a)[4] = numbers.by_state[k];
    return (a[0] * x[0] + a[1] * x[1]) + (a[2] * x[2] + a[3] * x[3]) +
           (numbers.by_force[k] * strut + numbers.by_push[k] * pushed);
  }
  /// The current that drives the damper.
  Lane driving(const Currents& currents) const {
    return ride_.lags > 0 ? currents.inner : currents.coil;
  }

  Damper damper;
  using Numbers = QuarterCarNumbers<Lane>;
  const Numbers& numbers;

 private:
  const LaneRide& ride_;
};

/// The road's push within a sample: a parabola through its begin, middle and end and, so that its
/// slopes there are the road's, twist u (u - 1/2) (u - 1), u = 0 ... 1.
struct RoadPush {
  Lane node[3]{}, twist{};
  Lane at(Lane u) const {
    const Lane slope = 4 * node[1] - 3 * node[0] - node[2],
               bend = 2 * (node[0] + node[2]) - 4 * node[1];
    return node[0] + u * (slope + u * bend + (u - 0.5) * (u - 1) * twist);
  }
  /// Terms of its series around u.
  void expand(Lane u, Lane* terms) const {
    const Lane slope = 4 * node[1] - 3 * node[0] - node[2] + 0.5 * twist,
               bend = 2 * (node[0] + node[2]) - 4 * node[1] - 1.5 * twist;
    terms[0] = node[0] + u * (slope + u * (bend + u * twist));
    terms[1] = slope + u * (2 * bend + 3 * u * twist);
    terms[2] = bend + 3 * u * twist;
    terms[3] = twist;
  }
};

}  // namespace
}  // namespace dashpot
