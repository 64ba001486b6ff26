#include "dashpot/record/joint_velocity.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "dashpot/base/random.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// A motion, and what two sensors make of it.
struct TwoSensors {
  std::vector<double> x, v, truth;
  double dt = 0;
};

struct Sensors {
  double displacement_noise = 10e-6, velocity_noise = 3e-3;  // m, m/s
  double gain = 1, delay = 0;  // of the velocity; s, of the displacement
  double filter_hz = 0;        // of the displacement, first order
  double resolution = 0;       // m
};

/// Sines from 0.4 to 12 Hz for 20 s.
TwoSensors recorded(const Sensors& sensors, double rate, std::uint64_t seed = 1) {
  constexpr double kFrequencies[] = {0.4, 1.1, 2.3, 4.7, 12},
                   kPeaks[] = {0.05, 0.06, 0.05, 0.04, 0.03};
  Random random(seed);
  TwoSensors out;
  out.dt = 1 / rate;
  for (int k = 0; k < 20 * rate; ++k) {
    double x = 0, v = 0;
    for (int n = 0; n < 5; ++n) {
      const double w = kTurn * kFrequencies[n], t = k * out.dt, late = w * (t - sensors.delay) + n;
      const double slow = sensors.filter_hz > 0 ? kFrequencies[n] / sensors.filter_hz : 0;
      v += kPeaks[n] * std::cos(w * t + n);
      x += kPeaks[n] / w * std::sin(late - std::atan(slow)) / std::sqrt(1 + slow * slow);
    }
    out.truth.push_back(v);
    x += sensors.displacement_noise * random.normal();
    if (sensors.resolution > 0) x = sensors.resolution * std::round(x / sensors.resolution);
    out.x.push_back(x);
    out.v.push_back(sensors.gain * v + sensors.velocity_noise * random.normal());
  }
  return out;
}

double rms_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

TEST_CASE("joint: a noisy velocity has its noise taken off by the displacement") {
  // Whatever the rate, and as well as both together can tell.
  for (const double rate : {60., 100., 500.}) {
    CAPTURE(rate);
    const TwoSensors both = recorded({.velocity_noise = 20e-3}, rate);
    const auto joint = joint_velocity(both.x, both.v, both.dt);
    REQUIRE(joint);
    CHECK_CLOSE(joint->own_noise, 20e-3, 0.15, 0);
    CHECK(rms_difference(joint->velocity, both.truth) < 0.35 * rms_difference(both.v, both.truth));
  }

  // A stroke at rest from sample to sample: a velocity that the displacement tells at once.
  const TwoSensors both = recorded({.displacement_noise = 1e-6, .velocity_noise = 5e-3}, 500);
  const auto joint = joint_velocity(both.x, both.v, both.dt);
  REQUIRE(joint);
  CHECK(rms_difference(joint->velocity, both.truth) < 1e-3);
  CHECK(joint->noise < 1e-3);
}

TEST_CASE("joint: what is no noise of the velocity stays with it") {
  const auto worse_by = [](const Sensors& sensors, double rate) {
    double most = 0;
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      const TwoSensors both = recorded(sensors, rate, seed);
      const auto joint = joint_velocity(both.x, both.v, both.dt);
      const double own = rms_difference(both.v, both.truth);
      most = std::max(most, joint ? rms_difference(joint->velocity, both.truth) / own : 1);
    }
    return most;
  };
  for (const double rate : {60., 100., 500., 2000.}) {
    CAPTURE(rate);
    // A good sensor beside a poor one, a gain, a displacement that is late or filtered, or coarse.
    CHECK(worse_by({.displacement_noise = 200e-6, .velocity_noise = 1e-3}, rate) <= 1);
    CHECK(worse_by({.velocity_noise = 1e-4}, rate) <= 1);
    CHECK(worse_by({.gain = 1.03}, rate) <= 1);
    CHECK(worse_by({.delay = 4e-3}, rate) <= 1);
    CHECK(worse_by({.filter_hz = 20}, rate) <= 1);
    CHECK(worse_by({.filter_hz = 5}, rate) <= 1);
    CHECK(worse_by({.resolution = 40e-6}, rate) <= 1);
  }
}

TEST_CASE("joint: motions with corners, and rough ones, make no velocity worse") {
  for (const double rate : {30., 100., 500., 2000.})
    for (const bool triangle : {true, false}) {
      CAPTURE(rate);
      CAPTURE(triangle);
      Random random(1);
      TwoSensors both;
      both.dt = 1 / rate;
      double x = 0, before = 0;
      for (int k = 0; k < 20 * rate; ++k) {
        // Up and down each second, or the first-order noise of 30 Hz.
        const double keep = std::exp(-kTurn * 30 * both.dt), second = k * both.dt;
        const double v = triangle
                             ? (second - std::floor(second) < 0.5 ? 0.08 : -0.08)
                             : keep * before + 0.1 * std::sqrt(1 - keep * keep) * random.normal();
        x += 0.5 * both.dt * (v + before);
        before = v;
        both.truth.push_back(v);
        both.x.push_back(x + 10e-6 * random.normal());
        both.v.push_back(v + 10e-3 * random.normal());
      }
      const auto joint = joint_velocity(both.x, both.v, both.dt);
      CHECK((!joint ||
             rms_difference(joint->velocity, both.truth) < rms_difference(both.v, both.truth)));
    }
}

TEST_CASE("joint: too few samples, a plant at rest, and sensors that agree are left as they are") {
  const TwoSensors both = recorded({}, 100);
  CHECK(!joint_velocity(std::span(both.x).first(20), std::span(both.v).first(20), both.dt));
  const std::vector<double> rest(200, 0.);
  CHECK(!joint_velocity(rest, rest, 0.01));
  CHECK(!joint_velocity(both.x, both.truth, both.dt));
}
