// Half and full cars: a damper in each strut, alike or of several kinds, and a road under each
// tyre.

#include <algorithm>
#include <cmath>

#include "dashpot/damper/law_list.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/evaluate.h"
#include "dashpot/machine/in_plant.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/model_in_plant.h"
#include "dashpot/machine/observe.h"
#include "dashpot/machine/plant_advice.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/machine/virtual_recording.h"
#include "dashpot/machine/watch.h"
#include "dashpot/machine/worn_damper.h"
#include "dashpot/simulate.h"
#include "dashpot/vehicle.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kRideStep = 0.002;

/// A car with spencer1997 in every strut, or with the model of this file, on a road of class C: as
/// the suspension's own integrator has it, its error controlled.
Record simulated_car(const std::string& plant, double voltage, double seconds,
                     const GroundMotion& road, const ModelFile* damper = nullptr) {
  VehicleWords words;
  words.plant = plant;
  words.dampers = {"spencer1997"};
  words.current = voltage;
  const Vehicle car = damper ? make_vehicle(words, *damper) : make_vehicle(words);
  SimulateOptions options = car.options(seconds);
  options.output_step = kRideStep;
  return simulate(car.on(road), options).record;
}

GroundPointer wide_road(std::uint64_t seed) {
  return make_ground("iso8608,class=C,speed=20m/s,track_width=1.5", seed);
}

/// The road under each tyre of a plant at every instant that a method asks for.
PlantDriving driving_under(const Plant& plant, const GroundMotion& road, double seconds,
                           std::size_t steps, PlantMethod method, double voltage) {
  PlantDriving driving{.sample_time = kRideStep,
                       .samples = static_cast<std::size_t>(std::lround(seconds / kRideStep)) + 1,
                       .steps = steps,
                       .method = method,
                       .value = {},
                       .rate = {},
                       .current = {}};
  driving.current.assign(plant.struts.size(), std::vector<double>(driving.points(), voltage));
  for (const Tyre& tyre : plant.tyres) {
    driving.value.emplace_back();
    driving.rate.emplace_back();
    for (std::size_t k = 0; k < driving.points(); ++k) {
      const double t = kRideStep / static_cast<double>(driving.stride()) * static_cast<double>(k);
      const FootMotion foot = road.foot(t, tyre.track, tyre.behind);
      driving.value.back().push_back(foot.height);
      driving.rate.back().push_back(foot.velocity);
    }
  }
  return driving;
}

std::vector<PlantInputPlace> roads_under(const Plant& plant) {
  std::vector<PlantInputPlace> inputs;
  for (std::size_t w = 0; w < plant.tyres.size(); ++w) inputs.push_back({PlantInput::Ground, 0, w});
  return inputs;
}

/// rms of a - b over that of b.
double share_between(const std::vector<double>& a, const std::vector<double>& b) {
  double change = 0, size = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    change += (a[k] - b[k]) * (a[k] - b[k]);
    size += b[k] * b[k];
  }
  return std::sqrt(change / size);
}

const std::string kHalfCarFile =
    "plant: half_car\n"
    "parameters:\n"
    "  mass: {about: 600 kg, from: 400 kg, to: 1000 kg}\n"
    "  inertia: {about: 1000 kg*m^2, from: 500 kg*m^2, to: 2500 kg*m^2}\n"
    "  front_wheel_mass: 40 kg\n"
    "  rear_wheel_mass: 45 kg\n"
    "  front_stiffness: 17 N/mm\n"
    "  rear_stiffness: 22 N/mm\n"
    "  front_tyre_stiffness: 200 N/mm\n"
    "  rear_tyre_stiffness: {about: 150 N/mm}\n"
    "  front_distance: 1.3 m\n"
    "  rear_distance: 1.5 m\n"
    "inputs:\n"
    "  - {channel: front_tyre_road, kind: ground, at: front}\n"
    "  - {channel: rear_tyre_road, kind: ground, at: rear}\n"
    "sensors:\n"
    "  - {channel: body_acceleration, quantity: acceleration, at: body}\n"
    "  - {channel: pitch_velocity, quantity: velocity, at: pitch, noise: 0.3 deg/s}\n"
    "  - {channel: front_wheel_acceleration, quantity: acceleration, at: front_wheel}\n"
    "  - {channel: rear_deflection, quantity: deflection, at: rear}\n"
    "voltage: front_current\n";

/// kHalfCarFile with one text in place of another.
InPlantSetup half_car(const std::string& old = "", const std::string& other = "") {
  std::string text = kHalfCarFile;
  if (!old.empty()) {
    REQUIRE(contains(text, old));
    text.replace(text.find(old), old.size(), other);
  }
  return parse_in_plant_setup(text, "half.yaml");
}

/// What the sensors of kHalfCarFile show of a simulated ride.
PlantRecording half_car_ride(double voltage, double seconds) {
  return virtual_recording(simulated_car("half_car", voltage, seconds, *wide_road(1)),
                           {{"front_tyre_road", 2e-4},
                            {"rear_tyre_road", 2e-4},
                            {"body_acceleration", 0.05},
                            {"pitch_velocity", 0.005},
                            {"front_wheel_acceleration", 0.5},
                            {"rear_deflection", 2e-4},
                            {"front_current", 0}},
                           3);
}

const FittedParameter& found_of(const std::vector<FittedParameter>& list, const std::string& name) {
  return *std::ranges::find(list, name, &FittedParameter::name);
}

}  // namespace

TEST_CASE("several dampers: half and full cars go as the suspension's own integrator has them") {
  constexpr double kSeconds = 3, kVoltage = 1;
  const GroundPointer road = wide_road(5);
  const auto damper = mounted(std::make_shared<LawModel>(load_parameters("spencer1997")), kVoltage);
  for (const char* name : {"half_car", "full_car"}) {
    CAPTURE(name);
    const Plant plant = make_plant(find_machine(name, "test"), {});
    const Record truth = simulated_car(name, kVoltage, kSeconds, *road);
    const DrivenPlant equations(plant, roads_under(plant));
    REQUIRE(equations.dampers().size() == plant.struts.size());

    // Every coordinate's acceleration, and every damper.
    std::vector<PlantSensorPlace> places;
    std::vector<std::string> channels;
    for (std::size_t q = 0; q < plant.size(); ++q) {
      places.push_back({PlantQuantity::Acceleration, q});
      channels.push_back(plant.coordinates[q].name + "_acceleration");
    }
    for (std::size_t d = 0; d < plant.struts.size(); ++d) {
      places.push_back({PlantQuantity::Deflection, 0, d});
      channels.push_back(plant.struts[d].name + "_deflection");
      places.push_back({PlantQuantity::DamperForce, 0, d});
      channels.push_back(plant.struts[d].name + "_force");
    }
    for (const auto& [method, steps, close] :
         {std::tuple{PlantMethod::RungeKutta, 40, 1e-3}, {PlantMethod::StraightForce, 8, 5e-3}}) {
      CAPTURE(steps);
      const PlantDriving driving =
          driving_under(plant, *road, kSeconds, static_cast<std::size_t>(steps), method, kVoltage);
      const std::vector<const DamperModel*> dampers(plant.struts.size(), damper.get());
      std::vector<double> state = equations.at_rest(dampers, driving);
      std::vector<std::vector<double>> shown;
      REQUIRE(equations.run(dampers, driving, driving.samples, places, state, shown));
      for (std::size_t s = 0; s < places.size(); ++s) {
        CAPTURE(channels[s]);
        CHECK(share_between(shown[s], truth.channel(channels[s]).samples) < close);
      }
    }
  }
}

TEST_CASE("several dampers: a run beside another one that hardly differs is what it is alone") {
  const Plant plant = make_plant(find_machine("half_car", "test"), {});
  const DrivenPlant equations(plant, roads_under(plant));
  const PlantDriving driving =
      driving_under(plant, *wide_road(5), 1, 1, PlantMethod::StraightForce, 1);
  const PlantSensorPlace places[] = {{PlantQuantity::DamperForce, 0, 0},
                                     {PlantQuantity::DamperForce, 0, 1}};
  const auto run = [&](const DamperModel& damper, const RunBeside& beside) {
    const DamperModel* const dampers[] = {&damper, &damper};
    std::vector<double> state = equations.at_rest(dampers, driving);
    std::vector<std::vector<double>> shown;
    REQUIRE(equations.run(dampers, driving, driving.samples, places, state, shown, beside));
    return shown;
  };
  const LawModel damper = load_parameters("spencer1997");
  RunTangent tangent;
  const auto kept = run(damper, {.keep = &tangent});
  CHECK(tangent.size() == 2 * (driving.samples - 1));
  Dependence stronger = damper.parameters();
  for (double& c : stronger.coefficients[damper.law().index_of("alpha")]) c *= 1 + 1e-6;
  const LawModel other(damper.law(), stronger, damper.drive_unit(), damper.lag_rate());
  RunTangent own;
  const auto beside = run(other, {.follow = &tangent}), alone = run(other, {.keep = &own});
  for (std::size_t d = 0; d < 2; ++d) {
    CHECK(share_between(beside[d], alone[d]) < 1e-9);
    CHECK(share_between(beside[d], kept[d]) > 1e-9);
  }
}

TEST_CASE(
    "several dampers: masses, tyre and forces of a half car whose dampers are of another law" *
    doctest::test_suite("long")) {
  std::vector<PlantRecording> recordings;
  for (const double voltage : {0.0, 2.0}) recordings.push_back(half_car_ride(voltage, 4));
  InPlantSetup setup = half_car();
  setup.skip = 0.2;
  const InPlantReport report =
      identify_in_plant(find_law("tanh_kwok"), setup, recordings, {.starts = 2, .grade = ""});
  REQUIRE(report.has_models());
  CHECK(report.kinds.size() == 1);  // they are alike
  CHECK_CLOSE(found_of(report.plant, "mass").value, 690, 0.02, 0);
  CHECK_CLOSE(found_of(report.plant, "inertia").value, 1222, 0.02, 0);
  CHECK_CLOSE(found_of(report.plant, "rear_tyre_stiffness").value, 2e5, 0.02, 0);
  CHECK_CLOSE(found_of(report.nuisances, "noise of front_tyre_road").value, 2e-4, 0.3, 0);
  REQUIRE(report.traces.front().dampers.size() == 2);
  CHECK(report.traces.front().dampers[1].strut == "rear");

  // The forces of both on another road.
  ModelFile file;
  file.model = report.kinds.front().model->with_offset(0);
  file.drive_unit = DriveUnit::Volt;
  file.domain = report.kinds.front().domain;
  const GroundPointer other = wide_road(9);
  for (const double voltage : {0.0, 2.0}) {
    const Record truth = simulated_car("half_car", voltage, 8, *other);
    const Record modelled = simulated_car("half_car", voltage, 8, *other, &file);
    for (const char* force : {"front_force", "rear_force"}) {
      CAPTURE(force);
      CHECK(share_between(modelled.channel(force).samples, truth.channel(force).samples) < 0.1);
    }
  }
}

TEST_CASE("several dampers: one of its own in each strut goes by both methods alike") {
  const Plant plant = make_plant(find_machine("half_car", "test"), {});
  const DrivenPlant equations(plant, roads_under(plant));
  const PlantSensorPlace places[] = {{PlantQuantity::DamperForce, 0, 0},
                                     {PlantQuantity::DamperForce, 0, 1}};
  const LawModel front = load_parameters("spencer1997"), rear = load_parameters("sakai2003");
  REQUIRE(front.state_size() != rear.state_size());
  const DamperModel* const dampers[] = {&front, &rear};
  const auto run = [&](PlantMethod method, std::size_t steps) {
    const PlantDriving driving = driving_under(plant, *wide_road(5), 1, steps, method, 1);
    std::vector<double> state = equations.at_rest(dampers, driving);
    std::vector<std::vector<double>> shown;
    REQUIRE(equations.run(dampers, driving, driving.samples, places, state, shown));
    return shown;
  };
  const auto explicitly = run(PlantMethod::RungeKutta, 40),
             straight = run(PlantMethod::StraightForce, 8);
  for (std::size_t d = 0; d < 2; ++d) CHECK(share_between(straight[d], explicitly[d]) < 5e-3);
}

/// Rides of kHalfCarFile as it is in truth, the damper of the rear strut a third weaker.
std::vector<PlantRecording> rides_with_weak_rear(InPlantSetup setup, double seconds) {
  for (const auto& [name, value] :
       NamedValues{{"mass", 690}, {"inertia", 1222}, {"rear_tyre_stiffness", 2e5}})
    setup.known.emplace_back(name, value);
  setup.unknown.clear();
  for (PlantInputChannel& input : setup.inputs) input.noise = 1e-4;
  const std::vector<double> noise{0.05, 0.005, 0.5, 2e-4};
  for (std::size_t s = 0; s < noise.size(); ++s) setup.sensors[s].noise = noise[s];
  const auto as_new = std::make_shared<LawModel>(load_parameters("spencer1997"));
  const WornDamper weak(mounted(as_new, 0), {{&find_wear("force", "test"), -1.0 / 3}});
  const DamperModel* const dampers[] = {as_new.get(), &weak};
  std::vector<PlantRecording> recordings;
  for (const VirtualRide& ride : virtual_campaign(setup, dampers,
                                                  {.duration = seconds,
                                                   .sample_rate = 500,
                                                   .levels = {0, 2},
                                                   .road = "iso8608,class=C,speed=20m/s"}))
    recordings.push_back({.name = ride.recorded.name,
                          .sample_time = ride.recorded.sample_time,
                          .samples = ride.recorded.size(),
                          .channels = ride.recorded.channels});
  return recordings;
}

TEST_CASE("several dampers: kinds that nobody stated are told apart" *
          doctest::test_suite("long")) {
  const auto rides = rides_with_weak_rear(half_car(), 4);
  InPlantOptions options{.starts = 2, .grade = ""};
  options.network.members = 1;
  options.network.epochs = 300;
  std::vector<std::string> stages;
  options.monitor.on_progress = [&](const Progress& progress) { stages.push_back(progress.stage); };
  const std::vector<InPlantFit> fits =
      identify_in_plant(std::vector<std::string>{"tanh_kwok", "tanh_guo", "hysteresis_network"},
                        half_car(), rides, options);
  options.monitor = {};
  const InPlantReport& report = fits[0].report;
  REQUIRE(report.kinds.size() == 2);
  CHECK(report.kinds[0].name == "front");
  CHECK(report.kinds[1].struts == std::vector<std::size_t>{1});
  CHECK(std::ranges::any_of(report.warnings, [](const std::string& warning) {
    return contains(warning, "the dampers are not alike: those of front, rear");
  }));
  CHECK_CLOSE(found_of(report.plant, "mass").value, 690, 0.02, 0);
  CHECK_CLOSE(found_of(report.damper, "rear.alpha_b").value,
              found_of(report.damper, "front.alpha_b").value * 2 / 3, 0.1, 0);

  // The next law begins with them so, and says it too.
  CHECK(std::ranges::count(stages, "tanh_kwok, fit, round 1") == 2);
  CHECK(std::ranges::count(stages, "tanh_guo, fit, round 1") == 1);
  CHECK(fits[1].report.kinds.size() == 2);
  CHECK(std::ranges::count_if(fits[1].report.warnings, [](const std::string& warning) {
          return contains(warning, "the dampers are not alike");
        }) == 1);

  // A bank learns each of them along the better law, in the plant as that has found it.
  const InPlantReport& bank = fits[2].report;
  REQUIRE(bank.kinds.size() == 2);
  CHECK(bank.kinds[1].struts == std::vector<std::size_t>{1});
  CHECK_FALSE(has_interval(found_of(bank.plant, "mass")));
  const auto strength = [&](std::size_t kind) {
    std::vector<DamperInput> motion;
    std::vector<double> time;
    for (const double velocity : {0.2, -0.2})
      for (int k = 0; k < 40; ++k) {
        time.push_back(kRideStep * static_cast<double>(time.size()));
        motion.push_back({velocity * kRideStep * k, velocity, 2});
      }
    const std::vector<double> force = free_run(*bank.kinds[kind].model, motion, time).force;
    return force[39] - force[79];
  };
  CAPTURE(strength(0));
  CHECK_CLOSE(strength(1), strength(0) * 2 / 3, 0.1, 0);

  // The plant as it was found says which is which.
  const InPlantSetup found = as_found(half_car(), report);
  CHECK(found.kinds.names == std::vector<std::string>{"front", "rear"});
  CHECK(dampers_named(found, "rear") == std::vector<std::size_t>{1});

  // Where the file says that they are alike, they stay so, and the mass is what that makes it.
  InPlantSetup alike = half_car();
  alike.kinds.are_stated = true;
  const InPlantReport forced = identify_in_plant(find_law("tanh_kwok"), alike, rides, options);
  REQUIRE(forced.kinds.size() == 1);
  CHECK(std::abs(found_of(forced.plant, "mass").value - 690) > 0.03 * 690);
}

TEST_CASE("several dampers: whether they are alike is asked at the one level of a recording, too") {
  const auto rides = rides_with_weak_rear(half_car(), 1);
  std::vector<std::string> stages;
  InPlantOptions options{.starts = 1, .iterations = 3, .grade = ""};
  options.monitor.on_progress = [&](const Progress& progress) { stages.push_back(progress.stage); };
  identify_in_plant(std::vector<std::string>{"bingham"}, half_car(), rides, options);
  CHECK(std::ranges::count(stages, "bingham, fit, round 1") == 2);
}

TEST_CASE("several dampers: kinds by name, in the file and back") {
  const auto with_kinds = [](const std::string& kinds) {
    return half_car("voltage:", "damper_kinds: " + kinds + "\nvoltage:");
  };
  const InPlantSetup setup = with_kinds("{weak: rear, strong: [front]}");
  CHECK(setup.kinds.names == std::vector<std::string>{"weak", "strong"});
  CHECK(setup.kinds.of == std::vector<std::size_t>{1, 0});
  const InPlantSetup again = parse_in_plant_setup(format_json(to_json(setup)), "again");
  CHECK(again.kinds.names == setup.kinds.names);
  CHECK(again.kinds.of == setup.kinds.of);
  CHECK(dampers_named(setup, "weak") == dampers_named(setup, "rear"));
  CHECK(with_kinds("apart").kinds.names == std::vector<std::string>{"front", "rear"});
  CHECK(with_kinds("alike").kinds.size() == 1);
  CHECK_FALSE(with_unlike_dampers(with_kinds("alike")));
  CHECK(with_unlike_dampers(half_car()));

  // Left and right of an axle are alike.
  const DamperKinds of_car = kinds_by_axle(make_plant(find_machine("full_car", "test"), {}));
  CHECK(of_car.names == std::vector<std::string>{"front", "rear"});
  CHECK(of_car.of == std::vector<std::size_t>{0, 0, 1, 1});

  // What cannot be.
  const auto wrong = [&](const std::string& kinds) {
    return message_of([&] { with_kinds(kinds); });
  };
  CHECK(contains(wrong("other"), "are 'other'; alike, apart, or kinds by name"));
  CHECK(contains(wrong("{a: front}"), "the damper in rear is of no kind"));
  CHECK(contains(wrong("{a: [front, rear], b: rear}"), "the damper in rear is of two kinds"));
  CHECK(contains(wrong("{a: fornt, b: rear}"), "no strut 'fornt'; did you mean 'front'"));
  CHECK(contains(wrong("{a: [front, rear], b: []}"), "'b' is a kind without a damper"));
  CHECK(contains(wrong("{rear: front, front: rear}"),
                 "'front' is a strut and names the kind of another one"));
  CHECK(contains(wrong("{'a/b': front, c: rear}"), "'a/b' is no name for a kind of damper"));
  CHECK(contains(message_of([&] { require_alike(setup, "this"); }),
                 "are 2 (weak, strong), and this knows one"));
}

TEST_CASE("several dampers: a law with a sharp knee, and the same bits on any number of threads" *
          doctest::test_suite("long")) {
  InPlantOptions options{.starts = 2, .iterations = 8, .threads = 1, .grade = ""};
  const std::vector<PlantRecording> recordings = {half_car_ride(1, 2)};
  const InPlantReport one =
      identify_in_plant(find_law("viscous_dahl"), half_car(), recordings, options);
  REQUIRE(one.has_models());
  CHECK(one.method == PlantMethod::StraightForce);
  CHECK(one.sensors[0].training < 0.3 * one.sensors[0].rms);

  // States of its own at each strut begin each recording.
  CHECK(std::ranges::count(one.nuisances, "front_w", &FittedParameter::name) +
            std::ranges::count(one.nuisances, "rear_w", &FittedParameter::name) ==
        2);
  options.threads = 3;
  const InPlantReport three =
      identify_in_plant(find_law("viscous_dahl"), half_car(), recordings, options);
  CHECK(one.sensors[0].held_back == three.sensors[0].held_back);
  CHECK(found_of(one.plant, "mass").value == found_of(three.plant, "mass").value);
}

TEST_CASE("several dampers: a full car's masses from four struts" * doctest::test_suite("long")) {
  const Record truth = simulated_car("full_car", 1, 3, *wide_road(2));
  std::vector<VirtualSensor> sensors;
  std::string text =
      "plant: full_car\nparameters: {mass: {about: 1300 kg}, pitch_inertia: 2160 kg*m^2, "
      "roll_inertia: {about: 600 kg*m^2}, wheel_mass: 59 kg, front_stiffness: 35 kN/m, "
      "rear_stiffness: 38 kN/m, tyre_stiffness: 190 kN/m, front_distance: 1.4 m, rear_distance: "
      "1.7 m, front_track: 1.5 m, rear_track: 1.5 m}\nstart: rest\ninputs:\n";
  for (const char* corner : {"front_left", "front_right", "rear_left", "rear_right"}) {
    const std::string road = std::string(corner) + "_tyre_road";
    text += "  - {channel: " + road + ", kind: ground, at: " + corner + "}\n";
    sensors.push_back({road, 1e-4});
  }
  text += "sensors:\n";
  for (const char* coordinate : {"body", "pitch", "roll"}) {
    const std::string channel = std::string(coordinate) + "_acceleration";
    text += "  - {channel: " + channel + ", quantity: acceleration, at: " + coordinate + "}\n";
    sensors.push_back({channel, 0.05});
  }
  text += "  - {channel: rear_left_force, quantity: damper_force, at: rear_left}\n";
  sensors.push_back({"rear_left_force", 10});
  const auto found = [&](std::size_t steps) {
    return identify_in_plant(find_law("tanh_kwok"), parse_in_plant_setup(text, "full.yaml"),
                             {virtual_recording(truth, sensors, 4)}, {.starts = 1, .steps = steps});
  };
  const InPlantReport report = found(0);
  REQUIRE(report.has_models());
  CHECK_CLOSE(found_of(report.plant, "mass").value, 1500, 0.02, 0);
  CHECK_CLOSE(found_of(report.plant, "roll_inertia").value, 460, 0.02, 0);
  CHECK(report.sensors[0].unit == "m/s^2");
  CHECK(report.sensors[2].unit == "rad/s^2");
  CHECK(report.sensors[3].held_back < 0.1 * report.sensors[3].rms);

  // This law leaps where a damper passes the middle, as each does while the car is at rest. Its
  // numbers have intervals all the same, and a finer step hardly changes them.
  CHECK(report.steps == 2);
  CHECK(report.step_error < 0.01);
  const FittedParameter& mass = found_of(report.plant, "mass");
  CHECK(mass.low < 1500);
  CHECK(mass.high > 1500);
  CHECK(mass.high - mass.low < 0.02 * mass.value);
  CHECK_FALSE(report.advice.sensors.empty());
  const FittedParameter finer = found_of(found(4).plant, "mass");
  CHECK_CLOSE(finer.low, mass.low, 0, 0.2 * (mass.high - mass.low));
  CHECK_CLOSE(finer.high, mass.high, 0, 0.2 * (mass.high - mass.low));
}

TEST_CASE("several dampers: what cannot be is refused, with what would be right") {
  const auto wrong = [](const std::string& old, const std::string& other) {
    return message_of([&] { half_car(old, other); });
  };
  CHECK(contains(wrong("kind: ground, at: front", "kind: ground"),
                 "says not where; at: one of front, rear"));
  CHECK(contains(wrong("kind: ground, at: front", "kind: ground, at: fornt"),
                 "no road under a tyre 'fornt'; did you mean 'front'"));
  CHECK(contains(wrong("quantity: deflection, at: rear", "quantity: deflection"),
                 "says not where; at: one of front, rear"));
  CHECK(contains(wrong("quantity: deflection, at: rear", "quantity: deflection, at: body"),
                 "the plant has no strut 'body'"));
  CHECK(contains(wrong("0.3 deg/s", "0.3 m/s"), "it is counted in rad/s"));

  // A road that is not said, or said twice; what nothing measures.
  const auto required = [](const std::string& old, const std::string& other) {
    return message_of([&] { require_setup(half_car(old, other)); });
  };
  CHECK(required("", "").empty());
  CHECK(contains(required("  - {channel: rear_tyre_road, kind: ground, at: rear}\n", ""),
                 "none says what the road does under the rear_tyre"));
  CHECK(contains(required("kind: ground, at: rear", "kind: ground, at: front"),
                 "two say what the road does under the front_tyre"));
  const std::string measured = "{channel: rear_tyre_road, kind: ground, at: rear}",
                    unmeasured = "{kind: ground, at: rear, class: C, speed: 20 m/s}";
  CHECK(required(measured, unmeasured).empty());
  InPlantSetup both = half_car(measured, unmeasured);
  both.inputs[0].road = RoadPrior{.roughness = 256e-6, .speed = 10};
  CHECK(contains(message_of([&] { require_setup(both); }),
                 "those that nothing measures differ in class or speed"));
  CHECK(contains(wrong(measured, "{kind: ground, at: rear, follows: front, delay: 0.14 s}"),
                 "which is no channel of a road; follows: the channel"));

  // Each damper is watched, but no road that follows another one.
  CHECK(message_of([&] { require_watchable(half_car(), {}); }).empty());
  CHECK(contains(message_of([&] { require_watchable(half_car(measured, unmeasured), {}); }),
                 "has 2 dampers, and 'watch' beside a road that nothing measures knows one"));
  CHECK(contains(message_of([&] {
                   require_watchable(half_car("{channel: rear_tyre_road, kind: ground, at: rear}",
                                              "{kind: ground, at: rear, follows: front_tyre_road, "
                                              "delay: 0.14 s}"),
                                     {});
                 }),
                 "'watch' knows no road that follows another one"));
}

TEST_CASE("several dampers: a setup is the same once it was written") {
  const InPlantSetup setup = half_car();
  const std::string text = format_json(to_json(setup));
  CHECK(contains(text, "\"at\": \"rear\""));
  CHECK(format_json(to_json(parse_in_plant_setup(text, "again"))) == text);
  const InPlantSetup words = read_in_plant_setup(
      "half_car,mass=690,inertia=1222,front_wheel_mass=40,rear_wheel_mass=45,"
      "front_stiffness=17e3,rear_stiffness=22e3,front_tyre_stiffness=2e5,rear_tyre_stiffness=2e5,"
      "front_distance=1.3,rear_distance=1.5,ground=w1@front,ground=w2@rear,deflection=d@rear");
  CHECK(words.inputs[1].place.tyre == 1);
  CHECK(words.sensors[0].place.strut == 1);
}

TEST_CASE("several dampers: a virtual ride goes over one road, the rear behind the front") {
  InPlantSetup setup = half_car();
  for (const PlantUnknown& unknown : setup.unknown)
    setup.known.emplace_back(unknown.name, *unknown.about);
  setup.unknown.clear();
  const VirtualRide ride = virtual_campaign(setup, load_parameters("spencer1997"),
                                            {.duration = 2,
                                             .sample_rate = 500,
                                             .levels = {1},
                                             .road = "iso8608,class=C,speed=20m/s",
                                             .seed = 7})
                               .front();
  CHECK(ride.recorded.channel("pitch_velocity").unit == "rad/s");
  const std::vector<double>& front = ride.truth.channel("front_tyre_road").samples;
  const std::vector<double>& rear = ride.truth.channel("rear_tyre_road").samples;
  constexpr std::size_t kLater = 70;  // 2.8 m at 20 m/s, 500 Hz
  for (std::size_t k = kLater; k < front.size(); ++k)
    CHECK_CLOSE(rear[k], front[k - kLater], 0, 1e-9);
  CHECK(ride.truth.channel("rear_damper_force").samples.size() == front.size());
  CHECK(ride.truth.channel("front_velocity").unit == "m/s");
}
