#pragma once
#include "dashpot/suspension/lanes/simd/controls.h"
#include "dashpot/suspension/lanes/simd/quarter_car.h"
#include "dashpot/suspension/lanes/simd/tally.h"

namespace dashpot {
namespace {

/// From rest, sample by sample. Each lane goes on as soon as it has reached the end of a sample:
/// none waits for another that takes more steps. `Steps` is AdaptiveSteps or TaylorSteps.
template <class Damper, class Steps>
class LaneRun {
 public:
  explicit LaneRun(const LaneRide& ride)
      : ride_(ride), car_(ride), steps_(ride, car_), tally_(ride, car_.numbers.tyre.static_load) {
    // LaneRide::start: the command, the two currents, then the damper's states.
    command_ = load(ride.start);
    state_.currents = {load(ride.start + kWidth), load(ride.start + 2 * kWidth)};
    for (std::size_t k = 0; k < Damper::kStates; ++k)
      state_.z[k] = load(ride.start + (3 + k) * kWidth);
    car_.damper.set_current(car_.driving(state_.currents));
  }

  void run() {
    // All lanes at their first sample.
    LaneMask riding = all(0) == 0;
    steps_.begin(state_);
    meet_ground(riding);
    steps_.refresh(state_, command_, riding, road_.node[0]);
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
    tally_.store_all();
  }

 private:
  /// At a sample the controller acts first, and what is recorded shows the forces after that.
  void take_sample(LaneMask which) {
    if (ride_.control_numbers)
      follow(demanded(which));
    else if (ride_.control)
      follow(asked(which));
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
    Lane height[3], rate[3];
    for (std::size_t node = 0; node < 3; ++node) {
      height[node] = at_node(heights_, node);
      rate[node] = at_node(rates_, node);
      road_.node[node] = road_push(car_.numbers.tyre, height[node], rate[node]);
    }
    road_.twist = car_.numbers.tyre.stiffness *
                  (ride_.sample_time * (rate[0] + rate[2]) - 2 * (height[2] - height[0]));
    height_ = height[0];
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
  Lane demanded(LaneMask which) const {
    const Lane* x = state_.x;
    const auto number = [&](LaneControlNumber row) {
      return load(ride_.control_numbers + row * kWidth);
    };
    const Lane demand = lane_controls::demand_of(ride_.control_law, number(kControlParameter),
                                                 {number(kSoftCurrent), number(kHardCurrent)},
                                                 {x[2], steps_.acceleration(0), x[3], x[2] - x[3]});
    return which ? demand : command_;
  }

  /// Commands of the controllers of these lanes, one by one.
  Lane asked(LaneMask which) {
    const Lane* x = state_.x;
    Lane signals[kLaneSignals];
    signals[kBodyVelocity] = x[2];
    signals[kBodyAcceleration] = steps_.acceleration(0);
    signals[kWheelVelocity] = x[3];
    signals[kDeflection] = x[0] - x[1];
    signals[kDeflectionVelocity] = x[2] - x[3];
    signals[kForce] = steps_.force();
    signals[kCurrent] = state_.currents.coil;
    signals[kBody] = x[0];
    signals[kWheel] = x[1];
    signals[kGround] = height_;

    Lane commands = command_;
    ride_.control(ride_.pilot, reinterpret_cast<const double*>(signals),
                  reinterpret_cast<double*>(&commands),
                  reinterpret_cast<const std::int64_t*>(&which));
    return commands;
  }

  void follow(Lane commands) {
    const LaneMask changed = commands != command_;
    if (!any(changed)) return;
    command_ = commands;

    // A coil without a lag follows at once, and forces are others from here on.
    state_.currents.coil =
        (changed & !(car_.numbers.driver_lag > 0)) ? command_ : state_.currents.coil;
    car_.damper.set_current(car_.driving(state_.currents));
    steps_.refresh(state_, command_, changed, road_.node[0]);
  }

  /// Adds these lanes' sample to the measures and, where wanted, to the trace.
  void record(LaneMask which) {
    const Lane* x = state_.x;
    const Lane load_here = car_.load_on_road(x, car_.push_at_wheel(x, road_.node[0]));
    tally_.add({steps_.acceleration(0), load_here, x[1] - height_, x[0] - x[1], x[2] - x[3],
                steps_.force(), state_.currents.coil},
               which, place_ >= static_cast<std::int64_t>(ride_.discarded));
    if (!ride_.trace) return;

    Lane rows[kLaneTraces];
    rows[kTraceBody] = x[0];
    rows[kTraceBodyVelocity] = x[2];
    rows[kTraceBodyAcceleration] = steps_.acceleration(0);
    rows[kTraceWheel] = x[1];
    rows[kTraceWheelVelocity] = x[3];
    rows[kTraceWheelAcceleration] = steps_.acceleration(1);
    rows[kTraceDeflection] = x[0] - x[1];
    rows[kTraceDeflectionVelocity] = x[2] - x[3];
    rows[kTraceForce] = steps_.force();
    rows[kTraceCurrent] = state_.currents.coil;
    rows[kTraceRoad] = height_;
    rows[kTraceLoad] = load_here;
    for (std::size_t lane = 0; lane < kWidth; ++lane)
      for (std::size_t row = 0; which[lane] && row < kLaneTraces; ++row)
        ride_.trace[(static_cast<std::size_t>(place_[lane]) * kLaneTraces + row) * kWidth + lane] =
            rows[row][lane];
  }

  /// Those of these lanes in which something is no longer finite. They stand still from there on.
  LaneMask lost(LaneMask arrived) {
    const Lane sum = (state_.x[0] + state_.x[1]) + (state_.x[2] + state_.x[3]);
    const LaneMask gone = arrived & !(fabs(sum) < 1e100);
    lost_at_ = gone ? __builtin_convertvector(place_, Lane) : lost_at_;
    return gone;
  }

  const LaneRide& ride_;
  QuarterCarLanes<Damper> car_;
  Steps steps_;
  Tally tally_;
  Moving<Damper::kStates> state_;
  Lane command_{};  ///< A
  Lane height_{};   ///< m, of the road at the sample
  RoadPush road_;
  LaneMask place_{};      ///< the sample that each lane is in
  bool together_ = true;  ///< all in the same one
  Lane lost_at_{};        ///< the sample at which a lane diverged; 0: it did not

  // The road at nodes, which are half a sample apart: kLaneAhead samples from the last one on whose
  // number is a multiple of that.
  alignas(64) double heights_[kLaneNodes * kWidth];  ///< m
  alignas(64) double rates_[kLaneNodes * kWidth];    ///< m/s
};

}  // namespace
}  // namespace dashpot
