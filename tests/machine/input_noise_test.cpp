#include "dashpot/machine/input_noise.h"

#include <array>
#include <numbers>
#include <numeric>

#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/numerics/distributions.h"
#include "dashpot/numerics/spectrum.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kRate = 250;  // Hz

/// A car on a road that is measured with noise.
InPlantSetup car_on_measured_road(double road_noise) {
  InPlantSetup setup;
  setup.model = &find_machine("quarter_car", "test");
  setup.known = {{"unsprung_mass", 139.5}, {"spring_stiffness", 37300}};
  setup.inputs = {{"road", {PlantInput::Ground, 0}, road_noise}};
  setup.sensors = {{.channel = "body", .place = {PlantQuantity::Acceleration, 0}, .noise = 0.05},
                   {.channel = "wheel", .place = {PlantQuantity::Acceleration, 1}, .noise = 0.5},
                   {.channel = "level", .place = {PlantQuantity::Deflection, 0}, .noise = 2e-4}};
  setup.skip = 0.2;
  return setup;
}

PlantRecording ride_of(InPlantSetup truth, const DamperModel& damper, double seconds,
                       std::uint64_t seed = 4) {
  const NamedValues numbers = {
      {"sprung_mass", 387}, {"tyre_stiffness", 295200}, {"tyre_damping", 300}};
  truth.known.insert(truth.known.end(), numbers.begin(), numbers.end());
  const VirtualRide ride = virtual_campaign(truth, damper,
                                            {.duration = seconds,
                                             .sample_rate = kRate,
                                             .levels = {0},
                                             .road = "iso8608,class=C,speed=20m/s",
                                             .seed = seed})
                               .front();
  return {.name = "ride",
          .sample_time = ride.recorded.sample_time,
          .samples = ride.recorded.size(),
          .channels = ride.recorded.channels};
}

const FittedParameter& named_in(const std::vector<FittedParameter>& list, const std::string& name) {
  return *std::ranges::find(list, name, &FittedParameter::name);
}

}  // namespace

TEST_CASE("input noise: what is mixed at random is told apart") {
  // The gains are those of a car with a stiff dashpot; samples are mixed line by line.
  constexpr std::size_t kSamples = 7500;
  InPlantSetup setup = car_on_measured_road(0);
  for (PlantSensor& sensor : setup.sensors) sensor.noise = 0;
  const StandIn stand_in{.stiffness = 2000, .damping = 1500};
  std::vector<RecordingNoise> recordings;
  recordings.emplace_back(setup, stand_in, 1 / kRate, kSamples);
  REQUIRE(recordings[0].samples() == kSamples);

  const NoiseSources truth{.sensors = {0.05, 0.5, 2e-4}, .inputs = {5e-4}, .force = {30, 0, 0}};
  std::vector<PlantInputPlace> inputs = {{PlantInput::Ground, 0}};
  const DrivenPlant plant(make_plant(*setup.model, setup.known), inputs);
  PlantAtLine at(plant, setup, {&stand_in, 1});
  Random random(3);
  std::vector<std::vector<std::complex<double>>> lines(
      3, std::vector<std::complex<double>>(kSamples / 2 + 1));
  const double scale = std::sqrt(static_cast<double>(kSamples) / 2);
  const auto normal = [&] { return scale * std::complex(random.normal(), random.normal()); };
  std::vector<std::complex<double>> road(3), force(3), noise(kSamples / 2 + 1);
  for (std::size_t l = 1; l < kSamples / 2; ++l) {
    const double w = 2 * std::numbers::pi * kRate * static_cast<double>(l) / kSamples;
    at.move_to(w);
    at.of_input(0, road);
    at.of_force(0, force);
    const double memory = force_memories()[0];
    noise[l] = truth.inputs[0] * normal();
    const auto d =
        truth.force[0] * std::sqrt(2 * memory * kRate / (1 + std::pow(w * memory, 2))) * normal();
    for (std::size_t s = 0; s < 3; ++s)
      lines[s][l] = truth.sensors[s] * normal() + road[s] * noise[l] + force[s] * d;
  }
  std::vector<std::vector<double>> beyond;
  std::vector<double> in_a_row;
  for (const auto& one : lines) {
    beyond.push_back(from_half_spectrum(one, kSamples));
    in_a_row.insert(in_a_row.end(), beyond.back().begin(), beyond.back().end());
  }
  recordings[0].set_beyond(beyond);

  // From a start that is wrong by factors; within four standard deviations as they are told.
  const NoiseSources first{.sensors = {0.2, 0.2, 1e-3}, .inputs = {1e-4}, .force = {100, 100, 100}};
  const NoiseFound found = find_noise(recordings, setup, first, 1);
  for (std::size_t s = 0; s < 3; ++s)
    CHECK_CLOSE(found.sources.sensors[s], truth.sensors[s], 4 * found.uncertainty[s], 0);
  CHECK_CLOSE(found.sources.inputs[0], truth.inputs[0], 4 * found.uncertainty[3], 0);
  CHECK(found.uncertainty[3] < 0.05);
  CHECK_CLOSE(found.sources.force[0], truth.force[0], 0.1, 0);
  CHECK(found.sources.force[1] < 3);

  // Real rows have the mean square of a sensor's samples: here every line up to 0.4 of the rate.
  std::vector<double> rows(recordings[0].lines() * recordings[0].rows_per_line());
  recordings[0].put_lines(in_a_row, kSamples, rows);
  double square = 0, all = 0;
  for (std::size_t i = 4; i < rows.size(); i += 6)
    square += rows[i] * rows[i] + rows[i + 1] * rows[i + 1];
  for (const double value : beyond[2]) all += value * value;
  CHECK_CLOSE(square, all, 0.2, 0);
  CHECK(square < all);

  // Without its most likely noise the input is nearer to the truth.
  const std::vector<double> added = from_half_spectrum(noise, kSamples),
                            likely = recordings[0].likely_inputs()[0];
  double before = 0, after = 0;
  for (std::size_t k = 0; k < kSamples; ++k) {
    before += added[k] * added[k];
    after += std::pow(added[k] - likely[k], 2);
  }
  CHECK(after < 0.7 * before);
}

TEST_CASE("input noise: what a setup states stays as it is stated") {
  InPlantSetup setup = car_on_measured_road(1e-3);
  std::vector<RecordingNoise> recordings;
  recordings.emplace_back(setup, StandIn{0, 1000}, 1 / kRate, 1000);
  Random random(8);
  std::vector<std::vector<double>> beyond(3, std::vector<double>(1000));
  for (auto& sensor : beyond)
    for (double& value : sensor) value = random.normal();
  recordings[0].set_beyond(beyond);
  const NoiseFound found =
      find_noise(recordings, setup,
                 {.sensors = {0.05, 0.5, 2e-4}, .inputs = {1e-3}, .force = {10, 10, 10}}, 1);
  CHECK_CLOSE(found.sources.sensors[1], 0.5, 1e-12, 0);
  CHECK_CLOSE(found.sources.inputs[0], 1e-3, 1e-12, 0);
  CHECK(found.uncertainty[3] == 0);
}

TEST_CASE(
    "input noise: weighed beside any force, rows tell nothing of a force and all else as ever") {
  constexpr std::size_t kSamples = 1000;
  InPlantSetup setup = car_on_measured_road(1e-3);
  std::vector<RecordingNoise> recordings;
  recordings.emplace_back(setup, StandIn{2000, 1500}, 1 / kRate, kSamples);
  RecordingNoise& noise = recordings.front();
  Random random(8);
  std::vector<double> force(kSamples);
  for (double& value : force) value = random.normal();
  std::vector<double> rows(noise.lines() * noise.rows_per_line());
  noise.put_forces(std::array{std::span<const double>(force)}, rows);

  // Forces of 100 N beside noise that is known are plain to see, and not beside forces of any size.
  for (double& value : rows) value *= 100;
  const auto seen_beside = [&](double deviation) {
    noise.weigh_by({.sensors = {0.05, 0.5, 2e-4}, .inputs = {1e-3}, .force = {deviation, 0, 0}});
    std::vector<double> white = rows;
    noise.whiten(white);
    return std::inner_product(white.begin(), white.end(), white.begin(), 0.0);
  };
  CHECK(seen_beside(0) > 20 * static_cast<double>(noise.lines()));
  CHECK(seen_beside(1e5) < 1e-3 * static_cast<double>(noise.lines()));

  // Samples of the noise itself come out white, of variance 1; two of the three directions are left
  // beside any force, and the rows that were given come back as what is shown beyond the sensors.
  noise.weigh_by({.sensors = {0.05, 0.5, 2e-4}, .inputs = {0}, .force = {0, 0, 0}});
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i] = std::array{0.05, 0.5, 2e-4}[i % 6 / 2] * random.normal();
  std::vector<double> white = rows;
  noise.whiten(white);
  CHECK_CLOSE(std::inner_product(white.begin(), white.end(), white.begin(), 0.0),
              static_cast<double>(rows.size()), 0.1, 0);
  noise.set_beyond(rows);
  const NoiseFound found = find_noise(
      recordings, setup, {.sensors = {0.05, 0.5, 2e-4}, .inputs = {1e-3}, .force = {1e5, 1, 1}}, 1,
      ForceErrors::Known);
  CHECK_CLOSE(found.sources.force[0], 1e5, 1e-12, 0);
  CHECK(found.uncertainty[4] == 0);
}

TEST_CASE("in plant: a road measured with 1 mm of noise biases neither tyre nor mass" *
          doctest::test_suite("long")) {
  // The truth is a tanh, the law an arctan; nothing is said of any noise.
  const LawModel damper = LawModel::constant(find_law("tanh_guo"), {800, 1200, 15, 0, 1, 0});
  InPlantSetup setup = car_on_measured_road(1e-3);
  const PlantRecording ride = ride_of(setup, damper, 16);
  setup.unknown = {{"sprung_mass", 100, 1000, 300},
                   {"tyre_stiffness", 1e5, 1e6, 2e5},
                   {"tyre_damping", 0, 10000, 500}};
  for (PlantSensor& sensor : setup.sensors) sensor.noise = 0;
  setup.inputs.front().noise = 0;
  const InPlantReport report =
      identify_in_plant(find_law("arctan"), setup, {ride}, {.starts = 4, .grade = ""});
  REQUIRE(report.has_models());
  const auto check_near = [&](const char* name, double truth, double within) {
    const FittedParameter& p = named_in(report.plant, name);
    CAPTURE(name);
    CAPTURE(p.value);
    CAPTURE(p.low);
    CAPTURE(p.high);
    CHECK(std::abs(p.value - truth) < p.high - p.low);  // 4 standard deviations
    CHECK_CLOSE(p.value, truth, within, 0);
  };
  check_near("sprung_mass", 387, 0.02);
  check_near("tyre_stiffness", 295200, 0.01);
  check_near("tyre_damping", 300, 0.3);
  const FittedParameter& noise = named_in(report.nuisances, "noise of road");
  CAPTURE(noise.value);
  CHECK_CLOSE(noise.value, 1e-3, 0.1, 0);
}

TEST_CASE("in plant: on a road measured with noise, intervals are as wide as estimates scatter" *
          doctest::test_suite("long")) {
  // Six rides on roads of their own; the truth is a tanh, the law an arctan.
  constexpr int kRides = 6;
  const LawModel damper = LawModel::constant(find_law("tanh_guo"), {300, 1200, 20, 0, 1, 0});
  InPlantOptions options{.starts = 4, .grade = ""};
  options.choices = {{.law = {}, .parameter = "v_h", .fixed = 0.0},
                     {.law = {}, .parameter = "a_s", .fixed = 1.0}};
  double scatter = 0, told = 0;
  int held = 0;
  for (std::uint64_t ride = 0; ride < kRides; ++ride) {
    InPlantSetup setup = car_on_measured_road(5e-4);
    const PlantRecording recording = ride_of(setup, damper, 10, 100 + 7 * ride);
    setup.known.emplace_back("tyre_damping", 300);
    setup.unknown = {{"sprung_mass", 100, 1000, 300}, {"tyre_stiffness", 1e5, 1e6, 2e5}};
    for (PlantSensor& sensor : setup.sensors) sensor.noise = 0;
    setup.inputs.front().noise = 0;
    const InPlantReport report = identify_in_plant(find_law("arctan"), setup, {recording}, options);
    REQUIRE(report.has_models());
    for (const auto& [name, value] :
         NamedValues{{"sprung_mass", 387}, {"tyre_stiffness", 295200}}) {
      const FittedParameter& p = named_in(report.plant, name);
      scatter += std::pow((p.value - value) / value, 2);
      told += std::pow((p.high - p.low) / 2 / kNormal95 / value, 2);
      held += p.low <= value && value <= p.high;
    }
  }
  CAPTURE(scatter);
  CAPTURE(told);
  CHECK(scatter < 1.5 * told);
  CHECK(scatter > told / 3);
  CHECK(held >= 10);  // of 12
}

TEST_CASE(
    "in plant: a spring that the law lacks is told, and intervals reach to where numbers go with "
    "it" *
    doctest::test_suite("long")) {
  // The truth is a tanh beside a spring of 1 kN/m, the law a tanh alone: the mass leans by 0.6 %.
  const LawModel damper = LawModel::constant(find_law("tanh_kwok"), {1200, 1000, 300, 8, 0, 0});
  InPlantSetup setup = car_on_measured_road(2e-4);
  const PlantRecording ride = ride_of(setup, damper, 16);
  setup.unknown = {{"sprung_mass", 100, 1000, 300}, {"tyre_stiffness", 1e5, 1e6, 2e5}};
  setup.known.emplace_back("tyre_damping", 300);
  for (PlantSensor& sensor : setup.sensors) sensor.noise = 0;
  setup.inputs.front().noise = 0;
  const auto identified_by = [&](const char* law) {
    return identify_in_plant(find_law(law), setup, {ride}, {.starts = 2, .grade = ""});
  };
  const auto told = [](const InPlantReport& report) {
    return std::ranges::any_of(report.warnings, [](const std::string& warning) {
      return contains(warning, "beside this law the damper shows a spring of");
    });
  };
  const InPlantReport report = identified_by("tanh_guo");
  CHECK(told(report));
  const FittedParameter& mass = named_in(report.plant, "sprung_mass");
  CAPTURE(mass.value);
  CAPTURE(mass.low);
  CAPTURE(mass.high);
  CHECK(mass.value < 386);
  CHECK(mass.high - mass.value > 1.5 * (mass.value - mass.low));
  CHECK(mass.high > 387);
  CHECK_CLOSE(mass.high, 387, 0.01, 0);

  // A law that has one is not told so.
  const InPlantReport with_spring = identified_by("tanh_kwok");
  CHECK_FALSE(told(with_spring));
  CHECK_CLOSE(named_in(with_spring.plant, "sprung_mass").value, 387, 0.01, 0);
}

TEST_CASE(
    "in plant: where the law lacks what is no spring and no dashpot, intervals reach to what the "
    "sensors tell beside any force" *
    doctest::test_suite("long")) {
  // The truth has a hysteresis and a dashpot in series, the law a tanh along velocity: the tyre
  // damping comes out too small by a tenth, and the law's own interval ends at 284 N*s/m.
  InPlantSetup setup = car_on_measured_road(2e-4);
  setup.unknown = {{"sprung_mass", 100, 1000, 300},
                   {"tyre_stiffness", 1e5, 1e6, 2e5},
                   {"tyre_damping", 0, 10000, 500}};
  for (PlantSensor& sensor : setup.sensors) sensor.noise = 0;
  setup.inputs.front().noise = 0;
  const auto identified_in_car_with = [&](const char* truth, double voltage) {
    const LawModel all = load_parameters(truth);
    std::vector<double> parameters(all.law().params.size());
    all.parameters_at(voltage, parameters.data());
    const PlantRecording ride =
        ride_of(car_on_measured_road(2e-4), LawModel::constant(all.law(), parameters), 16);
    return identify_in_plant(find_law("tanh_kwok"), setup, {ride}, {.starts = 2, .grade = ""});
  };
  const auto told = [](const InPlantReport& report) {
    return std::ranges::any_of(report.warnings, [](const std::string& warning) {
      return contains(warning, "whatever the damper's force is, the sensors tell");
    });
  };
  const InPlantReport report = identified_in_car_with("spencer1997", 2);
  REQUIRE(report.has_models());
  CHECK(told(report));
  for (const auto& [name, value] :
       NamedValues{{"sprung_mass", 387}, {"tyre_stiffness", 295200}, {"tyre_damping", 300}}) {
    const FittedParameter& p = named_in(report.plant, name);
    CAPTURE(name);
    CAPTURE(p.value);
    CAPTURE(p.low);
    CAPTURE(p.high);
    CHECK(p.low <= value);
    CHECK(p.high >= value);
    CHECK(p.high - p.low < 0.25 * value);

    // The number that leans by no law has an interval of its own, which is narrower.
    const FittedParameter& beside = named_in(report.plant_beside_any_force, name);
    CAPTURE(beside.value);
    CHECK(beside.low < value);
    CHECK(beside.high > value);
    CHECK(beside.high - beside.low < p.high - p.low);
  }

  // The plant as found has that one, with its interval.
  const InPlantSetup found = as_found(setup, report);
  REQUIRE(found.found.size() == 3);
  CHECK(found.known.back().second == report.plant_beside_any_force.back().value);
  CHECK(found.found.back().low == report.plant_beside_any_force.back().low);

  // Where the law is the damper's nothing is told.
  const InPlantReport own = identified_in_car_with("kwok2006", 1);
  CHECK_FALSE(told(own));
  CHECK(own.plant_beside_any_force.empty());
}

TEST_CASE("in plant: a ride in which nothing is told ends without a model, and says so") {
  const LawModel damper = LawModel::constant(find_law("tanh_guo"), {800, 1200, 15, 0, 1, 0});
  InPlantSetup setup = car_on_measured_road(2e-4);
  PlantRecording ride = ride_of(setup, damper, 3);
  for (Channel& channel : ride.channels)
    for (double& sample : channel.samples) sample *= 1e-100;
  setup.unknown = {{"sprung_mass", 100, 1000, 300}, {"tyre_stiffness", 1e5, 1e6, 2e5}};
  const InPlantReport report =
      identify_in_plant(find_law("viscous_dahl"), setup, {ride}, {.grade = "car"});
  CHECK_FALSE(report.has_models());
  CHECK(contains(report.message, "diverges"));
}
