#pragma once
#include "dashpot/suspension/lanes/simd/quarter_car.h"

namespace dashpot {
namespace {

/// What is kept of a ride while it goes on.
class Tally {
 public:
  explicit Tally(const LaneRide& ride) : ride_(ride) {}

  struct Sample {
    Lane acceleration, load, load_at_rest, tyre_deflection, deflection, speed, force, current;
  };
  void add(const Sample& s, LaneMask alive, bool counts) {
    const Lane weighted = weigh(alive ? s.acceleration : Lane{});
    if (!counts) return;
    const auto put = [&](LaneResult row, Lane value) { sums_[row] += alive ? value : Lane{}; };
    const Lane more = s.load - s.load_at_rest;
    put(kAcceleration2, s.acceleration * s.acceleration);
    put(kWeighted2, weighted * weighted);
    put(kWeighted4, weighted * weighted * weighted * weighted);
    put(kLoad2, more * more);
    put(kTyreDeflection2, s.tyre_deflection * s.tyre_deflection);
    put(kDeflection2, s.deflection * s.deflection);
    put(kContactLost, s.load <= 0 ? all(1) : Lane{});
    put(kPower, s.force * s.speed);
    put(kCurrentSum, s.current);
    sums_[kGreatestDeflection] =
        alive ? fmax(fabs(s.deflection), sums_[kGreatestDeflection]) : sums_[kGreatestDeflection];
  }
  Lane& row(LaneResult row) { return sums_[row]; }
  void store_all() const {
    for (std::size_t k = 0; k < kLaneResults; ++k) store(ride_.results + k * kWidth, sums_[k]);
  }

 private:
  Lane weigh(Lane in) {
    const double* b = ride_.weighting;
    for (Lane(&s)[2] : memory_) {
      const Lane out = b[0] * in + s[0];
      s[0] = b[1] * in - b[3] * out + s[1];
      s[1] = b[2] * in - b[4] * out;
      in = out;
      b += 5;
    }
    return in;
  }

  const LaneRide& ride_;
  Lane sums_[kLaneResults]{};
  Lane memory_[kWeightingSections][2]{};
};

/// From rest, sample by sample.
template <class Damper, class Steps>
class LaneRun {
 public:
  explicit LaneRun(const LaneRide& ride) : ride_(ride), car_(ride), steps_(ride, car_), tally_(ride) {
    command_ = load(ride.start);
    state_.currents = {load(ride.start + kWidth), load(ride.start + 2 * kWidth)};
    for (std::size_t k = 0; k < Damper::kStates; ++k) state_.z[k] = load(ride.start + (3 + k) * kWidth);
    car_.damper.set_current(car_.driving(state_.currents));
  }

  void run() {
    for (std::size_t k = 0;; ++k) {
      meet_ground(k);
      if (k == 0) steps_.refresh(state_, command_, all(0) == 0, road_.node[0]);
      if (ride_.control) control();
      sample(k);
      if (k == ride_.samples) break;
      steps_.advance(state_, command_, road_);
      check(k + 1);
    }
    tally_.row(kMissed) = steps_.missed ? all(1) : Lane{};
    tally_.row(kEvaluations) = steps_.steps;
    tally_.store_all();
  }

 private:
  static constexpr std::size_t kAhead = 64;  // samples of road at once

  void meet_ground(std::size_t k) {
    const std::size_t place = k % kAhead;
    if (place == 0) ride_.ground(ride_.pilot, 2 * k, 2 * kAhead + 1, heights_, rates_);
    Lane height[3], rate[3];
    for (std::size_t node = 0; node < 3; ++node) {
      const std::size_t at = (2 * place + node) * kWidth;
      height[node] = load(heights_ + at);
      rate[node] = load(rates_ + at);
      road_.node[node] = car_.push(height[node], rate[node]);
    }
    road_.twist =
        car_.numbers.tyre_stiffness * (ride_.sample_time * (rate[0] + rate[2]) - 2 * (height[2] - height[0]));
    height_ = height[0];
  }
  void control() {
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
                  reinterpret_cast<double*>(&command_));
    state_.currents.coil = car_.numbers.driver_lag > 0 ? state_.currents.coil : command_;
    const LaneMask changed = command_ != before;
    if (!any(changed)) return;
    car_.damper.set_current(car_.driving(state_.currents));
    steps_.refresh(state_, command_, changed, road_.node[0]);
  }

  void sample(std::size_t k) {
    const Lane* x = state_.x;
    const Lane load_here = car_.tyre_load(x, car_.push_on_wheel(x, road_.node[0]));
    tally_.add({steps_.acceleration(0), load_here, car_.numbers.static_load, x[1] - height_, x[0] - x[1],
                x[2] - x[3], steps_.force(), state_.currents.coil},
               alive_, k >= ride_.discarded);
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
    for (std::size_t row = 0; row < kLaneTraces; ++row)
      store(ride_.trace + (k * kLaneTraces + row) * kWidth, rows[row]);
  }

  /// A lane that is no longer finite stands still from there on.
  void check(std::size_t k) {
    const Lane sum = (state_.x[0] + state_.x[1]) + (state_.x[2] + state_.x[3]);
    const LaneMask lost = alive_ & !(fabs(sum) < 1e100);
    if (!any(lost)) return;
    tally_.row(kDivergedAt) = lost ? all(static_cast<double>(k)) : tally_.row(kDivergedAt);
    alive_ = alive_ & ~lost;
  }

  const LaneRide& ride_;
  QuarterCarLanes<Damper> car_;
  Steps steps_;
  Tally tally_;
  Moving<Damper::kStates> state_;
  Lane command_{}, height_{};
  RoadPush road_;
  LaneMask alive_ = all(0) == 0;
  alignas(64) double heights_[(2 * kAhead + 1) * kWidth];
  alignas(64) double rates_[(2 * kAhead + 1) * kWidth];
};

}  // namespace
}  // namespace dashpot
