#include "dashpot/machine/observe.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/mean/mean_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/plant_smoother.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/machine/worn_damper.h"
#include "support.h"

using namespace dashpot;

namespace {

const std::string kObservedCar =
    "plant: quarter_car\n"
    "parameters:\n"
    "  unsprung_mass: 139.5 kg\n"
    "  spring_stiffness: 37300 N/m\n"
    "  sprung_mass: 387 kg\n"
    "  tyre_stiffness: 295200 N/m\n"
    "inputs:\n"
    "  - {kind: ground, class: C, speed: 20 m/s}\n"
    "sensors:\n"
    "  - {channel: az_body, quantity: acceleration, at: body, noise: 0.05}\n"
    "  - {channel: az_wheel, quantity: acceleration, at: wheel, noise: 0.5}\n"
    "  - {channel: level, quantity: deflection, noise: 0.2 mm, delay: 2 ms}\n"
    "voltage: 1 V\n";

const std::string kObservedHalfCar =
    "plant: half_car\n"
    "parameters:\n"
    "  mass: 690 kg\n"
    "  inertia: 1222 kg*m^2\n"
    "  front_wheel_mass: 139.5 kg\n"
    "  rear_wheel_mass: 130 kg\n"
    "  front_stiffness: 37.3 N/mm\n"
    "  rear_stiffness: 40 N/mm\n"
    "  front_tyre_stiffness: 295.2 N/mm\n"
    "  rear_tyre_stiffness: 280 N/mm\n"
    "  front_distance: 1.3 m\n"
    "  rear_distance: 1.5 m\n"
    "inputs:\n"
    "  - {channel: road_front, kind: ground, at: front, noise: 0.2 mm}\n"
    "  - {channel: road_rear, kind: ground, at: rear, noise: 0.2 mm}\n"
    "sensors:\n"
    "  - {channel: az_body, quantity: acceleration, at: body, noise: 0.05}\n"
    "  - {channel: pitch_rate, quantity: velocity, at: pitch, noise: 0.3 deg/s}\n"
    "  - {channel: az_front, quantity: acceleration, at: front_wheel, noise: 0.5}\n"
    "  - {channel: az_rear, quantity: acceleration, at: rear_wheel, noise: 0.5}\n"
    "  - {channel: level_front, quantity: deflection, at: front, noise: 0.2 mm}\n"
    "  - {channel: level_rear, quantity: deflection, at: rear, noise: 0.2 mm}\n"
    "voltage: 1 V\n";

struct ObservedRide {
  InPlantSetup setup;
  Record truth;
  PlantRecording recorded;
};

ObservedRide ride_with(const LawModel& damper, const std::string& file, double seconds,
                       std::uint64_t seed = 3) {
  const InPlantSetup setup = parse_in_plant_setup(file, "car.yaml");
  VirtualCampaignOptions options{.duration = seconds,
                                 .levels = {setup.drives.front().level},
                                 .road = "iso8608,class=C,speed=20m/s",
                                 .seed = seed};
  const std::vector<VirtualRide> rides = virtual_campaign(setup, damper, options);
  return {setup,
          rides.front().truth,
          {.name = "ride",
           .sample_time = rides.front().recorded.sample_time,
           .samples = rides.front().recorded.size(),
           .channels = rides.front().recorded.channels}};
}
ObservedRide spencer_ride(const std::string& file, double seconds, std::uint64_t seed = 3) {
  return ride_with(load_parameters("spencer1997"), file, seconds, seed);
}

/// rms error of a quantity, first the forces of the dampers, over its span, and the share of
/// samples in its band, after 1 s.
std::pair<double, double> judged(const ObserveReport& report, const Record& truth,
                                 std::size_t which = 0) {
  const ObservedQuantity& force = report.recordings.front().quantities[which];
  const std::vector<double>& f = truth.channel(force.name).samples;
  double square = 0, inside = 0, count = 0, low = INFINITY, high = -INFINITY;
  for (std::size_t k = 500; k < f.size(); ++k) {
    square += std::pow(f[k] - force.value[k], 2);
    inside += std::abs(f[k] - force.value[k]) <= force.half[k];
    count += 1;
    low = std::min(low, f[k]);
    high = std::max(high, f[k]);
  }
  return {std::sqrt(square / count) / (high - low), inside / count};
}

const Domain kCarDomain = {-0.04, 0.04, -1, 1, 0, 2};

/// What 'identify --in' finds of spencer1997 at 1 V, which is of another structure: no memory.
std::shared_ptr<const LawModel> tanh_of_spencer(double delta = 0.0244) {
  const Law& law = find_law("tanh_kwok");
  std::vector<double> p(law.params.size());
  for (const auto& [name, value] :
       {std::pair{"c", 2234.0}, {"k", 4174.0}, {"alpha", 500.6}, {"beta", 42.2}, {"delta", delta}})
    p[law.index_of(name)] = value;
  return std::make_shared<LawModel>(LawModel::constant(law, p));
}

}  // namespace

TEST_CASE("observe: the force of a damper of another structure, the road not measured") {
  const ObservedRide ride = spencer_ride(kObservedCar, 4);
  ObserveOptions options;
  options.force = {{28, 0.005}, {20, 0.3}};
  const ObserveReport smoothed =
      observe(tanh_of_spencer(), kCarDomain, ride.setup, {ride.recorded}, options);
  CHECK(smoothed.recordings[0].quantities[0].name == "damper_force");
  CHECK_FALSE(smoothed.noise_was_found);
  const auto [error, inside] = judged(smoothed, ride.truth);
  CHECK(error < 0.01);
  CHECK(inside > 0.75);
  CHECK(inside < 0.99);

  // A damper that its data had moved less is told where it goes beyond them, an unstated range not.
  const auto beyond = [](const ObserveReport& report) {
    return std::ranges::count_if(report.warnings, [](const std::string& warning) {
      return warning.find("outside the model's range") != std::string::npos;
    });
  };
  CHECK(beyond(smoothed) == 0);
  for (const auto& [domain, count] : {std::pair{Domain{-0.04, 0.04, -0.05, 0.05, 0, 2}, 1},
                                      {Domain{0, 0, 0, 0, 0, 2}, 0},
                                      {Domain{-0.04, 0.04, -1, 1, 0, 0.5}, 1}}) {
    const ObserveReport told =
        observe(tanh_of_spencer(), domain, ride.setup, {ride.recorded}, options);
    CHECK(beyond(told) == count);
  }

  // From the past alone it is known less well, and both beat the model by itself by far.
  options.causal = true;
  const auto [causal_error, causal_inside] = judged(
      observe(tanh_of_spencer(), kCarDomain, ride.setup, {ride.recorded}, options), ride.truth);
  CHECK(causal_error > error);
  CHECK(causal_error < 0.02);
  CHECK(causal_inside > 0.6);
}

TEST_CASE("observe: an accelerometer that shows gravity is told, one whose zero is usual is not") {
  ObservedRide ride = spencer_ride(kObservedCar, 3);
  const auto told = [&] {
    const ObserveReport report = observe(tanh_of_spencer(), kCarDomain, ride.setup, {ride.recorded},
                                         {.force = {{30, 0.01}, {50, 1}}});
    return fmt::format("{}", fmt::join(report.warnings, " | "));
  };
  CHECK_FALSE(contains(told(), "its zero came out"));
  for (double& value : ride.recorded.channels.front().samples) value += 9.81;
  REQUIRE(ride.recorded.channels.front().name == "az_body");
  CHECK(contains(told(), "ride, az_body: its zero came out at "));
}

TEST_CASE("observe: a recording that the filter loses is told of") {
  std::string car = kObservedCar;
  const std::string road = "{kind: ground, class: C, speed: 20 m/s}";
  car.replace(car.find(road), road.size(), "{channel: road, kind: ground, noise: 0.2 mm}");
  ObservedRide ride = spencer_ride(car, 3);
  const auto samples_of = [&](std::string_view name) -> std::vector<double>& {
    return std::ranges::find(ride.recorded.channels, name, &Channel::name)->samples;
  };
  std::swap(samples_of("az_body"), samples_of("az_wheel"));
  const ObserveReport report = observe(tanh_of_spencer(), kCarDomain, ride.setup, {ride.recorded},
                                       {.force = {{30, 0.01}, {50, 1}}});
  CHECK(std::ranges::any_of(report.warnings, [](const std::string& warning) {
    return warning.starts_with("ride, az_wheel: what was expected of it is ");
  }));
}

TEST_CASE("observe: a law that leaps where the stroke crosses 0 is told of where it finds that") {
  const auto leaping = tanh_of_spencer(0.4);
  ObservedRide ride = ride_with(*leaping, kObservedCar, 3);
  for (Channel& channel : ride.recorded.channels)
    for (double& value : channel.samples)
      if (channel.name == "level") value += 8e-4;  // four times its noise
  const ObserveReport report =
      observe(leaping, kCarDomain, ride.setup, {ride.recorded}, {.force = {{5, 0.01}, {200, 1}}});
  REQUIRE(report.warnings.size() == 1);
  CAPTURE(report.warnings[0]);
  CHECK(contains(report.warnings[0], "ride, level: its zero came out at 0.00"));
  CHECK(contains(report.warnings[0], "the leap of this model where the stroke crosses 0"));
}

TEST_CASE(
    "observe: a sensor that is dead, stuck, lost or drifts is told, and none of clean rides") {
  // What is said of the sensors of a ride, one of which is tampered with.
  const auto told = [](ObservedRide ride, std::size_t channel, const auto& tampered) {
    std::vector<double>& shown = ride.recorded.channels[channel].samples;
    for (std::size_t k = 0; k < shown.size(); ++k) shown[k] = tampered(k, shown);
    const ObserveReport report = observe(tanh_of_spencer(), kCarDomain, ride.setup, {ride.recorded},
                                         {.force = {{28, 0.005}, {5, 0.3}}});
    std::vector<std::string> faults;
    for (const std::string& warning : report.warnings)
      if (contains(warning, "stands at") || contains(warning, "drift")) faults.push_back(warning);
    return faults;
  };
  const auto as_it_is = [](std::size_t k, const std::vector<double>& shown) { return shown[k]; };
  for (const std::uint64_t seed : {1, 2, 3, 4})
    CHECK(told(spencer_ride(kObservedCar, 4, seed), 0, as_it_is).empty());

  const ObservedRide ride = spencer_ride(kObservedCar, 4);
  REQUIRE(ride.recorded.channels[0].name == "az_body");
  REQUIRE(ride.recorded.channels[2].name == "level");

  // Stuck from 2 s on, lost for a while; a coarse one is neither.
  const auto stuck = told(ride, 2, [](std::size_t k, const std::vector<double>& shown) {
    return shown[std::min<std::size_t>(k, 1000)];
  });
  REQUIRE(stuck.size() == 1);
  CHECK(contains(stuck[0], "ride, level: stands at "));
  CHECK(contains(stuck[0], " m from 2 to 4 s, where the plant moves on"));
  const auto lost = told(ride, 0, [](std::size_t k, const std::vector<double>& shown) {
    return k < 1000 || k >= 1100 ? shown[k] : 0;
  });
  REQUIRE(lost.size() == 1);
  CHECK(contains(lost[0], "ride, az_body: stands at 0 m/s^2 from 2 to 2.2 s"));
  CHECK(told(ride, 2, [](std::size_t k, const std::vector<double>& shown) {
          return 0.002 * std::round(shown[k] / 0.002);
        }).empty());

  // Zeros that drift; a gain is none.
  const auto drifts = told(ride, 0, [](std::size_t k, const std::vector<double>& shown) {
    return shown[k] + 0.5 * static_cast<double>(k) / static_cast<double>(shown.size());
  });
  REQUIRE(drifts.size() == 1);
  const std::string drift = "ride, az_body: its zero seems to drift, by some ";
  REQUIRE(drifts[0].starts_with(drift));
  CHECK_CLOSE(std::stod(drifts[0].substr(drift.size())), 0.5, 0.1, 0);
  CHECK(told(ride, 0, [](std::size_t k, const std::vector<double>& shown) {
          return 1.2 * shown[k];
        }).empty());

  // One that shows nothing at all, in whichever recording.
  PlantRecording dead = ride.recorded;
  dead.name = "second";
  for (double& value : dead.channels[2].samples) value = 0.123;
  const std::vector<PlantRecording> both = {ride.recorded, dead};
  CHECK_THROWS_WITH_AS(observe(tanh_of_spencer(), kCarDomain, ride.setup, both, {}),
                       doctest::Contains("second, level: is constant"), Error);
}

TEST_CASE("observe: the noise of a measured road is in what a wheel's acceleration is to show") {
  // 0.2 mm push the wheel of the filter by 0.4 m/s^2 through the tyre, and that of the car not.
  std::string file = kObservedCar;
  for (const auto& [old, other] :
       {std::pair<std::string, std::string>{"{kind: ground, class: C, speed: 20 m/s}",
                                            "{channel: road, kind: ground, noise: 0.2 mm}"},
        {"wheel, noise: 0.5", "wheel, noise: 0.05"}})
    file.replace(file.find(old), old.size(), other);
  const ObservedRide ride = spencer_ride(file, 4);
  ObserveOptions options;
  options.force = {{28, 0.005}, {20, 0.3}};
  const ObserveReport report =
      observe(tanh_of_spencer(), kCarDomain, ride.setup, {ride.recorded}, options);
  const auto [error, inside] = judged(report, ride.truth);
  CHECK(error < 0.01);
  CHECK(inside > 0.75);
  CHECK(report.recordings[0].sensors[1].inside > 0.8);
  CHECK(report.warnings.empty());
}

TEST_CASE("observe: with the true damper, whose states are in the filter, its memory is known") {
  const ObservedRide ride = spencer_ride(kObservedCar, 3);
  ObserveOptions options;
  options.force = {{2, 0.01}};
  const ObserveReport report = observe(std::make_shared<LawModel>(load_parameters("spencer1997")),
                                       kCarDomain, ride.setup, {ride.recorded}, options);
  const auto [error, inside] = judged(report, ride.truth);
  CHECK(error < 0.006);
  CHECK(inside > 0.7);
  CHECK(report.warnings.empty());
}

TEST_CASE("observe: more states than a filter estimates are carried along the damper's motion") {
  const ObservedRide ride = spencer_ride(kObservedCar, 4);
  const auto spencer = std::make_shared<LawModel>(load_parameters("spencer1997"));
  const auto mean =
      std::make_shared<MeanModel>(std::vector<MeanModel::Member>(8, {spencer, 0.125}));
  for (const bool causal : {false, true}) {
    const ObserveOptions options{
        .causal = causal, .force = {{5, 0.002}, {2, 0.1}}, .seeks_faults = false};
    const auto observed = [&](const std::shared_ptr<const DamperModel>& damper) {
      return judged(observe(damper, kCarDomain, ride.setup, {ride.recorded}, options), ride.truth);
    };
    const auto estimated = observed(spencer), carried = observed(mean);
    CHECK(carried.first < 1.5 * estimated.first);
    CHECK(carried.second > 0.85);
  }
}

TEST_CASE("observe: a force that is off all along is not taken for the zero of a sensor" *
          doctest::test_suite("long")) {
  const Wear lopsided{.name = "lopsided",
                      .unit = "N",
                      .meaning = "more in rebound, less in compression",
                      .usual = 1,
                      .added = [](const DamperInput& input, double) {
                        return std::abs(std::tanh(input.velocity / 0.02));
                      }};
  const ObservedRide ride = spencer_ride(kObservedCar, 6);
  const auto damper =
      std::make_shared<WornDamper>(std::make_shared<LawModel>(load_parameters("spencer1997")),
                                   std::vector<WornDamper::Amount>{{&lopsided, 60}});
  const auto observed = [&](std::vector<ForceError> force) {
    return observe(damper, kCarDomain, ride.setup, {ride.recorded},
                   {.force = std::move(force), .seeks_faults = false});
  };
  const ObserveReport with = observed({});
  REQUIRE(with.noise.force.size() == 3);
  CHECK(with.noise.force.back().memory == kStayingError);
  const ObserveReport without = observed({with.noise.force[0], with.noise.force[1]});
  const auto deflection = [&](const ObserveReport& report) {
    return judged(report, ride.truth, damper_quantities(0, 1).deflection);
  };
  CHECK(judged(with, ride.truth).second > 0.8);
  CHECK(deflection(with).second > 0.8);
  CHECK(deflection(without).second < 0.5);
  CHECK(deflection(with).first < deflection(without).first);
}

TEST_CASE("observe: where a law bends at another velocity than the damper, bands of motion hold") {
  const ObservedRide ride = spencer_ride(kObservedCar, 4);
  const auto observed = [&](std::vector<ForceError> force) {
    return observe(tanh_of_spencer(), kCarDomain, ride.setup, {ride.recorded},
                   {.force = std::move(force), .seeks_faults = false});
  };
  const ObserveReport with = observed({}), without = observed({{14, 0.003}, {0.4, 3}});
  CHECK(with.noise.shift.deviation > 2e-3);
  CHECK(with.noise.shift.deviation < 8e-3);
  CHECK(without.noise.shift.deviation == 0);
  const DamperQuantities places = damper_quantities(0, 1);
  const auto force = judged(with, ride.truth), force_without = judged(without, ride.truth),
             velocity = judged(with, ride.truth, places.velocity),
             velocity_without = judged(without, ride.truth, places.velocity);
  CHECK(velocity.second > 0.85);
  CHECK(velocity_without.second < 0.75);
  CHECK(velocity.first < 0.8 * velocity_without.first);
  CHECK(force.first < force_without.first);
  CHECK(force.second > 0.85);

  // A law of the damper's own structure needs none.
  const ObservedRide short_ride = spencer_ride(kObservedCar, 2);
  const ObserveReport own =
      observe(std::make_shared<LawModel>(load_parameters("spencer1997")), kCarDomain,
              short_ride.setup, {short_ride.recorded}, {.seeks_faults = false});
  CHECK(own.noise.shift.deviation < 5e-4);
}

TEST_CASE("observe: what a step does with a shifted velocity is in its transition") {
  const InPlantSetup setup = parse_in_plant_setup(kObservedHalfCar, "car.yaml");
  const auto damper = std::make_shared<LawModel>(load_parameters("spencer1997"));
  ObserverScale scale = observer_scale({{damper, kCarDomain}, {damper, kCarDomain}});
  scale.offset.assign(6, 1e-3);
  const ObserverNoise noise{
      .force = {{28, 0.005}}, .shift = {1e-6, 0.01}, .sensors = {0.05, 5e-3, 0.5, 0.5, 2e-4, 2e-4}};
  const PlantObserver observer(observer_tables(setup, {damper, damper}, noise, scale, 0.001, 2),
                               {damper, damper});
  const std::size_t all = observer.tables().all(), moving = observer.tables().moving();

  // From a motion with a shift of the rear damper, as no sensor shows anything: errors of a force
  // and its shift stand damper by damper behind eight numbers of the plant.
  constexpr std::size_t kRearShift = 8 + 3;
  constexpr double kShift = 0.05, kBeside = 1e-4;
  const std::vector<double> still(3, 0.0), nothing(6, NAN);
  const auto moved = [&](double shift, ObservedSample& told) {
    std::vector<double> s(all), c(all * all);
    for (std::size_t k = 4; k < 8; ++k) s[k] = 0.02 * static_cast<double>(k);
    s[kRearShift] = shift;
    for (std::size_t k = 0; k < all; ++k) c[k * all + k] = 1e-12;
    observer.step(still, still, nothing, s, c, told);
    return s;
  };
  ObservedSample told;
  const std::vector<double> low = moved(kShift - kBeside, told),
                            high = moved(kShift + kBeside, told), at = moved(kShift, told);
  CHECK_CLOSE(at[kRearShift], kShift * std::exp(-0.1), 1e-12, 0);
  for (std::size_t k = 0; k < moving; ++k) {
    CAPTURE(k);
    const double slope = (high[k] - low[k]) / (2 * kBeside);
    CHECK_CLOSE(told.transition[k * moving + kRearShift], slope, 0.02, 1e-6);
  }
  CHECK(std::abs(told.transition[7 * moving + kRearShift]) > 1e-3);  // it moves the rear wheel
}

TEST_CASE("observe: how well the plant's mass is known is in the bands of the forces") {
  ObservedRide ride = spencer_ride(kObservedCar, 2);
  const auto mass =
      std::ranges::find(ride.setup.known, "sprung_mass", &NamedValues::value_type::first);
  REQUIRE(mass != ride.setup.known.end());
  mass->second *= 1.05;
  ObserveOptions options;
  options.force = {{28, 0.005}, {20, 0.3}};
  const auto observed = [&](const InPlantSetup& setup) {
    return observe(tanh_of_spencer(), kCarDomain, setup, {ride.recorded}, options);
  };
  InPlantSetup found = ride.setup;
  found.found = {{"sprung_mass", 0.94 * mass->second, 1.02 * mass->second},
                 {"tyre_stiffness", 0, 1e9}};
  const ObserveReport known = observed(ride.setup), within = observed(found);
  CHECK(known.forces_known_within == 0);
  CHECK_CLOSE(within.forces_known_within, 0.06, 1e-12, 0);

  // As a share of the force, at the level of the band, beside what the filter knows.
  const ObservedQuantity &before = known.recordings[0].quantities[0],
                         &force = within.recordings[0].quantities[0];
  for (std::size_t k = 0; k < force.value.size(); k += 50) {
    CHECK(force.value[k] == before.value[k]);
    const double share = 1.6448536 / 1.9599640 * 0.06 * force.value[k];
    CHECK_CLOSE(force.half[k], std::hypot(before.half[k], share), 1e-6, 0);
  }
  CHECK(judged(within, ride.truth).second > judged(known, ride.truth).second + 0.05);
}

TEST_CASE("observe: a plant that states no sensor's noise is told what that does to the bands" *
          doctest::test_suite("long")) {
  ObservedRide ride = spencer_ride(kObservedCar, 1);
  for (PlantSensor& sensor : ride.setup.sensors) sensor.noise = 0;
  const ObserveReport report =
      observe(tanh_of_spencer(), kCarDomain, ride.setup, {ride.recorded}, {});
  REQUIRE(!report.warnings.empty());
  CHECK(contains(report.warnings.back(), "neither plant nor model says"));

  // Noise that is not known would pass for a shift of the velocity.
  CHECK(report.noise.shift.deviation == 0);
}

TEST_CASE("observe: the forces of both dampers of a half car, which are of another structure" *
          doctest::test_suite("long")) {
  const ObservedRide ride = spencer_ride(kObservedHalfCar, 3);
  const ObserveOptions options;
  const ObserveReport alike =
      observe(tanh_of_spencer(), kCarDomain, ride.setup, {ride.recorded}, options);
  CHECK(alike.noise_was_found);
  CHECK(alike.struts == std::vector<std::string>{"front", "rear"});
  const std::vector<ObservedQuantity>& quantities = alike.recordings[0].quantities;
  CHECK(quantities[0].name == "front_damper_force");
  CHECK(quantities[1].name == "rear_damper_force");
  CHECK(quantities[2].name == "front_deflection");
  CHECK(quantities[5].name == "rear_velocity");
  CHECK(alike.recordings[0].sensors[1].unit == "rad/s");
  for (const std::size_t damper : {0u, 1u}) {
    const auto [error, inside] = judged(alike, ride.truth, damper);
    MESSAGE(quantities[damper].name << ": " << 100 * error << " % of span, " << 100 * inside
                                    << " % in the 90 % band");
    CHECK(error < 0.01);
    CHECK(inside > 0.8);
    CHECK(inside < 0.97);
  }

  // With the true damper behind, whose three states are the filter's then, that one is known
  // better.
  const auto spencer = std::make_shared<LawModel>(load_parameters("spencer1997"));
  const ObserveReport mixed = observe({{tanh_of_spencer(), kCarDomain}, {spencer, kCarDomain}},
                                      ride.setup, {ride.recorded}, options);
  CHECK(judged(mixed, ride.truth, 1).first < 0.8 * judged(alike, ride.truth, 1).first);
  CHECK(judged(mixed, ride.truth, 0).first < 1.1 * judged(alike, ride.truth, 0).first);
}

TEST_CASE("observe: two dampers in one plant whose halves do not touch are as each is alone" *
          doctest::test_suite("long")) {
  const std::string halves =
      "plant: matrices\ncoordinates: [a, b]\n"
      "mass: [[100 kg, 0], [0, 150 kg]]\nstiffness: [[20 N/mm, 0], [0, 30 N/mm]]\n"
      "dampers: [{name: left, from: ground, to: a}, {name: right, from: ground, to: b}]\n"
      "inputs:\n  - {channel: push_a, kind: force, at: a, noise: 1}\n"
      "  - {channel: push_b, kind: force, at: b, noise: 2}\n"
      "sensors:\n  - {channel: x_a, quantity: displacement, at: a, noise: 0.1 mm}\n"
      "  - {channel: x_b, quantity: displacement, at: b, noise: 0.2 mm}\n"
      "  - {channel: acc_b, quantity: acceleration, at: b, noise: 0.1}\nvoltage: 1 V\n";
  const std::string right =
      "plant: matrices\ncoordinates: [b]\nmass: [[150 kg]]\nstiffness: [[30 N/mm]]\n"
      "dampers: [{name: right, from: ground, to: b}]\n"
      "inputs: [{channel: push_b, kind: force, at: b, noise: 2}]\n"
      "sensors: [{channel: x_b, quantity: displacement, at: b, noise: 0.2 mm},"
      " {channel: acc_b, quantity: acceleration, at: b, noise: 0.1}]\nvoltage: 1 V\n";
  const InPlantSetup setup = parse_in_plant_setup(halves, "halves.yaml");
  const std::vector<VirtualRide> rides =
      virtual_campaign(setup, load_parameters("spencer1997"),
                       {.duration = 2, .levels = {1}, .road = "", .push = 300, .seed = 3});
  const PlantRecording recorded{.name = "ride",
                                .sample_time = rides.front().recorded.sample_time,
                                .samples = rides.front().recorded.size(),
                                .channels = rides.front().recorded.channels};

  // spencer1997 has states of its own. Its neighbour has none, another force, and the same scales.
  ObserveOptions options;
  options.force = {{28, 0.005}, {20, 0.3}};
  options.steps = 2;
  const ObservedDamper spencer{std::make_shared<LawModel>(load_parameters("spencer1997")),
                               kCarDomain},
      tanh{tanh_of_spencer(), kCarDomain};
  const auto force_of = [&](const ObservedDampers& dampers, const InPlantSetup& plant,
                            std::size_t which) {
    return observe(dampers, plant, {recorded}, options).recordings[0].quantities[which];
  };
  const InPlantSetup half = parse_in_plant_setup(right, "right.yaml");
  const ObservedQuantity alone = force_of({spencer}, half, 0),
                         beside = force_of({tanh, spencer}, setup, 1),
                         alike = force_of({spencer, spencer}, setup, 1);
  CHECK(alone.name == "damper_force");
  CHECK(alike.name == "right_damper_force");
  for (std::size_t k = 0; k < alone.value.size(); ++k) {
    CHECK_CLOSE(alike.value[k], alone.value[k], 1e-8, 1e-5);
    CHECK_CLOSE(alike.half[k], alone.half[k], 1e-6, 1e-5);
    CHECK_CLOSE(beside.value[k], alone.value[k], 1e-3, 1);
  }
}

TEST_CASE("observe: the four forces of a full car" * doctest::test_suite("long")) {
  std::string text =
      "plant: full_car\nparameters: {mass: 1500 kg, pitch_inertia: 2160 kg*m^2, roll_inertia: 460 "
      "kg*m^2, wheel_mass: 59 kg, front_stiffness: 35 kN/m, rear_stiffness: 38 kN/m, "
      "tyre_stiffness: 190 kN/m, front_distance: 1.4 m, rear_distance: 1.7 m, front_track: 1.5 m, "
      "rear_track: 1.5 m}\nvoltage: 1 V\ninputs:\n";
  std::string sensors =
      "sensors:\n  - {channel: az, quantity: acceleration, at: body, noise: 0.05}\n";
  for (const std::string corner : {"front_left", "front_right", "rear_left", "rear_right"}) {
    text += "  - {channel: road_" + corner + ", kind: ground, at: " + corner + ", noise: 0.2 mm}\n";
    sensors += "  - {channel: az_" + corner + ", quantity: acceleration, at: " + corner +
               "_wheel, noise: 0.5}\n  - {channel: level_" + corner +
               ", quantity: deflection, at: " + corner + ", noise: 0.2 mm}\n";
  }
  const ObservedRide ride = spencer_ride(text + sensors, 4);
  ObserveOptions options;
  options.force = {{28, 0.005}, {20, 0.3}};
  const ObserveReport report = observe(std::make_shared<LawModel>(load_parameters("spencer1997")),
                                       kCarDomain, ride.setup, {ride.recorded}, options);
  REQUIRE(report.struts.size() == 4);
  for (std::size_t damper = 0; damper < 4; ++damper) {
    const auto [error, inside] = judged(report, ride.truth, damper);
    MESSAGE(report.struts[damper] << ": " << 100 * error << " % of span, " << 100 * inside
                                  << " % in the 90 % band");
    CHECK(error < 0.01);
    CHECK(inside > 0.75);
  }
}

TEST_CASE("observe: what a sample adds is what chance does between the samples, not a line") {
  constexpr double kSample = 0.002, kWheel = 139.5, kTyre = 295200;
  const InPlantSetup setup = parse_in_plant_setup(kObservedCar, "car.yaml");
  const auto damper = tanh_of_spencer();
  ObserverScale scale = observer_scale(*damper, kCarDomain);
  scale.offset.assign(3, 1e-3);

  // Variances of the wheel's velocity and of the height (4) or the error (5) that moved it.
  const auto added = [&](ObserverNoise noise, std::size_t own) {
    noise.sensors = {0.05, 0.5, 2e-4};
    const ObserverTables t = observer_tables(setup, {damper}, noise, scale, kSample, 2);
    const std::size_t moving = t.moving();
    REQUIRE(moving == 6);
    return std::pair{t.process[3 * moving + 3], t.process[own * moving + own]};
  };

  // Of a random walk the integral has a third of the variance that a straight line would have as
  // one value all along; a line from 0 has a quarter.
  const auto [by_road, road] = added({.force = {{1e-6, 1}}, .roughness = 256e-4}, 4);
  CHECK_CLOSE(by_road, road * std::pow(kTyre / kWheel * kSample, 2) / 3, 0.02, 0);
  const auto [by_slow, slow] = added({.force = {{1e4, 1}}, .roughness = 1e-12}, 5);
  CHECK_CLOSE(by_slow, slow * std::pow(kSample / kWheel, 2) / 3, 0.02, 0);

  // An error that is forgotten within half a sample: of a first-order process from 0.
  const double deviation = 1e4, memory = kSample / 2;
  const auto [by_quick, quick] = added({.force = {{deviation, memory}}, .roughness = 1e-12}, 5);
  CHECK_CLOSE(quick, deviation * deviation * (1 - std::exp(-4)), 1e-6, 0);
  CHECK_CLOSE(by_quick,
              std::pow(deviation * memory / kWheel, 2) *
                  (2 * kSample / memory - 3 + 4 * std::exp(-2) - std::exp(-4)),
              0.03, 0);
}

TEST_CASE("observe: light wheels on roads that nothing measures: bands of the motion hold too" *
          doctest::test_suite("long")) {
  std::string file = kObservedHalfCar;
  for (const auto& [old, other] : {std::pair<std::string, std::string>{"139.5 kg", "40 kg"},
                                   {"130 kg", "45 kg"},
                                   {"{channel: road_front, kind: ground, at: front, noise: 0.2 mm}",
                                    "{kind: ground, at: front, class: C, speed: 20 m/s}"},
                                   {"{channel: road_rear, kind: ground, at: rear, noise: 0.2 mm}",
                                    "{kind: ground, at: rear, class: C, speed: 20 m/s}"},
                                   {"front_wheel, noise: 0.5", "front_wheel, noise: 0.08"},
                                   {"rear_wheel, noise: 0.5", "rear_wheel, noise: 0.08"}})
    file.replace(file.find(old), old.size(), other);

  // With the true damper, soft and firm.
  for (const std::string level : {"0 V", "2 V"}) {
    CAPTURE(level);
    std::string at_level = file;
    at_level.replace(at_level.find("1 V"), 3, level);
    const ObservedRide ride = spencer_ride(at_level, 3);
    const ObserveReport report =
        observe(std::make_shared<LawModel>(load_parameters("spencer1997")), kCarDomain, ride.setup,
                {ride.recorded}, {.seeks_faults = false});
    for (const std::size_t damper : {0u, 1u}) {
      const DamperQuantities places = damper_quantities(damper, 2);
      const auto force = judged(report, ride.truth, places.force),
                 velocity = judged(report, ride.truth, places.velocity);
      MESSAGE(level << ": force " << 100 * force.first << " % of span, " << 100 * force.second
                    << " % in the 90 % band; velocity " << 100 * velocity.second << " %");
      CHECK(force.first < 0.01);
      CHECK(force.second > 0.85);
      CHECK(velocity.second > 0.85);
    }
  }
}

TEST_CASE("observe: a shift of road and car together is no motion that a sensor could show") {
  const InPlantSetup setup = parse_in_plant_setup(kObservedCar, "car.yaml");
  const auto damper = tanh_of_spencer();
  ObserverScale scale = observer_scale(*damper, kCarDomain);
  scale.offset.assign(3, 1e-3);
  const ObserverNoise noise{
      .force = {{28, 0.005}}, .sensors = {0.05, 0.5, 2e-4}, .roughness = 256e-6};
  ObserverTables tables = observer_tables(setup, {damper}, noise, scale, 0.002, 2);
  CHECK(tables.road_keep < 1);
  tables.road_keep = 1;
  const PlantObserver observer(tables, {damper});
  const std::size_t all = tables.all(), moving = tables.moving();
  std::vector<double> s(all), c(all * all), input = {1};
  ObservedSample told;
  observer.start(input, std::vector<double>{0.3, -1, 0.01}, {}, s, c, told);
  for (int k = 0; k < 20; ++k)
    observer.step(input, input, std::vector<double>{0.3 - 0.1 * k, -1.0 + k, 0.01}, s, c, told);
  for (std::size_t i = 0; i < moving; ++i) {
    const double* row = &told.transition[i * moving];
    const bool is_height = i < 2 || i == 4;
    CHECK_CLOSE(row[0] + row[1] + row[4], is_height ? 1 : 0, 0, 1e-9);
  }
  for (std::size_t sensor = 0; sensor < 3; ++sensor) {
    const double* row = &told.rows[sensor * all];
    CHECK_CLOSE(row[0] + row[1] + row[4], 0, 0, 1e-9 * (1 + std::abs(row[4])));
  }
}

TEST_CASE("smooth: what one sample says of another instant is what that says of its own") {
  const InPlantSetup setup = parse_in_plant_setup(
      "plant: oscillator\nparameters: {mass: 1 kg, damping: 0, stiffness: 100 N/m}\n"
      "inputs: [{channel: push, kind: force, at: mass}]\n"
      "sensors: [{channel: x, quantity: displacement, at: mass, noise: 1 mm, zero: 1e-9}]\n",
      "oscillator.yaml");
  const Law& law = find_law("tanh_kwok");  // here a dashpot
  std::vector<double> p(law.params.size());
  p[law.index_of("c")] = 2;
  p[law.index_of("beta")] = 1;
  const auto damper = std::make_shared<LawModel>(LawModel::constant(law, p));
  ObserverScale scale = observer_scale(*damper, {-0.1, 0.1, -1, 1, 0, 0});
  scale.offset = {1e-9};
  const PlantObserver observer(
      observer_tables(setup, {damper}, {.force = {{1, 0.1}}, .sensors = {1e-3}}, scale, 0.01, 1),
      {damper});
  constexpr std::size_t kCount = 30;
  ObservedSamples samples{.count = kCount, .inputs = 1, .sensors = 1, .driven = {}, .measured = {}};
  for (std::size_t k = 0; k < kCount; ++k) {
    samples.driven.insert(samples.driven.end(), {std::sin(0.3 * static_cast<double>(k)), 0.0});
    samples.measured.push_back(0.01 * std::cos(0.5 * static_cast<double>(k)));
  }
  const std::size_t all = observer.tables().all();
  const ObservedRun before = filtered(observer, samples);
  ObservedRun run = before;
  smooth(observer, samples, run);

  // The last estimate knew all samples already; the others know more than they did.
  for (std::size_t k = 0; k < all; ++k)
    CHECK(run.estimates[(kCount - 1) * all + k] == before.estimates[(kCount - 1) * all + k]);
  for (std::size_t k = 0; k < kCount - 1; ++k)
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(run.covariances[(k * all + i) * all + i] <=
            before.covariances[(k * all + i) * all + i] * (1 + 1e-9));

  // Of a linear plant, an estimate follows a sample by the covariance of both over the noise's.
  const auto moved = [&](std::size_t which, std::size_t at) {
    constexpr double kStep = 1e-4;
    ObservedSamples other = samples;
    other.measured[which] += kStep;
    ObservedRun its = filtered(observer, other);
    smooth(observer, other, its);
    return (its.estimates[at * all] - run.estimates[at * all]) / kStep;
  };
  for (const std::size_t at : {0u, 10u})
    for (const std::size_t which : {3u, 25u})
      CHECK_CLOSE(moved(which, at), moved(at, which), 1e-6, 1e-9);
  CHECK_CLOSE(moved(12, 12), run.covariances[12 * all * all] / 1e-6, 1e-5, 0);

  // Its tangents are the same everywhere, so that nothing is to be gained by better ones.
  ObservedRun again = run;
  smooth_again(observer, samples, again);
  for (std::size_t k = 0; k < run.estimates.size(); ++k)
    CHECK_CLOSE(again.estimates[k], run.estimates[k], 1e-6, 1e-12);
}

TEST_CASE("observe: what cannot be is said with what would be right") {
  const ObservedRide ride = spencer_ride(kObservedCar, 1);
  const auto damper = tanh_of_spencer();
  ObserveOptions options;
  options.force = {{28, 0.005}};
  InPlantSetup unknown = ride.setup;
  unknown.known.erase(unknown.known.begin());
  unknown.unknown = {{"unsprung_mass", 10, 300, {}}};
  CHECK(
      contains(message_of([&] { observe(damper, kCarDomain, unknown, {ride.recorded}, options); }),
               "unsprung_mass: is unknown; its value: 'dashpot identify --in' writes"));
  InPlantSetup filtered = ride.setup;
  filtered.sensors.back().finds_cutoff = CutoffRange{};
  CHECK(
      contains(message_of([&] { observe(damper, kCarDomain, filtered, {ride.recorded}, options); }),
               "the cut-off of its filter is unknown; its value: 'dashpot identify --in' writes"));
  const auto spencer = std::make_shared<LawModel>(load_parameters("spencer1997"));
  const auto mean =
      std::make_shared<MeanModel>(std::vector<MeanModel::Member>(200, {spencer, 0.005}));
  CHECK(contains(
      message_of([&] { observe(mean, kCarDomain, ride.setup, {ride.recorded}, options); }),
      "mean: has 600 states, and a filter carries 512; a law of the same damper, as tanh_kwok"));
  InPlantSetup late = ride.setup;
  late.sensors.back().finds_delay = true;
  CHECK(contains(message_of([&] { observe(damper, kCarDomain, late, {ride.recorded}, options); }),
                 "its delay is unknown; its value: 'dashpot identify --in' writes"));
  PlantRecording brief = ride.recorded;
  brief.samples = 20;
  CHECK(contains(message_of([&] { observe(damper, kCarDomain, ride.setup, {brief}, options); }),
                 "has 20 samples; 100 or more"));
  CHECK(contains(message_of([&] { make_observer(damper, kCarDomain, ride.setup, 0.002, options); }),
                 "level: is 2 ms late: a filter that runs with the plant cannot bring it forward"));

  // Of several dampers too; and a road that is met later is no channel.
  const ObservedRide half = spencer_ride(kObservedHalfCar, 1);
  InPlantSetup heavy = half.setup;
  heavy.known.erase(heavy.known.begin());
  heavy.unknown = {{"mass", 400, 1000, {}}};
  CHECK(contains(message_of([&] { observe(damper, kCarDomain, heavy, {half.recorded}, options); }),
                 "plant, mass: is unknown"));
  std::string follower = kObservedHalfCar;
  const std::string own = "{channel: road_rear, kind: ground, at: rear, noise: 0.2 mm}";
  follower.replace(follower.find(own), own.size(),
                   "{kind: ground, at: rear, follows: road_front, delay: 0.14 s}");
  CHECK(contains(message_of([&] {
                   observe(damper, kCarDomain, parse_in_plant_setup(follower, "half.yaml"),
                           {half.recorded}, options);
                 }),
                 "the observer knows no road that follows another one; a channel with the height"));
}

TEST_CASE("a plant's file: a road that nothing measures, and the file that it becomes") {
  const InPlantSetup setup = parse_in_plant_setup(kObservedCar, "car.yaml");
  REQUIRE(setup.inputs[0].road);
  CHECK(setup.inputs[0].road->roughness == 256e-6);
  CHECK(setup.inputs[0].road->speed == 20);
  CHECK(setup.channels() == std::vector<std::string>{"az_body", "az_wheel", "level"});
  const InPlantSetup again = parse_in_plant_setup(format_json(to_json(setup)), "again.json");
  CHECK(format_json(to_json(again)) == format_json(to_json(setup)));
  CHECK(again.sensors[2].delay == 0.002);
  CHECK(again.drives.front().level == 1);
  const auto refusal = [](const std::string& input) {
    std::string text = kObservedCar;
    const std::string old = "{kind: ground, class: C, speed: 20 m/s}";
    return message_of(
        [&] { parse_in_plant_setup(text.replace(text.find(old), old.size(), input), "car.yaml"); });
  };
  CHECK(contains(refusal("{kind: force, at: body}"), "only a road may be without: kind: ground"));
  CHECK(contains(refusal("{kind: ground, class: X, speed: 20 m/s}"), "unknown class 'X'"));
  CHECK(contains(refusal("{kind: ground, class: C}"), "speed"));
}
