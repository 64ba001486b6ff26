#pragma once
#include "dashpot/suspension/lanes/simd/dampers.h"

namespace dashpot {
namespace {

/// The driver's current in the coil, A, and the one that drives the model behind one or both of
/// their lags, A.
struct Currents {
  Lane coil{}, inner{};
};

/// All that changes while a vehicle rides.
template <std::size_t kStates>
struct Moving {
  Lane x[4]{};            ///< heights of body and wheel, m, and their speeds, m/s
  Lane z[kStates + 1]{};  ///< the damper's states; one more, since there may be none
  Currents currents;
};

/// The equations of a quarter car in each lane:
///
///     [body'', wheel''] = A x + b F + c P
///
/// F N of the damper, friction and stops (extension positive), P N of the road on the wheel.
/// `Damper` gives its force by set_current(), force() and derivative() (dampers.h), or by expand()
/// (tanh_neurons.h). The numbers of LaneRide are read in place, a Lane for each double.
///
/// LaneRun asks for a vehicle's parts by their numbers; here there is one strut and one tyre, 0.
template <class Damper>
class QuarterCarLanes {
 public:
  static constexpr std::size_t kStates = Damper::kStates;
  static constexpr std::size_t kMostCoordinates = 2, kMostStruts = 1, kMostTyres = 1;
  using State = Moving<kStates>;
  using Numbers = QuarterCarNumbers<Lane>;
  static_assert(sizeof(Numbers) == kWidth * sizeof(QuarterCarNumbers<double>),
                "a row of lanes stands for each number of a vehicle, without gaps");

  explicit QuarterCarLanes(const LaneRide& ride)
      : damper(ride), numbers(*reinterpret_cast<const Numbers*>(ride.numbers)), ride_(ride) {}

  /// Force of the damper at its present current, N.
  Lane damper_force(const Lane* x, const Lane* z) const {
    return damper.force(x[0] - x[1], x[2] - x[3], z);
  }
  /// Friction and stops of the strut, N.
  Lane strut_extra(const Lane* x) const {
    if (!ride_.resists_more) return Lane{};
    const Lane sliding = tanh(numbers.strut.friction_slope * (x[2] - x[3]));
    return strut_resistance(numbers.strut.resistance, x[0] - x[1], sliding);
  }
  /// Load of the tyre on the road under this push, N.
  Lane load_on_road(const Lane* x, Lane pushed, std::size_t = 0) const {
    return tyre_load(numbers.tyre, pushed, x[1], x[3]);
  }
  /// The part of the road's push that reaches the wheel, N.
  Lane push_at_wheel(const Lane* x, Lane pushed, std::size_t = 0) const {
    if (!ride_.resists_more) return pushed;
    return push_on_wheel(numbers.tyre, pushed, load_on_road(x, pushed));
  }
  /// Acceleration of coordinate k, m/s^2.
  Lane acceleration(std::size_t k, const Lane* x, Lane strut, Lane pushed) const {
    const Lane(&a)[4] = numbers.by_state[k];
    return (a[0] * x[0] + a[1] * x[1]) + (a[2] * x[2] + a[3] * x[3]) +
           (numbers.by_force[k] * strut + numbers.by_push[k] * pushed);
  }
  /// The current that drives the damper.
  Lane driving(const Currents& currents) const {
    return ride_.lags > 0 ? currents.inner : currents.coil;
  }

  static constexpr std::size_t coordinates() { return 2; }
  static constexpr std::size_t struts() { return 1; }
  static constexpr std::size_t tyres() { return 1; }
  static Currents& currents(State& state, std::size_t) { return state.currents; }
  static Lane* damper_states(State& state, std::size_t) { return state.z; }
  Damper& damper_of(std::size_t) { return damper; }
  const StrutNumbers<Lane>& strut(std::size_t) const { return numbers.strut; }
  const TyreContact<Lane>& tyre(std::size_t) const { return numbers.tyre; }
  /// Deflection of the strut or, from speeds, the speed of that.
  static Lane deflection(const Lane* of, std::size_t) { return of[0] - of[1]; }
  static Lane upper_end(const Lane* of, std::size_t) { return of[0]; }
  static Lane lower_end(const Lane* of, std::size_t) { return of[1]; }
  static Lane wheel(const Lane* of, std::size_t) { return of[1]; }
  /// Not finite where some of the motion is not.
  static Lane sum_of(const Lane* x) { return (x[0] + x[1]) + (x[2] + x[3]); }

  Damper damper;
  const Numbers& numbers;

 private:
  const LaneRide& ride_;
};

/// The road's push within a sample, N, over the share u = 0 ... 1 of it: the parabola through its
/// start, middle and end and, so that it has the road's slopes at both ends, twist u (u - 1/2) (u -
/// 1).
struct RoadPush {
  Lane node[3]{};  ///< at u = 0, 1/2 and 1
  Lane twist{};
  Lane at(Lane u) const {
    const Lane slope = 4 * node[1] - 3 * node[0] - node[2],
               bend = 2 * (node[0] + node[2]) - 4 * node[1];
    return node[0] + u * (slope + u * bend + (u - 0.5) * (u - 1) * twist);
  }
  /// Terms 0 to 3 of its series around u, in shares of the sample; there are no more.
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
