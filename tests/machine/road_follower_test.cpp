// A rear axle that meets the road of the front one, later, and a road that no channel shows there.

#include "dashpot/machine/road_follower.h"

#include <algorithm>
#include <cmath>

#include "dashpot/damper/law_list.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/road_delay.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/machine/virtual_recording.h"
#include "dashpot/simulate.h"
#include "dashpot/vehicle.h"
#include "support.h"

using namespace dashpot;

namespace {

const std::string kFollowed =
    "plant: half_car\n"
    "parameters: {mass: {about: 600 kg, from: 400 kg, to: 1000 kg}, inertia: 1222 kg*m^2,\n"
    "  front_wheel_mass: 40 kg, rear_wheel_mass: 45 kg, front_stiffness: 17 N/mm,\n"
    "  rear_stiffness: 22 N/mm, front_tyre_stiffness: 200 N/mm,\n"
    "  rear_tyre_stiffness: {about: 150 N/mm}, front_distance: 1.3 m, rear_distance: 1.5 m}\n"
    "inputs:\n"
    "  - {channel: front_tyre_road, kind: ground, at: front}\n"
    "  - {kind: ground, at: rear, follows: front_tyre_road, delay: 0.14 s}\n"
    "sensors:\n"
    "  - {channel: body_acceleration, quantity: acceleration, at: body}\n"
    "  - {channel: front_wheel_acceleration, quantity: acceleration, at: front_wheel}\n"
    "  - {channel: rear_wheel_acceleration, quantity: acceleration, at: rear_wheel}\n"
    "voltage: front_current\n";

/// kFollowed with one text in place of another.
std::string followed_with(const std::string& old, const std::string& other) {
  std::string text = kFollowed;
  REQUIRE(contains(text, old));
  return text.replace(text.find(old), old.size(), other);
}

/// A ride of the half car as the suspension's own integrator has it: 2.8 m at 20 m/s, 0.14 s.
PlantRecording simulated_ride(double seconds, double road_noise) {
  VehicleWords words;
  words.plant = "half_car";
  words.dampers = {"spencer1997"};
  words.current = 1.0;
  const Vehicle car = make_vehicle(words);
  SimulateOptions options = car.options(seconds);
  options.output_step = 0.002;
  const GroundPointer road = make_ground("iso8608,class=C,speed=20m/s", 3);
  return virtual_recording(simulate(car.on(*road), options).record,
                           {{"front_tyre_road", road_noise},
                            {"rear_tyre_road", road_noise},
                            {"body_acceleration", 0.05},
                            {"front_wheel_acceleration", 0.5},
                            {"rear_wheel_acceleration", 0.5},
                            {"front_current", 0}},
                           3);
}

}  // namespace

TEST_CASE("a road that follows: the channel that it makes is what the rear tyre met") {
  const InPlantSetup setup = parse_in_plant_setup(kFollowed, "half.yaml");
  CHECK(setup.inputs[1].later == 0.14);
  CHECK(setup.inputs[1].place.tyre == 1);
  const std::vector<std::string> channels = setup.channels();
  CHECK(std::ranges::count(channels, setup.inputs[1].channel) == 0);

  const PlantRecording as_recorded = simulated_ride(1, 0),
                       made = with_followers(setup, {as_recorded}).front();
  const std::vector<double>& met = as_recorded.channel("rear_tyre_road").samples;
  const std::vector<double>& follows = made.channel("front_tyre_road at rear").samples;
  const std::size_t before = met.size() - follows.size();
  CHECK(before == 70 + 24);
  REQUIRE(made.samples == follows.size());
  for (std::size_t k = 0; k < follows.size(); ++k)
    CHECK_CLOSE(follows[k], met[before + k], 0, 1e-7);
  CHECK(contains(message_of([&] { with_followers(setup, {simulated_ride(0.15, 0)}); }),
                 "is over before the rear has met the road"));

  // Nothing is touched where nothing follows, and wheelbase and speed say the same.
  CHECK(parse_in_plant_setup(followed_with("delay: 0.14 s", "wheelbase: 2.8 m, speed: 72 km/h"),
                             "half.yaml")
            .inputs[1]
            .later == doctest::Approx(0.14));
  CHECK(contains(message_of([&] {
                   parse_in_plant_setup(
                       followed_with("{channel: front_tyre_road, kind: ground, at: front}",
                                     "{kind: ground, at: front, class: C, speed: 20 m/s}"),
                       "half.yaml");
                 }),
                 "which is no channel of a road; class and speed here too"));
  const std::string written = format_json(to_json(setup));
  CHECK(contains(written, "\"follows\": \"front_tyre_road\""));
  CHECK(format_json(to_json(parse_in_plant_setup(written, "again.json"))) == written);
}

TEST_CASE("a road that follows: a half car is found of whose rear wheel no road is measured" *
          doctest::test_suite("long")) {
  const std::vector<PlantRecording> recordings = {simulated_ride(3, 2e-4)};
  const auto found = [&](const std::string& text) {
    return identify_in_plant(find_law("tanh_kwok"), parse_in_plant_setup(text, "half.yaml"),
                             recordings, {.starts = 1, .iterations = 12, .grade = ""});
  };
  const InPlantReport report = found(kFollowed);
  REQUIRE(report.has_models());
  CHECK_CLOSE(report.plant[0].value, 690, 0.04, 0);
  CHECK_CLOSE(report.plant[1].value, 2e5, 0.04, 0);

  // One sensor of a road has one noise.
  const auto noise =
      std::ranges::find(report.nuisances, "noise of front_tyre_road", &FittedParameter::name);
  REQUIRE(noise != report.nuisances.end());
  CHECK_CLOSE(noise->value, 2e-4, 0.2, 0);
  CHECK(std::ranges::count(report.nuisances, "noise of front_tyre_road at rear",
                           &FittedParameter::name) == 0);

  // A rear axle that is thought to be 20 ms late shows it.
  const InPlantReport late = found(followed_with("delay: 0.14 s", "delay: 0.16 s"));
  CHECK(late.sensors[2].training > 3 * report.sensors[2].training);
}

TEST_CASE("a road that follows: a speed that is known to some percents is found" *
          doctest::test_suite("long")) {
  const InPlantSetup setup = parse_in_plant_setup(
      followed_with("delay: 0.14 s", "wheelbase: 2.8 m, speed: {about: 20.8 m/s}"), "half.yaml");
  CHECK(setup.inputs[1].later == doctest::Approx(0.1346).epsilon(1e-3));
  const InPlantSetup found =
      with_found_road_delay(find_law("tanh_kwok"), setup, {simulated_ride(2, 2e-4)}, {.grade = ""});
  CHECK_CLOSE(found.inputs[1].later, 0.14, 0, 2e-4);
  CHECK_FALSE(looks_for_road_delay(found));
  CHECK(contains(format_json(to_json(setup)), "\"about\": 0.13461"));
}

TEST_CASE("a road that follows: a virtual ride has it so, and does not record it") {
  InPlantSetup setup = parse_in_plant_setup(followed_with("delay: 0.14 s", "delay: 50 ms"), "a");
  for (const PlantUnknown& unknown : setup.unknown)
    setup.known.emplace_back(unknown.name, *unknown.about);
  setup.unknown.clear();
  const VirtualRide ride = virtual_campaign(with_grade(setup, find_sensor_grade("car", "test")),
                                            load_parameters("spencer1997"),
                                            {.duration = 1,
                                             .sample_rate = 500,
                                             .levels = {1},
                                             .road = "iso8608,class=C,speed=20m/s",
                                             .seed = 7})
                               .front();
  const std::vector<double>& front = ride.truth.channel("front_tyre_road").samples;
  const std::vector<double>& rear = ride.truth.channel("rear_tyre_road").samples;
  for (std::size_t k = 25; k < front.size(); ++k) CHECK_CLOSE(rear[k], front[k - 25], 0, 1e-9);
  CHECK(std::ranges::count(ride.recorded.channels, "front_tyre_road at rear", &Channel::name) == 0);
}

TEST_CASE("a road that follows: what is wrong is named with what would be right") {
  const auto wrong = [](const std::string& old, const std::string& other) {
    return message_of([&] { parse_in_plant_setup(followed_with(old, other), "half.yaml"); });
  };
  CHECK(contains(wrong("follows: front_tyre_road", "follows: road"),
                 "follows 'road', which is no channel of a road"));
  CHECK(contains(
      wrong(", delay: 0.14 s", ""),
      "does not say how much later it meets the road; delay: 0.14 s, or wheelbase: 2.8 m"));
  CHECK(contains(wrong("delay: 0.14 s", "delay: 0.14 s, speed: 20 m/s"), "does not say how much"));
  CHECK(contains(wrong("delay: 0.14 s", "delay: unknown"),
                 "is unknown, and nothing says where it is expected; {about: ...}"));
  CHECK(contains(wrong("delay: 0.14 s", "delay: -1 s"), "follows by no time"));
  CHECK(contains(wrong("delay: 0.14 s", "wheelbase: 2.8 m, speed: 0"), "follows by no time"));
  CHECK(contains(wrong("delay: 0.14 s", "delay: 0.14 s, noise: 1 mm"), "noise"));
  CHECK(contains(wrong("{kind: ground, at: rear,", "{kind: ground, channel: w, at: rear,"),
                 "has a channel and follows another one"));
  CHECK(contains(wrong("{kind: ground, at: rear,", "{kind: force, at: body,"),
                 "only a road does, under a plant that meets it at several places"));
  CHECK(contains(wrong("voltage:", "start: rest\nvoltage:"),
                 "so that the plant moved before the recording began"));

  // Who knows none.
  InPlantSetup setup = parse_in_plant_setup(kFollowed, "half.yaml");
  CHECK(contains(message_of([&] { require_one_damper(setup, "the observer"); }), "2 dampers"));
}
