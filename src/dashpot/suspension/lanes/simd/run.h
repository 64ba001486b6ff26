#pragma once
#include "dashpot/suspension/lanes/simd/controls.h"
#include "dashpot/suspension/lanes/simd/quarter_car.h"
#include "dashpot/suspension/lanes/simd/tally.h"

namespace dashpot {
namespace {

/// From rest, sample by sample. Each lane goes on as soon as it has reached the end of a sample:
/// none waits for another that takes more steps. `Car` is QuarterCarLanes, with AdaptiveSteps or
/// TaylorSteps, or CarLanes with CarSteps.
template <class Car, class Steps>
class LaneRun {
 public:
  explicit LaneRun(const LaneRide& ride)
      : ride_(ride), car_(ride), steps_(ride, car_), tally_(ride) {
    // LaneRide::start, strut by strut: the command, the two currents, then the damper's states.
    const double* start = ride.start;
    for (std::size_t s = 0; s < car_.struts(); ++s, start += (3 + Car::kStates) * kWidth) {
      command_[s] = load(start);
      car_.currents(state_, s) = {load(start + kWidth), load(start + 2 * kWidth)};
      for (std::size_t k = 0; k < Car::kStates; ++k)
        car_.damper_states(state_, s)[k] = load(start + (3 + k) * kWidth);
      car_.damper_of(s).set_current(car_.driving(car_.currents(state_, s)));
    }
  }

  void run() {
    // All lanes at their first sample.
    LaneMask riding = all(0) == 0;
    steps_.begin(state_);
    meet_ground(riding);
    steps_.refresh(state_, command_, riding, road_);
    take_sample(riding);

    // A step in each lane; those that reach a sample meet it before they go on.
    while (any(riding &= place_ < static_cast<std::int64_t>(ride_.samples))) {
      const LaneMask arrived = steps_.step(state_, command_, road_, riding);
      if (!any(arrived)) continue;
      place_ -= arrived;  // true is -1
      riding &= ~lost(arrived);
      meet_ground(arrived & riding);
      take_sample(arrived & riding);
    }

    tally_.row(kDivergedAt) = lost_at_;
    tally_.row(kMissed) = steps_.missed ? all(1) : Lane{};
    tally_.row(kEvaluations) = steps_.steps;
    tally_.store_all(car_.struts(), car_.tyres());
  }

 private:
  /// At a sample the controller acts first, and what is recorded shows the forces after that.
  void take_sample(LaneMask which) {
    Lane commands[Car::kMostStruts];
    if (ride_.control_numbers)
      demand(commands, which);
    else if (ride_.control)
      ask(commands, which);
    if (ride_.control_numbers || ride_.control) follow(commands);
    record(which);
  }

  /// For lanes that have come to a sample: the road within it.
  void meet_ground(LaneMask which) {
    // The next kLaneAhead samples of road, for lanes that have used up theirs.
    const LaneMask ends = which & ((place_ & (kLaneAhead - 1)) == 0);
    if (any(ends))
      for (std::size_t lane = 0; lane < kWidth; ++lane)
        if (ends[lane])
          ride_.ground(ride_.pilot, lane, 2 * static_cast<std::size_t>(place_[lane]), heights_,
                       rates_);

    // The push through the nodes of this sample, with the road's own slopes at its ends.
    together_ = !any(place_ != place_[0]);
    for (std::size_t w = 0; w < car_.tyres(); ++w) {
      const TyreContact<Lane>& tyre = car_.tyre(w);
      RoadPush& road = road_[w];
      Lane height[3], rate[3];
      for (std::size_t node = 0; node < 3; ++node) {
        height[node] = at_node(heights_ + w * kLaneNodes * kWidth, node);
        rate[node] = at_node(rates_ + w * kLaneNodes * kWidth, node);
        road.node[node] = road_push(tyre, height[node], rate[node]);
      }
      road.twist =
          tyre.stiffness * (ride_.sample_time * (rate[0] + rate[2]) - 2 * (height[2] - height[0]));
      height_[w] = height[0];
    }
  }
  /// Rows of heights_ or rates_ at a node (0, 1, 2: start, middle, end) of each lane's sample.
  Lane at_node(const double* of, std::size_t node) const {
    const auto row = [&](std::int64_t place) {
      return of + (2 * (static_cast<std::size_t>(place) % kLaneAhead) + node) * kWidth;
    };
    if (together_) return load(row(place_[0]));
    Lane lanes;
    for (std::size_t lane = 0; lane < kWidth; ++lane) lanes[lane] = row(place_[lane])[lane];
    return lanes;
  }

  /// Commands of a control law that has lanes.
  void demand(Lane* commands, LaneMask which) const {
    const Lane* v = state_.x + car_.coordinates();
    for (std::size_t s = 0; s < car_.struts(); ++s) {
      const auto number = [&](LaneControlNumber row) {
        return load(ride_.control_numbers + (s * kLaneControlNumbers + row) * kWidth);
      };
      const Lane demand =
          lane_controls::demand_of(ride_.control_law, number(kControlParameter),
                                   {number(kSoftCurrent), number(kHardCurrent)},
                                   {car_.upper_end(v, s), car_.upper_end(steps_.acceleration(), s),
                                    car_.lower_end(v, s), car_.deflection(v, s)});
      commands[s] = which ? demand : command_[s];
    }
  }

  /// Commands of the controllers of these lanes, one by one.
  void ask(Lane* commands, LaneMask which) {
    const Lane *x = state_.x, *v = x + car_.coordinates();
    Lane signals[kLaneSignals * Car::kMostStruts + 2 * Car::kMostCoordinates + Car::kMostTyres];
    Lane* of = signals;
    for (std::size_t s = 0; s < car_.struts(); ++s, of += kLaneSignals) {
      of[kBodyVelocity] = car_.upper_end(v, s);
      of[kBodyAcceleration] = car_.upper_end(steps_.acceleration(), s);
      of[kWheelVelocity] = car_.lower_end(v, s);
      of[kDeflection] = car_.deflection(x, s);
      of[kDeflectionVelocity] = car_.deflection(v, s);
      of[kForce] = steps_.force(s);
      of[kCurrent] = car_.currents(state_, s).coil;
      commands[s] = command_[s];
    }
    for (std::size_t k = 0; k < 2 * car_.coordinates(); ++k) *of++ = x[k];
    for (std::size_t w = 0; w < car_.tyres(); ++w) *of++ = height_[w];

    ride_.control(ride_.pilot, reinterpret_cast<const double*>(signals),
                  reinterpret_cast<double*>(commands),
                  reinterpret_cast<const std::int64_t*>(&which));
  }

  void follow(const Lane* commands) {
    LaneMask changed_here{};
    for (std::size_t s = 0; s < car_.struts(); ++s) {
      const LaneMask changed = commands[s] != command_[s];
      if (!any(changed)) continue;
      changed_here |= changed;
      command_[s] = commands[s];

      // A coil without a lag follows at once, and forces are others from here on.
      Currents& currents = car_.currents(state_, s);
      currents.coil = (changed & !(car_.strut(s).driver_lag > 0)) ? command_[s] : currents.coil;
      car_.damper_of(s).set_current(car_.driving(currents));
    }
    if (any(changed_here)) steps_.refresh(state_, command_, changed_here, road_);
  }

  /// Adds these lanes' sample to the measures and, where wanted, to the trace.
  void record(LaneMask which) {
    const Lane *x = state_.x, *v = x + car_.coordinates();
    const auto first = static_cast<std::int64_t>(ride_.discarded),
               last = static_cast<std::int64_t>(ride_.samples);
    const LaneMask counts = which & (place_ >= first);
    tally_.add_body(steps_.acceleration()[0], which, counts);

    // The energy is by the trapezoidal rule: the ends count by half.
    const Lane share = ((place_ == first) | (place_ == last)) ? all(0.5) : all(1);
    for (std::size_t s = 0; s < car_.struts(); ++s)
      tally_.add_strut(s, car_.deflection(x, s), share * steps_.force(s) * car_.deflection(v, s),
                       car_.currents(state_, s).coil, counts);

    LaneMask lost{};
    Lane loads[Car::kMostTyres];
    for (std::size_t w = 0; w < car_.tyres(); ++w) {
      // Less push reaches a wheel that has lifted; rounding alone would be left of its load.
      const Lane road = road_[w].node[0], at_wheel = car_.push_at_wheel(x, road, w);
      loads[w] = at_wheel != road ? Lane{} : car_.load_on_road(x, at_wheel, w);
      lost |= loads[w] <= 0;
      tally_.add_tyre(w, loads[w], car_.tyre(w).static_load, car_.wheel(x, w) - height_[w], counts);
    }
    tally_.add_lost_contact(lost, counts);
    if (ride_.trace) trace(loads, which);
  }
  /// trace_rows() of these lanes' sample.
  void trace(const Lane* loads, LaneMask which) {
    const std::size_t n = car_.coordinates();
    const Lane *x = state_.x, *v = x + n;
    Lane rows[trace_rows(Car::kMostCoordinates, Car::kMostStruts, Car::kMostTyres)];
    Lane* row = rows;
    for (std::size_t k = 0; k < n; ++k) {
      *row++ = x[k];
      *row++ = v[k];
      *row++ = steps_.acceleration()[k];
    }
    for (std::size_t s = 0; s < car_.struts(); ++s) {
      *row++ = car_.deflection(x, s);
      *row++ = car_.deflection(v, s);
      *row++ = steps_.force(s);
      *row++ = car_.currents(state_, s).coil;
    }
    for (std::size_t w = 0; w < car_.tyres(); ++w) {
      *row++ = height_[w];
      *row++ = loads[w];
    }

    const auto count = static_cast<std::size_t>(row - rows);
    for (std::size_t lane = 0; lane < kWidth; ++lane)
      for (std::size_t k = 0; which[lane] && k < count; ++k)
        ride_.trace[(static_cast<std::size_t>(place_[lane]) * count + k) * kWidth + lane] =
            rows[k][lane];
  }

  /// Those of these lanes in which something is no longer finite. They stand still from there on.
  LaneMask lost(LaneMask arrived) {
    const LaneMask gone = arrived & !(fabs(car_.sum_of(state_.x)) < 1e100);
    lost_at_ = gone ? __builtin_convertvector(place_, Lane) : lost_at_;
    return gone;
  }

  const LaneRide& ride_;
  Car car_;
  Steps steps_;
  Tally<Car::kMostStruts, Car::kMostTyres> tally_;
  typename Car::State state_;
  Lane command_[Car::kMostStruts]{};  ///< A
  Lane height_[Car::kMostTyres]{};    ///< m, of the road at the sample
  RoadPush road_[Car::kMostTyres];
  LaneMask place_{};      ///< the sample that each lane is in
  bool together_ = true;  ///< all in the same one
  Lane lost_at_{};        ///< the sample at which a lane diverged; 0: it did not

  // The road at nodes, which are half a sample apart: kLaneAhead samples from the last one on whose
  // number is a multiple of that. Tyre by tyre.
  alignas(64) double heights_[Car::kMostTyres * kLaneNodes * kWidth];  ///< m
  alignas(64) double rates_[Car::kMostTyres * kLaneNodes * kWidth];    ///< m/s
};

}  // namespace
}  // namespace dashpot
