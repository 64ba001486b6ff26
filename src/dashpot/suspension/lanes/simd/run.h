#pragma once
#include "dashpot/suspension/lanes/simd/quarter_car.h"
#include "dashpot/suspension/lanes/simd/tally.h"

namespace dashpot {
namespace {

/// From rest, sample by sample. Each lane goes on as soon as it has reached the end of a sample:
/// none waits for another that takes more steps.
template <class Damper, class Steps>
class LaneRun {
 public:
  explicit LaneRun(const LaneRide& ride)
      : ride_(ride), car_(ride), steps_(ride, car_), tally_(ride, car_.numbers.tyre.static_load) {
    command_ = load(ride.start);
    state_.currents = {load(ride.start + kWidth), load(ride.start + 2 * kWidth)};
    for (std::size_t k = 0; k < Damper::kStates; ++k)
      state_.z[k] = load(ride.start + (3 + k) * kWidth);
    car_.damper.set_current(car_.driving(state_.currents));
  }

  void run() {
    LaneMask riding = all(0) == 0;
    meet_ground(riding);
    steps_.refresh(state_, command_, riding, road_.node[0]);
    take_sample(riding);
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
  void take_sample(LaneMask which) {
    if (ride_.control) control(which);
    record(which);
  }

  /// Those that have come to a sample.
  void meet_ground(LaneMask which) {
    const LaneMask ends = which & ((place_ & (kLaneAhead - 1)) == 0);
    if (any(ends))
      for (std::size_t lane = 0; lane < kWidth; ++lane)
        if (ends[lane])
          ride_.ground(ride_.pilot, lane, 2 * static_cast<std::size_t>(place_[lane]), heights_,
                       rates_);
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
  Lane at_node(const double* of, std::size_t node) const {
    const auto row = [&](std::int64_t place) {
      return of + (2 * (static_cast<std::size_t>(place) % kLaneAhead) + node) * kWidth;
    };
    if (together_) return load(row(place_[0]));
    Lane lanes;
    for (std::size_t lane = 0; lane < kWidth; ++lane) lanes[lane] = row(place_[lane])[lane];
    return lanes;
  }

  void control(LaneMask which) {
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
    const Lane before = command_;
    ride_.control(ride_.pilot, reinterpret_cast<const double*>(signals),
                  reinterpret_cast<double*>(&command_),
                  reinterpret_cast<const std::int64_t*>(&which));
    const LaneMask changed = command_ != before;
    if (!any(changed)) return;
    state_.currents.coil =
        changed & !(car_.numbers.driver_lag > 0) ? command_ : state_.currents.coil;
    car_.damper.set_current(car_.driving(state_.currents));
    steps_.refresh(state_, command_, changed, road_.node[0]);
  }

  void record(LaneMask which) {
    const Lane* x = state_.x;
    const Lane load_here = car_.load_on_road(x, car_.push_at_wheel(x, road_.node[0]));
    tally_.add({steps_.acceleration(0), load_here, x[1] - height_, x[0] - x[1], x[2] - x[3],
                steps_.force(), state_.currents.coil},
               which, place_ >= static_cast<std::int64_t>(ride_.discarded));
    if (!ride_.trace) return;
    const Lane rows[kLaneTraces] = {x[0],
                                    x[2],
                                    steps_.acceleration(0),
                                    x[1],
                                    x[3],
                                    steps_.acceleration(1),
                                    x[0] - x[1],
                                    x[2] - x[3],
                                    steps_.force(),
                                    state_.currents.coil,
                                    height_,
                                    load_here};
    for (std::size_t lane = 0; lane < kWidth; ++lane)
      for (std::size_t row = 0; which[lane] && row < kLaneTraces; ++row)
        ride_.trace[(static_cast<std::size_t>(place_[lane]) * kLaneTraces + row) * kWidth + lane] =
            rows[row][lane];
  }

  /// Those of which something is no longer finite. They stand still from there on.
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
  Lane command_{}, height_{};
  RoadPush road_;
  LaneMask place_{};      ///< the sample in which each lane is
  bool together_ = true;  ///< in the same one
  Lane lost_at_{};        ///< sample; 0: not
  // at the nodes, half a sample apart, from the last sample on whose number is a multiple of
  // kLaneAhead
  alignas(64) double heights_[kLaneNodes * kWidth];
  alignas(64) double rates_[kLaneNodes * kWidth];
};

}  // namespace
}  // namespace dashpot
