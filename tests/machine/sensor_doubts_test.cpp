#include "dashpot/machine/sensor_doubts.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/machine/disagreeing_sensors.h"
#include "dashpot/machine/in_plant_words.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A motion of several frequencies, at a time in s.
double motion(double t) {
  return std::sin(9 * t) + 0.7 * std::sin(23 * t + 1) + 0.5 * std::sin(61 * t + 2);
}

/// What is said of a sensor that shows this of the motion at each time, in two recordings of two
/// rates, where the model is right but for noise of this size.
std::string doubts_about(const std::function<double(double)>& shown, double noise = 0.02) {
  InPlantSetup setup;
  setup.sensors = {{.channel = "level"}, {.channel = "az"}};
  std::vector<SensorFigures> figures;
  std::vector<InPlantTrace> traces;
  Random random(3);
  for (const double rate : {500.0, 400.0}) {
    InPlantTrace trace{.recording = "ride_" + std::to_string(traces.size() + 1),
                       .sample_time = 1 / rate,
                       .training = 4000};
    trace.measured.resize(2);
    trace.modelled.resize(2);
    double error = 0, power = 0;
    for (int k = 0; k < 5000; ++k) {
      const double t = k / rate, seen = shown(t) + noise * random.normal();
      trace.measured[0].push_back(seen);
      trace.modelled[0].push_back(motion(t));
      trace.measured[1].push_back(motion(t) + noise * random.normal());
      trace.modelled[1].push_back(motion(t));
      error += std::pow(seen - motion(t), 2) / 5000;
      power += std::pow(seen, 2) / 5000;
    }
    figures.push_back({.recording = trace.recording,
                       .channel = "level",
                       .rms = std::sqrt(power),
                       .training = std::sqrt(error)});
    figures.push_back({.recording = trace.recording, .channel = "az", .rms = 1, .training = noise});
    traces.push_back(std::move(trace));
  }
  return join(sensor_doubts(setup, figures, traces), " | ");
}

}  // namespace

TEST_CASE("sensor_doubts: one flaw of a sensor in all recordings is named with its size") {
  CHECK(doubts_about(motion).empty());
  CHECK(contains(doubts_about([](double t) { return 1000 * motion(t); }),
                 "level: shows 1000 times what the model does"));
  CHECK(contains(doubts_about([](double t) { return -motion(t); }),
                 "does it count the other way round?"));
  CHECK(contains(doubts_about([](double t) { return motion(t - 0.0137); }),
                 "level: comes 13.7 ms later than the model has it"));
  CHECK(contains(doubts_about([](double t) { return motion(t + 0.01); }),
                 "level: comes 10 ms earlier than the model has it"));
  CHECK(contains(doubts_about([](double t) { return motion(t) + 0.3 * t; }), "level: drifts, by"));
  CHECK(contains(doubts_about([](double t) { return std::clamp(motion(t), -1.0, 1.2); }, 0),
                 "samples stand at its greatest or least value"));
  CHECK(contains(
      doubts_about([](double t) { return motion(t) + (std::fmod(t, 1) < 0.003 ? 90 : 0); }),
      "level: has most of its error in 80 samples"));
  CHECK_FALSE(contains(doubts_about([](double t) { return -motion(t); }), "az"));
}

TEST_CASE("sensors that disagree whatever the damper is are named with how many times they count") {
  // Body and wheel of a quarter car, and the deflection between them, by motions that need no road.
  const auto told = [](double body, double wheel, double level, bool has_wheel = true) {
    InPlantSetup setup = parse_in_plant_setup(
        "plant: quarter_car\n"
        "parameters: {sprung_mass: unknown, unsprung_mass: 40 kg, spring_stiffness: 20 N/mm, "
        "tyre_stiffness: unknown}\n"
        "inputs: [{channel: road, kind: ground}]\n"
        "sensors: [{channel: az_body, quantity: acceleration, at: body}, {channel: az_wheel, "
        "quantity: acceleration, at: wheel}, {channel: level, quantity: deflection}]\n",
        "car.yaml");
    if (!has_wheel) setup.sensors[1].place.quantity = PlantQuantity::Velocity;
    Random random(5);
    InPlantTrace trace{.recording = "ride", .sample_time = 0.002, .training = 4000};
    trace.measured.resize(3);
    for (int k = 0; k < 5000; ++k) {
      const double t = 0.002 * k;
      const auto moves = [&](double amplitude, double rate, double phase) {
        return amplitude * std::sin(rate * t + phase);
      };
      const auto bends = [&](double amplitude, double rate, double phase) {
        return -rate * rate * moves(amplitude, rate, phase);
      };
      trace.measured[0].push_back(body * (bends(0.02, 8, 0) + bends(0.002, 31, 1)) +
                                  0.05 * random.normal());
      trace.measured[1].push_back(wheel * (bends(0.01, 8, 0.4) + bends(0.003, 61, 2)) +
                                  0.05 * random.normal());
      trace.measured[2].push_back(level * (moves(0.02, 8, 0) + moves(0.002, 31, 1) -
                                           moves(0.01, 8, 0.4) - moves(0.003, 61, 2) + 0.3) +
                                  level * 1e-4 * random.normal());
    }
    return join(disagreeing_sensors(setup, {trace}), " | ");
  };
  CHECK(told(1, 1, 1) == "");
  CHECK(told(1.3, 0.8, 1) == "");
  CHECK(contains(told(-1, 1, 1), "az_body: shows -"));
  CHECK(contains(told(-1, 1, 1), "what level and az_wheel make of it"));
  CHECK(contains(told(1, -1, 1), "az_wheel: shows -"));
  CHECK(contains(told(1, 1, -1), "level: shows -"));
  CHECK(contains(told(1, 1, 1000),
                 "times what az_body and az_wheel make of it, whatever the damper "
                 "is: is its unit right?"));
  CHECK(contains(told(1, 1 / 9.80665, 1), "az_wheel: shows 0.1"));
  CHECK(told(1, -1, 1, false) == "");
  CHECK(told(0, -1, 1) == "");
}

TEST_CASE("noise_doubts: a sensor that nearly all is taken for noise of, and no other") {
  InPlantSetup setup;
  setup.sensors = {{.channel = "level"}, {.channel = "az", .noise = 0.1}};
  InPlantReport report;
  for (const double rms : {0.01, 0.02}) {
    report.sensors.push_back({.recording = "ride", .channel = "level", .rms = rms});
    report.sensors.push_back({.recording = "ride", .channel = "az", .rms = 100 * rms});
  }
  report.nuisances = {{.name = "noise of level", .unit = "m", .value = 0.0002}};
  CHECK(noise_doubts(setup, report).empty());
  report.nuisances.front().value = 0.01;
  REQUIRE(noise_doubts(setup, report).size() == 1);
  CHECK(contains(noise_doubts(setup, report).front(),
                 "level: its noise was found to be 0.01 m, 63.2 % of what it shows"));
}

TEST_CASE("sensor_doubts: what no flaw explains is no flaw; a model that meets nothing is told") {
  CHECK(doubts_about([](double t) { return motion(t) + 0.2 * std::sin(37 * t); }).empty());
  CHECK(contains(doubts_about([](double t) { return std::sin(37 * t); }),
                 "ride_1, level: the model is"));
  CHECK(contains(doubts_about(motion, 0.6), "the sensor that is met best, is"));
}
