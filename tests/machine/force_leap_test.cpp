#include "dashpot/machine/force_leap.h"

#include <cmath>
#include <numbers>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/plant_run.h"
#include "dashpot/vehicle.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A tanh_kwok whose force leaps by 2 alpha tanh(delta) where the stroke passes 0.
LawModel leaping(double alpha = 700, double delta = 0.4) {
  return LawModel::constant(find_law("tanh_kwok"), {1500, 3000, alpha, 60, delta, 0});
}

/// Deflection and body acceleration of a quarter car from rest on a road of sines up to 14 Hz of so
/// many metres, by Runge-Kutta in so many steps per sample of 2 ms.
constexpr double kSampleTime = 0.002;
std::vector<std::vector<double>> ride(const DamperModel& damper, double height, std::size_t steps,
                                      double leap_time = kSampleTime) {
  constexpr double kSeconds = 4;
  PlantDriving driving{.sample_time = kSampleTime,
                       .samples = static_cast<std::size_t>(kSeconds / kSampleTime) + 1,
                       .steps = steps,
                       .method = PlantMethod::RungeKutta,
                       .value = {{}},
                       .rate = {{}},
                       .current = {},
                       .leap_time = leap_time};
  driving.current.assign(1, std::vector<double>(driving.points()));
  for (std::size_t k = 0; k < driving.points(); ++k) {
    const double t = kSampleTime / static_cast<double>(driving.stride()) * static_cast<double>(k);
    double value = 0, rate = 0;
    for (int i = 1; i <= 10; ++i) {
      const double turn = 2 * std::numbers::pi * 0.14 * i * i;
      value += height / i * std::sin(turn * t + 1.3 * i * i);
      rate += height / i * turn * std::cos(turn * t + 1.3 * i * i);
    }
    driving.value[0].push_back(value);
    driving.rate[0].push_back(rate);
  }

  const PlantInputPlace ground{PlantInput::Ground, 0};
  const DrivenPlant plant(make_plant(find_machine("quarter_car", "test"), {}), {&ground, 1});
  const PlantSensorPlace sensors[] = {{PlantQuantity::Deflection, 0, 0},
                                      {PlantQuantity::Acceleration, 0}};
  const DamperModel* const dampers[] = {&damper};
  std::vector<double> state = plant.at_rest(dampers, driving);
  std::vector<std::vector<double>> shown;
  REQUIRE(plant.run(dampers, driving, driving.samples, sensors, state, shown));
  return shown;
}

/// rms of a - b over that of b, of sensor s.
double share_apart(const std::vector<double>& a, const std::vector<double>& b) {
  double change = 0, size = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    change += (a[k] - b[k]) * (a[k] - b[k]);
    size += b[k] * b[k];
  }
  return std::sqrt(change / size);
}

/// What the deflection changes by alpha, by a difference of this share of it.
std::vector<double> sensitivity(double share, double leap_time) {
  constexpr double kAlpha = 700, kHeight = 0.005;
  const auto above = ride(leaping(kAlpha * (1 + share)), kHeight, 2, leap_time)[0],
             below = ride(leaping(kAlpha * (1 - share)), kHeight, 2, leap_time)[0];
  std::vector<double> slope;
  for (std::size_t k = 0; k < above.size(); ++k)
    slope.push_back((above[k] - below[k]) / (2 * share * kAlpha));
  return slope;
}

}  // namespace

TEST_CASE("force leap: differences of a run are the same over short lengths and long ones") {
  const std::vector<double> over_long = sensitivity(1e-3, kSampleTime);
  for (const double share : {1e-7, 1e-6, 1e-5, 1e-4}) {
    CAPTURE(share);
    CHECK(share_apart(sensitivity(share, kSampleTime), over_long) < 0.01);
    CHECK(share_apart(sensitivity(share, 0), over_long) > 0.3);  // where it leaps at once
  }
}

TEST_CASE("force leap: a finer step hardly changes a run, where the stroke stays near 0 too") {
  for (const double height : {0.02, 0.005, 0.002}) {
    CAPTURE(height);
    const LawModel damper = leaping();
    const auto coarse = ride(damper, height, 2), fine = ride(damper, height, 16);
    for (const std::size_t sensor : {0, 1}) CHECK(share_apart(coarse[sensor], fine[sensor]) < 1e-3);
  }
}

TEST_CASE(
    "force leap: a line along the stroke, as wide as is asked for, in the place of the leap") {
  constexpr double kTime = 0.001, kSpeed = 0.5, kLeap = 200;
  const LawModel damper = LawModel::constant(find_law("tanh_kwok"), {0, 0, kLeap, 1e-3, 10, 0});
  const ForceLeap leap(damper, 0, 0, kTime, 1e-6);
  const auto force = [&](double x) {
    const DamperInput at{x, kSpeed, 0};
    return damper.force(at, {}) - leap.beyond_line(at, {});
  };
  const double reach = kTime * kSpeed / 2;
  for (const double share : {-2.0, -1.0, -0.5, 0.0, 0.25, 1.0, 3.0}) {
    CAPTURE(share);
    CHECK_CLOSE(force(share * reach), kLeap * std::clamp(share, -1.0, 1.0), 0, 1e-3 * kLeap);
  }
}

TEST_CASE("force leap: of laws that leap alone") {
  const auto of_defaults = [](const char* law) {
    std::vector<double> values;
    for (const ParamInfo& row : find_law(law).params) values.push_back(row.value);
    return LawModel::constant(find_law(law), values);
  };
  CHECK(leaps_at_rest(leaping(), 0, 0));
  CHECK(leaps_at_rest(LawModel::constant(find_law("bingham"), {650, 670, 0, 0}), 0, 0));
  CHECK_FALSE(leaps_at_rest(leaping(700, 0), 0, 0));
  for (const char* law : {"tanh_guo", "bouc_wen", "hysteretic_biviscous", "viscous_dahl"}) {
    CAPTURE(law);
    const LawModel damper = of_defaults(law);
    CHECK_FALSE(leaps_at_rest(damper, 0, 0));
    const ForceLeap none(damper, 0, 0, 0.001, 1);
    std::vector<double> state(damper.state_size());
    for (const double x : {-1e-9, 0.0, 1e-6}) CHECK(none.beyond_line({x, 0.1, 0}, state) == 0);
  }
}
