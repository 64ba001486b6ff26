#include <algorithm>
#include <cmath>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/observe.h"
#include "dashpot/machine/virtual_campaign.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Two masses that do not touch, each on a spring and a damper, with this as what drives them.
std::string halves(const std::string& voltage) {
  return "plant: matrices\ncoordinates: [a, b]\n"
         "mass: [[100 kg, 0], [0, 150 kg]]\nstiffness: [[20 N/mm, 0], [0, 30 N/mm]]\n"
         "dampers: [{name: left, from: ground, to: a}, {name: right, from: ground, to: b}]\n"
         "inputs:\n  - {channel: push_a, kind: force, at: a}\n"
         "  - {channel: push_b, kind: force, at: b}\n"
         "sensors:\n  - {channel: x_a, quantity: displacement, at: a, noise: 0.1 mm}\n"
         "  - {channel: x_b, quantity: displacement, at: b, noise: 0.2 mm}\n"
         "  - {channel: acc_b, quantity: acceleration, at: b, noise: 0.1}\n" +
         (voltage.empty() ? "" : "voltage: " + voltage + "\n");
}

/// The right one of them alone.
const std::string kRight =
    "plant: matrices\ncoordinates: [b]\nmass: [[150 kg]]\nstiffness: [[30 N/mm]]\n"
    "dampers: [{name: right, from: ground, to: b}]\n"
    "inputs: [{channel: push_b, kind: force, at: b}]\n"
    "sensors: [{channel: x_b, quantity: displacement, at: b, noise: 0.2 mm},"
    " {channel: acc_b, quantity: acceleration, at: b, noise: 0.1}]\nvoltage: coil_b\n";

/// A ride of both with spencer1997 in each, whose voltages are switched each by itself.
PlantRecording switched_ride(double seconds) {
  const InPlantSetup setup =
      parse_in_plant_setup(halves("{left: coil_a, right: coil_b}"), "halves.yaml");
  const std::vector<VirtualRide> rides = virtual_campaign(
      setup, load_parameters("spencer1997"),
      {.duration = seconds, .levels = {0, 1, 2}, .hold = 0.25, .road = "", .push = 1000});
  const Record& recorded = rides.front().recorded;
  return {.name = "ride",
          .sample_time = recorded.sample_time,
          .samples = recorded.size(),
          .channels = recorded.channels};
}

InPlantSetup with_voltage(const std::string& voltage) {
  return parse_in_plant_setup(halves(voltage), "halves.yaml");
}

std::string refusal(const std::string& voltage) {
  return message_of([&] { with_voltage(voltage); });
}

}  // namespace

TEST_CASE("own drives: a channel or a level for each damper, by its strut or its kind") {
  const InPlantSetup own = with_voltage("{right: 1.5 V, left: coil_a}");
  CHECK(own.drive_of(0).channel == "coil_a");
  CHECK(own.drive_of(1).channel.empty());
  CHECK(own.drive_of(1).level == 1.5);
  CHECK(own.drive_channels() == std::vector<std::string>{"coil_a"});
  const std::string written = format_json(to_json(own));
  CHECK(format_json(to_json(parse_in_plant_setup(written, "again"))) == written);

  // In words, and by kinds.
  const std::string half =
      "half_car,mass=690kg,inertia=1222,front_wheel_mass=40kg,rear_wheel_mass=45kg,"
      "front_stiffness=17N/mm,rear_stiffness=22N/mm,front_tyre_stiffness=200N/mm,"
      "rear_tyre_stiffness=200N/mm,front_distance=1.3m,rear_distance=1.5m,ground=rf@front,"
      "ground=rr@rear,deflection=level@front,";
  const InPlantSetup words = read_in_plant_setup(half + "current=0.5A@rear,current=coil@front");
  CHECK(words.drive_of(0).channel == "coil");
  CHECK(words.drive_of(1).level == 0.5);
  CHECK(contains(message_of([&] { read_in_plant_setup(half + "current=a,current=b"); }),
                 "the dampers are driven already"));
  const std::string kinds = "damper_kinds: {firm: [left], soft: [right]}\n";
  CHECK(parse_in_plant_setup(halves("{firm: coil, soft: 1 V}") + kinds, "halves.yaml")
            .drive_of(0)
            .channel == "coil");
}

TEST_CASE("own drives: what is missing or twice is named") {
  CHECK(contains(refusal("{left: coil_a}"),
                 "nothing is said of the damper in right; a channel or a level for each"));
  CHECK(contains(refusal("{left: coil_a, rigth: coil_b}"),
                 "'rigth' is neither a strut nor a kind of damper; did you mean 'right'"));
  CHECK(contains(refusal("{left: 1 A, right: coil_b}"), "'1 A' is a level in A, not in V"));
}

TEST_CASE("own drives: a virtual ride switches each channel by itself, and levels stay") {
  const PlantRecording ride = switched_ride(3);
  const std::vector<double>&a = ride.channel("coil_a").samples, &b = ride.channel("coil_b").samples;
  double differs = 0;
  for (std::size_t k = 0; k < ride.samples; ++k) differs += a[k] != b[k];
  CHECK(differs > 0.4 * static_cast<double>(ride.samples));
  CHECK(differs < static_cast<double>(ride.samples));

  // A ride per level: the second channel is one level ahead, and what has no channel stays.
  const std::vector<VirtualRide> rides =
      virtual_campaign(with_voltage("{left: coil_a, right: coil_b}"),
                       load_parameters("spencer1997"), {.duration = 1, .levels = {0, 1, 2}});
  for (std::size_t r = 0; r < 3; ++r) {
    CHECK(rides[r].recorded.channel("coil_a").samples[7] == static_cast<double>(r));
    CHECK(rides[r].recorded.channel("coil_b").samples[7] == static_cast<double>((r + 1) % 3));
  }
}

TEST_CASE("own drives: what is observed of one damper is what it is alone under its own drive" *
          doctest::test_suite("long")) {
  const PlantRecording ride = switched_ride(2);
  const ObservedDamper spencer{std::make_shared<LawModel>(load_parameters("spencer1997")),
                               {-0.03, 0.03, -0.5, 0.5, 0, 2}};
  ObserveOptions options;
  options.force = {{28, 0.005}, {20, 0.3}};
  options.steps = 2;
  const auto right_force = [&](const InPlantSetup& setup) {
    const ObserveReport report =
        observe(ObservedDampers(setup.dampers(), spencer), setup, {ride}, options);
    return report.recordings[0].quantities[setup.dampers() - 1];
  };
  const ObservedQuantity alone = right_force(parse_in_plant_setup(kRight, "right.yaml")),
                         own = right_force(with_voltage("{left: coil_a, right: coil_b}")),
                         other = right_force(with_voltage("coil_a"));
  double furthest = 0;
  for (std::size_t k = 0; k < alone.value.size(); ++k) {
    CHECK_CLOSE(own.value[k], alone.value[k], 1e-8, 1e-5);
    CHECK_CLOSE(own.half[k], alone.half[k], 1e-6, 1e-5);
    furthest = std::max(furthest, std::abs(other.value[k] - alone.value[k]));
  }
  CHECK(furthest > 50);
}

TEST_CASE("own drives: a fit knows which current drove which damper" *
          doctest::test_suite("long")) {
  const PlantRecording ride = switched_ride(4);
  const auto left_at_sensors = [&](const std::string& voltage, const std::string& kinds) {
    const InPlantSetup setup =
        parse_in_plant_setup(halves(voltage) + "damper_kinds: " + kinds + "\n", "halves.yaml");
    const InPlantReport report =
        identify_in_plant(find_law("tanh_kwok"), setup, {ride}, {.starts = 2, .grade = ""});
    REQUIRE(report.has_models());
    double worst = 0;
    for (const SensorFigures& figure : report.sensors)
      worst = std::max(worst, figure.held_back / figure.rms);
    return worst;
  };
  const double own = left_at_sensors("{left: coil_a, right: coil_b}", "alike"),
               apart = left_at_sensors("{left: coil_a, right: coil_b}", "apart"),
               one = left_at_sensors("coil_a", "apart");
  MESSAGE("left at the worst sensor: " << 100 * own << " % under own drives, " << 100 * apart
                                       << " % apart, " << 100 * one << " % under one");
  CHECK(own < 0.1);
  CHECK(apart < 1.2 * own);
  CHECK(one > 3 * own);
}
