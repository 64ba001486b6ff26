#include "dashpot/machine/found_noise.h"

#include <cmath>

#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant_words.h"
#include "support.h"

using namespace dashpot;

namespace {

const std::string kQuietCar =
    "plant: quarter_car\n"
    "parameters: {sprung_mass: 387 kg, unsprung_mass: 139.5 kg, spring_stiffness: 37300 N/m, "
    "tyre_stiffness: 295200 N/m}\n"
    "inputs: [{channel: road, kind: ground}]\n"
    "sensors:\n"
    "  - {channel: az, quantity: acceleration, at: body}\n"
    "  - {channel: level, quantity: deflection}\n"
    "voltage: 1 V\n";

/// What a fit left: smooth errors of a model under white noise of this deviation at `az`, and at
/// `level` a spectrum that falls all along, in which no noise can be seen.
InPlantReport left_over(double noise) {
  InPlantReport report;
  report.kinds = {{"", {0}, std::make_shared<LawModel>(load_parameters("spencer1997")), {}}};
  InPlantTrace trace{.recording = "ride", .sample_time = 0.002, .training = 4000};
  trace.measured.assign(2, {});
  trace.modelled.assign(2, std::vector<double>(4000));
  Random random(7);
  double wandering = 0, rate = 0;
  for (int k = 0; k < 4000; ++k) {
    trace.measured[0].push_back(0.3 * std::sin(0.05 * k) + noise * random.normal());
    rate = 0.9 * rate + 1e-4 * random.normal();
    wandering = 0.9 * wandering + rate;
    trace.measured[1].push_back(wandering);
  }
  report.traces = {trace};
  for (const char* channel : {"az", "level"})
    report.sensors.push_back({.recording = "ride", .channel = channel, .offset = 0.1});
  return report;
}

}  // namespace

TEST_CASE("found_noise: the white part of what a fit leaves, and nothing where there is none") {
  const InPlantSetup setup = parse_in_plant_setup(kQuietCar, "car.yaml");
  const std::vector<FoundNoise> found = found_noise(setup, left_over(0.05));
  REQUIRE(found.size() == 2);
  CHECK(found[0].channel == "az");
  CHECK(found[0].unit == "m/s^2");
  CHECK_CLOSE(found[0].deviation, 0.05, 0.03, 0);
  CHECK(found[0].zero == 0.2);
  CHECK(found[1].channel == "level");
  CHECK(found[1].deviation == 0);
  CHECK(found_noise(setup, left_over(0)).front().deviation == 0);
  CHECK(found_noise(setup, {}).empty());
}

TEST_CASE("found_noise: as the nuisances of a fit tell it, where their interval is narrow") {
  InPlantSetup setup = parse_in_plant_setup(kQuietCar, "car.yaml");
  InPlantReport report = left_over(0.05);
  report.nuisances = {{.name = "noise of az",
                       .unit = "m/s^2",
                       .meaning = {},
                       .value = 0.04,
                       .low = 0.03,
                       .high = 0.05},
                      {.name = "noise of level",
                       .unit = "m",
                       .meaning = {},
                       .value = 1e-4,
                       .low = 1e-6,
                       .high = 1e-2},
                      {.name = "noise of road",
                       .unit = "m",
                       .meaning = {},
                       .value = 2e-4,
                       .low = 1.9e-4,
                       .high = 2.1e-4}};
  const std::vector<FoundNoise> found = found_noise(setup, report);
  REQUIRE(found.size() == 3);
  CHECK(found[0].deviation == 0.04);
  CHECK(found[1].deviation == 0);
  CHECK(found[2].channel == "road");
  CHECK(found[2].deviation == 2e-4);

  // A noise that is stated is not looked for.
  setup.sensors[0].noise = 0.05;
  CHECK(found_noise(setup, report).front().channel == "level");
}

TEST_CASE("an observer's noise: stated, else of the plant's file, else of the model's") {
  InPlantReport report = left_over(0.05);
  InPlantSetup setup = parse_in_plant_setup(kQuietCar, "car.yaml");
  report.noise = {{"az", "m/s^2", 0.05, 0.2}, {"level", "m", 0, 0}, {"road", "m", 2e-4, 0}};

  // The plant as it was found keeps it apart from what is stated, with its unit, and so does its
  // file.
  const std::string file = format_json(to_json(as_found(setup, report)));
  CHECK(contains(file, "\"noise_found\": \"0.05 m/s^2\""));
  CHECK(contains(file, "\"zero_found\": \"0.2 m/s^2\""));
  CHECK_FALSE(contains(file, "\"noise\""));
  const InPlantSetup found = parse_in_plant_setup(file, "plants/a.json");
  CHECK(found.sensors[0].noise == 0);
  CHECK(found.sensors[0].identified.deviation == 0.05);
  CHECK(found.sensors[1].identified.deviation == 0);
  CHECK(format_json(to_json(found)) == file);

  // So are the numbers that were found, with their intervals.
  report.plant = {{.name = "tyre_stiffness",
                   .unit = "N/m",
                   .meaning = {},
                   .value = 2e5,
                   .low = 1.9e5,
                   .high = 2.2e5}};
  InPlantSetup open = setup;
  open.known.pop_back();
  const std::string numbers = format_json(to_json(as_found(open, report)));
  const InPlantSetup again = parse_in_plant_setup(numbers, "plants/a.json");
  REQUIRE(again.found.size() == 1);
  CHECK(again.found[0].name == "tyre_stiffness");
  CHECK(again.found[0].high == 2.2e5);
  CHECK(format_json(to_json(again)) == numbers);
  std::string wrong = numbers;
  wrong.replace(wrong.find("\"low\""), 5, "\"high\"");
  wrong.replace(wrong.rfind("\"high\""), 6, "\"low\"");
  CHECK(contains(message_of([&] { parse_in_plant_setup(wrong, "plants/a.json"); }),
                 "lies outside its own interval; low, found and high in that order"));

  // An observer takes it, and the model's for what that file says nothing of; units must agree.
  ModelFile model = to_model_file(load_parameter_set("spencer1997"));
  model.noise_found = {{"az", "m/s^2", 0.07, 0.3}, {"level", "m", 1e-4, 2e-4}, {"road", "N", 3, 0}};
  const InPlantSetup taken = with_identified_noise(found, model, "m.json");
  CHECK(taken.sensors[0].noise == 0.05);
  CHECK(taken.sensors[0].zero == 0.2);
  CHECK(taken.sensors[1].noise == 1e-4);
  CHECK(taken.inputs[0].noise == 2e-4);
  const std::string words =
      "Noise not stated, as 'identify --in' found it (the plant's file, m.json): az 0.05 m/s^2, ";
  CHECK(identified_noise_words(taken, {}) == words + "level 0.1 mm, road 0.2 mm.");
  CHECK(identified_noise_words(taken, PrintUnits::si()) ==
        words + "level 0.0001 m, road 0.0002 m.");
  CHECK_FALSE(contains(format_json(to_json(taken)), "\"noise\""));
  CHECK(with_identified_noise(setup, model, "m.json").inputs[0].noise == 0);

  // What is stated wins, and nothing is to be said.
  for (PlantSensor& sensor : setup.sensors) sensor.noise = 0.01;
  const InPlantSetup stated = with_identified_noise(setup, model, "m.json");
  CHECK(stated.sensors[0].noise == 0.01);
  CHECK(stated.sensors[0].zero == 0);
  CHECK(identified_noise_words(stated, {}).empty());
}

TEST_CASE("noise_alone: sensors of a plant that hardly moves, and no motion however quick") {
  const InPlantSetup setup = parse_in_plant_setup(kQuietCar, "car.yaml");
  PlantRecording ride{.name = "ride", .sample_time = 0.002, .samples = 4000};
  for (const char* name : {"road", "az", "level"}) ride.channels.push_back({.name = name});
  Random random(7);
  for (int k = 0; k < 4000; ++k) {
    ride.channels[0].samples.push_back(0);
    ride.channels[1].samples.push_back(0.3 * std::sin(1.5 * k) + 0.05 * random.normal());
    ride.channels[2].samples.push_back(5e-5 * std::sin(0.05 * k) + 5e-4 * random.normal());
  }
  CHECK(noise_alone(setup, {ride}) == std::vector<std::string>{"level"});
}
