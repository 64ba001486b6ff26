#include "dashpot/machine/evaluate_in_plant.h"

#include <cmath>
#include <numbers>

#include "dashpot/damper/law_list.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant_result.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/recording_parts.h"
#include "dashpot/machine/virtual_campaign.h"
#include "support.h"

using namespace dashpot;

namespace {

const std::string kJudgedMass =
    "plant: oscillator\n"
    "parameters: {mass: 100 kg, stiffness: 30 N/mm, damping: 0 N*s/m}\n"
    "inputs: [{channel: push, kind: force}]\n"
    "sensors:\n"
    "  - {channel: x, quantity: displacement, noise: 0.05 mm}\n"
    "  - {channel: a, quantity: acceleration, noise: 0.05, delay: 3 ms}\n"
    "voltage: 0.5 V\n";

const std::string kJudgedFloors =
    "plant: matrices\n"
    "coordinates: [floor, table]\n"
    "mass: [[100 kg, 0], [0, 60 kg]]\n"
    "stiffness: [[60 kN/m, -20 kN/m], [-20 kN/m, 20 kN/m]]\n"
    "dampers: [{name: low, from: ground, to: floor}, {name: high, from: floor, to: table}]\n"
    "inputs: [{channel: push, kind: force, at: floor}]\n"
    "sensors:\n"
    "  - {channel: low, quantity: deflection, at: low, noise: 0.05 mm}\n"
    "  - {channel: high, quantity: deflection, at: high, noise: 0.05 mm}\n"
    "voltage: 0.2 V\n";

InPlantSetup judged_setup(const std::string& text) { return parse_in_plant_setup(text, "rig"); }

PlantRecording as_recording(const VirtualRide& ride) {
  return {.name = "ride",
          .sample_time = ride.recorded.sample_time,
          .samples = ride.recorded.size(),
          .channels = ride.recorded.channels};
}

/// A law without memory, another one than any truth here.
LawModel judged_law(double viscous) {
  const Law& law = find_law("tanh_guo");
  std::vector<double> p;
  for (const ParamInfo& param : law.params) p.push_back(param.value);
  p[law.index_of("f0")] = 0;
  p[law.index_of("A2")] = viscous;
  return LawModel::constant(law, p);
}

ObservedDamper as_damper(const LawModel& law) {
  return {std::make_shared<LawModel>(law), {-0.5, 0.5, -10, 10, 0, 2}};
}

double error_of(const PlantEvaluation& told, std::size_t sensor = 0) {
  return told.sensors[sensor].training;
}

}  // namespace

TEST_CASE("evaluate in a plant: the truth leaves the sensors' noise, wherever it begins") {
  const InPlantSetup setup = judged_setup(kJudgedMass);
  const LawModel truth = load_parameters("spencer1997");
  const VirtualRide ride =
      virtual_campaign(setup, truth, {.duration = 6, .levels = {0.5}, .push = 500}).front();
  const PlantRecording whole = as_recording(ride);
  const ObservedDamper damper = as_damper(truth);

  // A recording whose plant moves at its beginning, which nobody tells.
  const PlantRecording later = part_of(whole, 1100, whole.samples);
  const PlantEvaluation told = evaluate_in_plant({damper}, setup, {whole, later}, {});
  REQUIRE(told.sensors.size() == 4);
  for (const SensorFigures& sensor : told.sensors) {
    CHECK(sensor.training ==
          doctest::Approx(5e-5 * (sensor.channel == "x" ? 1 : 1000)).epsilon(0.1));
    CHECK(std::isnan(sensor.held_back));
  }
  CHECK(told.step_error < 0.05);
  CHECK(told.warnings.empty());

  // From rest it is not there at the second one's beginning.
  InPlantSetup from_rest = setup;
  from_rest.from_rest = true;
  const PlantEvaluation late = evaluate_in_plant({damper}, from_rest, {whole, later}, {});
  CHECK(error_of(late, 0) == doctest::Approx(5e-5).epsilon(0.1));
  CHECK(error_of(late, 2) > 1.5 * error_of(told, 2));

  // The force that no sensor shows, as a table.
  const Record run = run_of(told.traces.front(), setup);
  const std::vector<double>&force = run.channel("damper_force").samples,
        &truly = ride.truth.channel("damper_force").samples;
  double squares = 0, power = 0;
  for (std::size_t k = 0; k < force.size(); ++k) {
    squares += std::pow(force[k] - truly[k], 2);
    power += truly[k] * truly[k];
  }
  CHECK(squares < 1e-4 * power);
  CHECK(run.channel("x_modelled").samples.size() == whole.samples);
}

TEST_CASE("evaluate in a plant: a sensor that counts the other way round is told") {
  const InPlantSetup setup = judged_setup(kJudgedMass);
  const LawModel truth = load_parameters("spencer1997");
  PlantRecording ride = as_recording(
      virtual_campaign(setup, truth, {.duration = 4, .levels = {0.5}, .push = 500}).front());
  for (Channel& channel : ride.channels)
    if (channel.name == "x")
      for (double& sample : channel.samples) sample = -sample;
  const PlantEvaluation told = evaluate_in_plant({as_damper(truth)}, setup, {ride}, {});
  REQUIRE(!told.warnings.empty());
  CHECK(contains(told.warnings.front(), "x: shows -1 times what the model does"));

  // A column that is another signal is told as such: no factor makes it this one.
  for (Channel& channel : ride.channels)
    if (channel.name == "x")
      for (std::size_t k = 0; k < channel.samples.size(); ++k)
        channel.samples[k] = 1e-5 * std::sin(2 * std::numbers::pi * 0.031 * static_cast<double>(k));
  const std::vector<std::string> other =
      evaluate_in_plant({as_damper(truth)}, setup, {ride}, {}).warnings;
  REQUIRE(!other.empty());
  CHECK(contains(other.front(), "x: the model is "));
  CHECK(contains(other.front(), "further than from no motion at all"));

  // What is too short to be judged was never to be fitted.
  CHECK(contains(
      message_of([&] { evaluate_in_plant({as_damper(truth)}, setup, {part_of(ride, 0, 50)}, {}); }),
      "has 50 samples; at least 200"));
}

TEST_CASE("evaluate in a plant: another mass, another law and a narrow range are told") {
  InPlantSetup setup = judged_setup(kJudgedMass);
  const LawModel truth = load_parameters("spencer1997");
  const PlantRecording ride = as_recording(
      virtual_campaign(setup, truth, {.duration = 4, .levels = {0.5}, .push = 500}).front());
  const double best = error_of(evaluate_in_plant({as_damper(truth)}, setup, {ride}, {}));
  CHECK(error_of(evaluate_in_plant({as_damper(judged_law(900))}, setup, {ride}, {})) > 2 * best);

  ObservedDamper narrow = as_damper(truth);
  narrow.domain.velocity_max = 1e-3;
  narrow.domain.velocity_min = -1e-3;
  const PlantEvaluation beyond = evaluate_in_plant({narrow}, setup, {ride}, {});
  REQUIRE(beyond.warnings.size() == 1);
  CHECK(beyond.warnings.front().find("outside the model's range") != std::string::npos);

  setup.known.front().second = 130;
  REQUIRE(setup.known.front().first == "mass");
  CHECK(error_of(evaluate_in_plant({as_damper(truth)}, setup, {ride}, {})) > 2 * best);
}

TEST_CASE("evaluate in a plant: each of two dampers by its own model") {
  const InPlantSetup setup = judged_setup(kJudgedFloors);
  const LawModel firm = judged_law(3000), soft = judged_law(300);
  const std::vector<const DamperModel*> struts = {&firm, &soft};
  const PlantRecording ride = as_recording(
      virtual_campaign(setup, struts, {.duration = 4, .levels = {0.2}, .push = 500}).front());
  const auto error = [&](const LawModel& low, const LawModel& high) {
    const PlantEvaluation told =
        evaluate_in_plant({as_damper(low), as_damper(high)}, setup, {ride}, {});
    return std::max(error_of(told, 0), error_of(told, 1));
  };
  CHECK(error(firm, soft) == doctest::Approx(5e-5).epsilon(0.1));
  CHECK(error(soft, firm) > 1e-4);
}

TEST_CASE("evaluate in a plant: what diverges is told, what cannot run free is refused") {
  InPlantSetup setup = judged_setup(kJudgedMass);
  const LawModel truth = load_parameters("spencer1997");
  const PlantRecording ride = as_recording(
      virtual_campaign(setup, truth, {.duration = 2, .levels = {0.5}, .push = 500}).front());
  const auto message = [&](const InPlantSetup& with) {
    return message_of([&] { evaluate_in_plant({as_damper(truth)}, with, {ride}, {}); });
  };

  const PlantEvaluation told = evaluate_in_plant({as_damper(judged_law(-1e6))}, setup, {ride}, {});
  CHECK(std::isinf(error_of(told)));
  CHECK(told.warnings.front().find("the plant diverges") != std::string::npos);

  InPlantSetup unknown = setup;
  std::erase_if(unknown.known, [](const auto& one) { return one.first == "mass"; });
  unknown.unknown = {{"mass", 1, 1000, {}}};
  CHECK(message(unknown).find("plant, mass: is unknown") != std::string::npos);
  InPlantSetup late = setup;
  late.sensors.front().finds_delay = true;
  CHECK(message(late).find("its delay is unknown") != std::string::npos);
  InPlantSetup road = judged_setup(
      "plant: quarter_car\n"
      "parameters: {sprung_mass: 387 kg, unsprung_mass: 40 kg, spring_stiffness: 20 N/mm, "
      "tyre_stiffness: 200 N/mm}\n"
      "inputs: [{kind: ground, class: C, speed: 20 m/s}]\n"
      "sensors: [{channel: x, quantity: deflection}, {channel: a, quantity: acceleration, at: "
      "body}]\n"
      "voltage: 0.5 V\n");
  CHECK(message(road).find("nothing measures it") != std::string::npos);
}
