#pragma once
#include "dashpot/suspension/lanes/simd/quarter_car.h"
#include "dashpot/suspension/steps/runge_kutta.h"

namespace dashpot {
namespace {

/// The method of Dormand and Prince (DormandPrince has its tableau), every lane in steps of its own
/// length. The unknowns are y = [heights, speeds, the damper's states, currents behind lags]; kLags
/// says how many of driver and model lag behind the command.
///
/// Error of a step, in tolerances: the greatest over the pairs of heights and of speeds, each
/// against the pair's greatest magnitude, and over the damper's states one by one,
///
///     |y_5 - y_4| / (absolute + relative * size)
///
/// A step is accepted where that is at most 1, else tried again, shorter. Next length: 0.9 h
/// error^(-1/5), between a fifth and five times h, between 1/256 of a sample and the whole of it.
/// The shortest is accepted with any error and counts as missed. Lengths are in s; no step reaches
/// over a sample's end.
template <class Damper, std::size_t kLags>
class AdaptiveSteps {
  using Car = QuarterCarLanes<Damper>;
  using State = typename Car::State;
  static constexpr std::size_t kStates = Damper::kStates, kSize = 4 + kStates + kLags;
  /// y' and, by the way, the damper's force.
  struct Slope {
    Lane d[kSize];  ///< heights (0, 1), speeds (2, 3), damper (from 4), currents (from 4 + kStates)
    Lane force;     ///< N
    Lane along;     ///< m/s, along the branch of the loop, and
    Lane steep;     ///< how steep its r is there (LoopPath)
  };
  using Loop = typename Damper::Loop;
  static_assert(kLags <= 2, "driver and model");

 public:
  AdaptiveSteps(const LaneRide& ride, Car& car)
      : ride_(ride), car_(car), next_(all(ride.sample_time)) {}

  /// Before all else: a loop's state as the steps have it.
  void begin(State& state) {
    if constexpr (Loop::kExists) looped(state.z) = car_.damper.loop.folded(looped(state.z));
  }
  /// Forces at the start of a sample, after the command has changed in some lanes.
  [[gnu::noinline, gnu::flatten]] void refresh(const State& state, const Lane* command,
                                               LaneMask changed, const RoadPush* road) {
    keep(slope(state, *command, road->node[0]), changed);
  }
  /// At the present state: the damper's force, N, and the accelerations of the coordinates, m/s^2.
  Lane force(std::size_t) const { return first_.force; }
  const Lane* acceleration() const { return first_.d + 2; }

  /// Tries one step in these lanes. Returns those that have reached the end of their sample.
  LaneMask step(State& state, const Lane* commands, const RoadPush* roads, LaneMask riding) {
    const Lane command = *commands;
    const RoadPush& road = *roads;

    // As long as was proposed, or as much as is left of the sample.
    const double whole = ride_.sample_time, least = whole / 256;
    const Lane left = whole - done_;
    const LaneMask last = next_ >= left;
    const Lane h = last ? left : next_;
    State end;
    Slope ending;
    const Lane error = attempt(state, h, command, road, done_ / whole, end, ending);
    LaneMask accepted = riding & ((error <= 1) | (h <= least) | (error != error));
    typename Loop::Met met;
    if constexpr (Loop::kExists) {
      met = car_.damper.loop.meet(speeds_, h, kNearTurn * whole);
      accepted &= ~met.over;
    }

    // Where it is accepted, its end becomes the state. A NaN is accepted: the run finds it.
    missed |= accepted & !(error <= 1);
    take(state, end, accepted);
    keep(ending, accepted);
    steps += accepted ? all(1) : Lane{};

    // The next length. A step that was cut short by the sample's end does not shorten it.
    const Lane factor = fmin(fmax(0.9 * about_fifth_root_below(fmax(error, 1e-5)), 0.2), 5);
    const Lane proposed = fmin(fmax(h * factor, least), whole);
    next_ = riding ? (accepted & last ? fmax(next_, proposed) : proposed) : next_;
    done_ = accepted ? (last ? Lane{} : done_ + h) : done_;
    if constexpr (Loop::kExists)
      take_turns(met, state, command, road, accepted, accepted & last, riding);

    // With one lag the coil's current is either the driving one or, where the driver has no lag,
    // the command.
    const LaneMask arrived = accepted & last;
    if constexpr (kLags == 1)
      state.currents.coil = (arrived & (car_.numbers.strut.driver_lag > 0)) ? state.currents.inner
                                                                            : state.currents.coil;
    return arrived;
  }

  LaneMask missed{};  ///< lanes in which some step missed the tolerance
  Lane steps{};       ///< accepted in each lane

 private:
  /// y' of a state under a command, A, and a push of the road, N.
  [[gnu::always_inline]] Slope slope(const State& s, Lane command, Lane road) {
    Slope out;
    const Lane* x = s.x;

    // Currents: first-order lags on the way from the command to the one that drives the model.
    if constexpr (kLags > 0) car_.damper.set_current(s.currents.inner);
    if constexpr (kLags == 1)
      out.d[4 + kStates] = (car_.numbers.strut.driver_lag + car_.numbers.strut.model_lag) *
                           (command - s.currents.inner);
    if constexpr (kLags == 2) {
      out.d[4 + kStates] = car_.numbers.strut.model_lag * (s.currents.coil - s.currents.inner);
      out.d[5 + kStates] = car_.numbers.strut.driver_lag * (command - s.currents.coil);
    }

    // The damper's states as its law has them.
    Lane z[kStates + 1];
    for (std::size_t k = 0; k < kStates; ++k) z[k] = s.z[k];
    [[maybe_unused]] typename Loop::Place place;
    if constexpr (Loop::kExists) {
      place = car_.damper.loop.place(looped(s.z));
      looped(z) = car_.damper.loop.unfolded(place);
    }

    // Forces, and what they make of the motion.
    out.force = car_.damper_force(x, z);
    const Lane force = out.force + car_.strut_extra(x), pushed = car_.push_at_wheel(x, road);
    car_.damper.derivative(x[0] - x[1], x[2] - x[3], z, out.d + 4);
    if constexpr (Loop::kExists) {
      out.along = car_.damper.loop.along(Damper::LoopOfLaw::travel(x[2] - x[3], out.d + 4));
      out.steep = place.steep;
      looped(out.d + 4) = car_.damper.loop.folded_rate(looped(out.d + 4), out.along, place);
    }
    out.d[0] = x[2];
    out.d[1] = x[3];
    out.d[2] = car_.acceleration(0, x, force, pushed);
    out.d[3] = car_.acceleration(1, x, force, pushed);
    return out;
  }
  void keep(const Slope& fresh, LaneMask which) {
    for (std::size_t k = 0; k < kSize; ++k) first_.d[k] = which ? fresh.d[k] : first_.d[k];
    first_.force = which ? fresh.force : first_.force;
    if constexpr (Loop::kExists) {
      first_.along = which ? fresh.along : first_.along;
      first_.steep = which ? fresh.steep : first_.steep;
    }
  }
  /// The state of the damper's loop among its states.
  template <class Number>
  static Number& looped(Number* z) {
    return z[Damper::LoopOfLaw::kState];
  }

  /// On to other branches, and lengths of steps that go by turns.
  void take_turns(const typename Loop::Met& met, State& state, Lane command, const RoadPush& road,
                  LaneMask accepted, LaneMask arrived, LaneMask riding) {
    auto& loop = car_.damper.loop;
    const LaneMask changed = loop.go_on(met, first_.along, accepted, looped(state.z));
    const double whole = ride_.sample_time;
    next_ = (riding & met.over & ~met.stuck) ? fmax(met.until, kNearTurn * whole) : next_;
    next_ = (accepted & met.turned) ? fmax(next_, kAfterTurn * whole) : next_;
    const Lane place = arrived ? all(1) : done_ / whole;
    if (any(changed)) keep(slope_again(state, command, road.at(place)), changed);
  }
  [[gnu::noinline, gnu::flatten]] Slope slope_again(const State& state, Lane command, Lane road) {
    return slope(state, command, road);
  }
  /// to = change(from, its place in Slope::d), number by number.
  template <class Change>
  [[gnu::always_inline]] static void each_of(const State& from, State& to, Change change) {
#pragma GCC unroll 16
    for (std::size_t k = 0; k < 4; ++k) to.x[k] = change(from.x[k], k);
#pragma GCC unroll 16
    for (std::size_t k = 0; k < kStates; ++k) to.z[k] = change(from.z[k], 4 + k);
    if constexpr (kLags > 0) to.currents.inner = change(from.currents.inner, 4 + kStates);
    if constexpr (kLags > 1) to.currents.coil = change(from.currents.coil, 5 + kStates);
  }
  /// The end of a step becomes the state in the lanes that accepted it.
  static void take(State& state, const State& end, LaneMask accepted) {
    for (std::size_t k = 0; k < 4; ++k) state.x[k] = accepted ? end.x[k] : state.x[k];
    for (std::size_t k = 0; k < kStates; ++k) state.z[k] = accepted ? end.z[k] : state.z[k];
    if constexpr (kLags > 0)
      state.currents.inner = accepted ? end.currents.inner : state.currents.inner;
    if constexpr (kLags > 1)
      state.currents.coil = accepted ? end.currents.coil : state.currents.coil;
  }

  /// The sum of weights[i] k_i of component n, without the slopes whose weight is 0.
  template <class... Later>
  [[gnu::always_inline]] static Lane weighted(const double* weights, std::size_t n, const Slope& k1,
                                              const Later&... later) {
    Lane sum = weights[0] * k1.d[n];
    [[maybe_unused]] const auto add = [&](double weight, Lane slope) {
      if (weight != 0) sum += weight * slope;
    };
    (add(*++weights, later.d[n]), ...);
    return sum;
  }
  /// to = from + h (a_1 k_1 + a_2 k_2 + ...), a: the stage's row of the tableau.
  template <std::size_t kStage, class... Slopes>
  [[gnu::always_inline]] static void move(const State& from, Lane h, State& to,
                                          const Slopes&... slopes) {
    static_assert(sizeof...(slopes) == kStage, "a stage takes all slopes before it");
    each_of(from, to, [&](Lane y, std::size_t n) {
      return y + h * weighted(DormandPrince::kFrom[kStage], n, slopes...);
    });
  }

  /// A step of length h, s, from the share `begin` of the sample on: its end, the slope there (k7)
  /// and, returned, its error in tolerances. Kept out of line: inlined copies may round
  /// differently.
  [[gnu::noinline, gnu::flatten]] Lane attempt(const State& from, Lane h, Lane command,
                                               const RoadPush& road, Lane begin, State& end,
                                               Slope& k7) {
    const Lane share = h / ride_.sample_time;
    const auto road_of = [&](std::size_t stage) {
      return road.at(begin + DormandPrince::kAt[stage] * share);
    };
    const Slope& k1 = first_;
    State trial;

    // Stages 2 to 6: each starts where the slopes before it lead to.
    move<1>(from, h, trial, k1);
    const Slope k2 = slope(trial, command, road_of(1));
    move<2>(from, h, trial, k1, k2);
    const Slope k3 = slope(trial, command, road_of(2));
    move<3>(from, h, trial, k1, k2, k3);
    const Slope k4 = slope(trial, command, road_of(3));
    move<4>(from, h, trial, k1, k2, k3, k4);
    const Slope k5 = slope(trial, command, road_of(4));
    move<5>(from, h, trial, k1, k2, k3, k4, k5);
    const Slope k6 = slope(trial, command, road_of(5));

    // Stage 7 is the end of the step, and its slope the first one of the next step.
    move<6>(from, h, end, k1, k2, k3, k4, k5, k6);
    k7 = slope(end, command, road_of(6));
    if constexpr (Loop::kExists) {
      static_assert(DormandPrince::kAt[2] == Loop::kEarly && DormandPrince::kAt[3] == Loop::kLate);
      speeds_ = {k1.along, k3.along, k4.along, k7.along};
    }

    // The error: what the embedded solution of order 4 differs by.
    State off;
    each_of(from, off, [&](Lane, std::size_t n) {
      return h * weighted(DormandPrince::kError, n, k1, k2, k3, k4, k5, k6, k7);
    });
    return distance(from, end, off, k7, h);
  }

  /// The error in tolerances. A damper's state, which may pass through 0 while it moves fast, is
  /// measured against its size and how far it moves in the step. Currents are
  /// not measured.
  Lane distance(const State& from, const State& end, const State& off, const Slope& k7,
                Lane h) const {
    const double absolute = ride_.absolute_tolerance, relative = ride_.relative_tolerance;
    const auto of = [&](Lane error, Lane size) { return error / (absolute + relative * size); };
    const auto pair = [&](std::size_t k) {
      const Lane size = fmax(fmax(fabs(from.x[k]), fabs(from.x[k + 1])),
                             fmax(fabs(end.x[k]), fabs(end.x[k + 1])));
      return of(fmax(fabs(off.x[k]), fabs(off.x[k + 1])), size);
    };
    Lane greatest = fmax(pair(0), pair(2));
    for (std::size_t k = 0; k < kStates; ++k) {
      Lane error = fabs(off.z[k]), size = fabs(from.z[k]) + fabs(h * first_.d[4 + k]);
      if constexpr (Loop::kExists)
        if (k == Damper::LoopOfLaw::kState) {
          error = car_.damper.loop.error(error, first_.steep, k7.steep);
          size = car_.damper.loop.size(size);
        }
      greatest = fmax(of(error, size), greatest);
    }
    return greatest;
  }

  /// Of a sample: the shortest step to a turn of a loop, and the first one after it.

  static constexpr double kNearTurn = 1.0 / 65536, kAfterTurn = 0.2;

  const LaneRide& ride_;
  Car& car_;
  typename Loop::Speeds speeds_;  ///< of the last try
  Lane next_;                     ///< s, the length to try next
  Lane done_{};                   ///< s of the present sample
  Slope first_{};                 ///< at the present state
};

}  // namespace
}  // namespace dashpot
