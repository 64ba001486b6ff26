#include "dashpot/machine/in_plant.h"

#include <numbers>

#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/law/law_text.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/error.h"
#include "dashpot/machine/between_samples.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/plant_residuals.h"
#include "dashpot/machine/virtual_recording.h"
#include "dashpot/simulate.h"
#include "dashpot/suspension/ground/deterministic.h"
#include "dashpot/vehicle.h"
#include "support.h"

using namespace dashpot;

namespace {

/// The truth of the tests: a mass on a spring and a Bouc-Wen hysteresis, integrated by Heun's
/// method in steps of 10 us, which shares nothing with the library's integrator.
struct TrueOscillator {
  double mass = 2, stiffness = 4000, damping = 12, alpha = 150, A = 120, gamma = 3e4, beta = 1e4;

  void rates(double force, double w, const double* y, double* dy) const {
    const double x = y[0] - w, v = y[1], z = y[2];
    dy[0] = v;
    dy[1] = (force - stiffness * x - damping * v - alpha * z) / mass;
    dy[2] = A * v - gamma * std::abs(v) * z * std::abs(z) - beta * v * z * z;
  }
};

double multisine(double t) {
  double sum = 0;
  for (int k = 1; k <= 12; ++k)
    sum += std::cos(2 * std::numbers::pi * 1.3 * k * t + 0.7 * k * k) * (k < 8 ? 14 : 8);
  return sum;
}

PlantRecording recording_of(const TrueOscillator& truth, double seconds, double noise) {
  constexpr double kStep = 1e-5;
  constexpr int kEvery = 250;  // 400 Hz
  PlantRecording recording{.name = "truth", .sample_time = kStep * kEvery, .channels = {}};
  recording.channels = {{.name = "push", .unit = "N", .samples = {}, .origin = {}},
                        {.name = "x", .unit = "m", .samples = {}, .origin = {}},
                        {.name = "a", .unit = "m/s^2", .samples = {}, .origin = {}}};
  Random random(5);
  double y[3] = {}, first[3], second[3], there[3];
  for (int k = 0; k < static_cast<int>(seconds / kStep); ++k) {
    const double t = kStep * k;
    truth.rates(multisine(t), 0, y, first);
    if (k % kEvery == 0) {
      recording.channels[0].samples.push_back(multisine(t));
      recording.channels[1].samples.push_back(y[0] + 3e-4 + noise * random.normal());
      recording.channels[2].samples.push_back(first[1] + 2000 * noise * random.normal());
    }
    for (int i = 0; i < 3; ++i) there[i] = y[i] + kStep * first[i];
    truth.rates(multisine(t + kStep), 0, there, second);
    for (int i = 0; i < 3; ++i) y[i] += kStep / 2 * (first[i] + second[i]);
  }
  recording.samples = recording.channels[0].samples.size();
  return recording;
}

InPlantSetup oscillator_setup() {
  InPlantSetup setup;
  setup.model = &find_machine("oscillator", "test");
  setup.known = {{"stiffness", 4000}};
  setup.unknown = {{"mass", 1e-3, 1e3, {}}};
  setup.inputs = {{"push", {PlantInput::Force, 0}}};
  setup.sensors = {{.channel = "x", .place = {PlantQuantity::Displacement, 0}}};
  setup.skip = 0.1;
  return setup;
}

const FittedParameter& named(const std::vector<FittedParameter>& list, const std::string& name) {
  return *std::ranges::find(list, name, &FittedParameter::name);
}

void check_covers(const FittedParameter& p, double truth) {
  CAPTURE(p.name);
  CAPTURE(p.value);
  CAPTURE(p.low);
  CAPTURE(p.high);
  const double half = (p.high - p.low) / 2;
  CHECK(half > 0);
  CHECK(std::abs(p.value - truth) < 2 * half);  // 4 standard deviations
}

const PlantRecording& short_recording() {
  static const PlantRecording kRecording = recording_of({}, 5, 2e-5);
  return kRecording;
}

/// The same with the displacement behind a filter of the second order, in steps of a fiftieth of a
/// sample.
PlantRecording behind_filter(double cutoff) {
  constexpr int kFiner = 50;
  const double w = 2 * std::numbers::pi * cutoff;
  PlantRecording recording = short_recording();
  const double step = recording.sample_time / kFiner;
  const FinerSignal finer =
      band_limited(recording.channels[1].samples, recording.sample_time, kFiner);
  double out = finer.value.front(), rate = 0;
  for (std::size_t k = 0; k < finer.value.size(); ++k) {
    if (k % kFiner == 0) recording.channels[1].samples[k / kFiner] = out;
    rate += step * w * (w * (finer.value[k] - out) - std::numbers::sqrt2 * rate);
    out += step * rate;
  }
  return recording;
}

/// A quarter car with the modified Bouc-Wen damper spencer1997, or with another one, on a road of
/// class C.
Record car_ride(double voltage, std::uint64_t seed, const ModelFile* damper = nullptr) {
  VehicleWords words;
  words.plant = "quarter_car";
  words.current = voltage;
  words.dampers = {"spencer1997"};
  const Vehicle car = damper ? make_vehicle(words, *damper) : make_vehicle(words);
  const GroundPointer road = make_ground("iso8608,class=C,speed=20m/s", seed);
  SimulateOptions options = car.options(8);
  options.output_step = 0.002;
  return simulate(car.on(*road), options).record;
}

/// At two voltages.
std::vector<PlantRecording> car_rides() {
  std::vector<PlantRecording> recordings;
  for (const double voltage : {0.0, 2.0})
    recordings.push_back(virtual_recording(car_ride(voltage, 1),
                                           {{"tyre_road", 2e-4},
                                            {"body_acceleration", 0.05},
                                            {"wheel_acceleration", 0.5},
                                            {"suspension_deflection", 2e-4},
                                            {"suspension_current", 0}},
                                           3));
  return recordings;
}

InPlantSetup car_setup() {
  InPlantSetup setup;
  setup.model = &find_machine("quarter_car", "test");
  setup.known = {{"unsprung_mass", 139.5}, {"spring_stiffness", 37300}, {"tyre_stiffness", 295200}};
  setup.unknown = {{"sprung_mass", 100, 1000, 300}};
  setup.inputs = {{"tyre_road", {PlantInput::Ground, 0}}};
  setup.sensors = {{.channel = "body_acceleration", .place = {PlantQuantity::Acceleration, 0}},
                   {.channel = "wheel_acceleration", .place = {PlantQuantity::Acceleration, 1}},
                   {.channel = "suspension_deflection", .place = {PlantQuantity::Deflection, 0}}};
  setup.drives = {{.channel = "suspension_current"}};
  setup.drive_unit = DriveUnit::Volt;
  setup.skip = 0.2;
  return setup;
}

}  // namespace

TEST_CASE("between samples: a sine at a fifth of the rate and its derivative; straight lines") {
  constexpr double kDt = 0.01, kOmega = 2 * std::numbers::pi * 20;
  std::vector<double> samples;
  for (int k = 0; k < 200; ++k) samples.push_back(1 + std::sin(kOmega * kDt * k));
  const FinerSignal finer = band_limited(samples, kDt, 8);
  REQUIRE(finer.value.size() == 199 * 8 + 1);
  for (std::size_t k = 8 * 40; k < 8 * 160; ++k) {
    const double t = kDt / 8 * static_cast<double>(k);
    CHECK_CLOSE(finer.value[k], 1 + std::sin(kOmega * t), 0, 2e-5);
    CHECK_CLOSE(finer.rate[k], kOmega * std::cos(kOmega * t), 0, 1e-3 * kOmega);
  }
  const FinerSignal lines = straight_lines(std::vector<double>{0, 1, -1}, 0.5, 4);
  CHECK(lines.value[2] == 0.5);
  CHECK(lines.value[8] == -1);
  CHECK(lines.rate[5] == -4);
  const std::vector<double> late = delayed(samples, kDt, 0.004);
  CHECK_CLOSE(late[100], 1 + std::sin(kOmega * (kDt * 100 - 0.004)), 0, 2e-5);
}

TEST_CASE("in plant: mass and Bouc-Wen of an oscillator from its displacement, within intervals" *
          doctest::test_suite("long")) {
  const InPlantReport report = identify_in_plant(find_law("bouc_wen"), oscillator_setup(),
                                                 {short_recording()}, {.starts = 6, .grade = ""});
  CAPTURE(report.message);
  REQUIRE(report.status == FitReport::Status::Converged);
  const TrueOscillator truth;
  check_covers(named(report.plant, "mass"), truth.mass);
  check_covers(named(report.damper, "alpha"), truth.alpha);
  check_covers(named(report.damper, "c0"), truth.damping);
  check_covers(named(report.damper, "k0"), 0);
  check_covers(named(report.damper, "gamma"), truth.gamma);
  check_covers(named(report.damper, "beta"), truth.beta);
  CHECK_CLOSE(named(report.plant, "mass").value, truth.mass, 0.01, 0);

  // What is left over on the time held back is the sensor's noise, and the offset is found.
  CHECK_CLOSE(report.sensors[0].held_back, 2e-5, 0.1, 0);
  CHECK_CLOSE(report.sensors[0].offset, 3e-4, 0.05, 0);
  CHECK(report.step_error < 0.05);
  CHECK(report.knowable.confounded.empty());
}

TEST_CASE("in plant: what runs away has no residuals, however finite its numbers are") {
  InPlantSetup setup = oscillator_setup();
  const PlantCases cases = make_cases(setup, {short_recording()}, 1, PlantMethod::StraightForce);
  const auto has_residuals = [&](double damping) {
    const auto damper = std::make_shared<LawModel>(
        LawModel::constant(find_law("bingham"), std::vector{damping, 3.0, 0.0, 0.01}));
    const PlantResiduals residuals(setup, cases, {damper}, {2}, {});
    const LeastSquaresProblem problem = residuals.problem();
    std::vector<double> r(problem.residuals);
    const bool has = problem.residual(residuals.start({2}), r);
    CHECK(std::ranges::all_of(r, [](double value) { return std::isfinite(value); }));
    return has;
  };
  CHECK(has_residuals(10));
  CHECK_FALSE(has_residuals(-100));  // the mass goes off by e^25 each second
}

TEST_CASE("in plant: the same bits on any number of threads" * doctest::test_suite("long")) {
  InPlantOptions options{.starts = 2, .threads = 1, .grade = ""};
  const InPlantReport one =
      identify_in_plant(find_law("dahl"), oscillator_setup(), {short_recording()}, options);
  options.threads = 3;
  const InPlantReport three =
      identify_in_plant(find_law("dahl"), oscillator_setup(), {short_recording()}, options);
  CHECK(one.sensors[0].held_back == three.sensors[0].held_back);
  CHECK(named(one.plant, "mass").value == named(three.plant, "mass").value);
}

TEST_CASE("in plant: an acceleration that is late and a displacement, weighed by their noise" *
          doctest::test_suite("long")) {
  InPlantSetup setup = oscillator_setup();
  setup.sensors.push_back(
      {.channel = "a", .place = {PlantQuantity::Acceleration, 0}, .finds_delay = true});
  PlantRecording recording = short_recording();
  recording.channels[2].samples =
      delayed(recording.channels[2].samples, recording.sample_time, 0.003);
  const InPlantReport report =
      identify_in_plant(find_law("bouc_wen"), setup, {recording}, {.starts = 3, .grade = ""});
  REQUIRE(report.has_models());
  CHECK_CLOSE(named(report.nuisances, "delay of a").value, 0.003, 0.05, 0);
  CHECK_CLOSE(named(report.plant, "mass").value, 2, 0.02, 0);
  CHECK_CLOSE(report.sensors[0].held_back, 2e-5, 0.2, 0);
}

TEST_CASE("in plant: a sensor that is the other way round is told" * doctest::test_suite("long")) {
  InPlantSetup setup = oscillator_setup();
  setup.sensors.push_back({.channel = "a", .place = {PlantQuantity::Acceleration, 0}, .noise = 1});
  setup.sensors[0].noise = 2e-5;
  PlantRecording recording = short_recording();
  for (double& value : recording.channels[2].samples) value = -value;
  const InPlantReport report =
      identify_in_plant(find_law("bouc_wen"), setup, {recording}, {.starts = 3, .grade = ""});
  REQUIRE(report.has_models());
  CHECK(std::ranges::any_of(report.warnings, [](const std::string& warning) {
    return contains(warning, "a: shows -") && contains(warning, "the other way round?");
  }));
}

TEST_CASE("in plant: what comes late is found out unasked, and the mass with it" *
          doctest::test_suite("long")) {
  constexpr std::size_t kLate = 8;  // samples of 2.5 ms
  PlantRecording recording = short_recording();
  std::vector<double>& x = recording.channels[1].samples;
  std::copy_backward(x.begin(), x.end() - kLate, x.end());
  InPlantSetup setup = oscillator_setup();
  setup.unknown[0].about = 1.5;
  const InPlantReport report =
      identify_in_plant(find_law("bouc_wen"), setup, {recording}, {.grade = ""});
  REQUIRE(report.has_models());
  CHECK_CLOSE(report.plant[0].value, 2, 0.01, 0);
  CHECK_CLOSE(named(report.nuisances, "delay of x").value, 0.02, 0.02, 0);
  CHECK(contains(report.warnings.back(), "not at one time: delay of x 20"));
  CHECK(as_found(setup, report).sensors[0].delay == named(report.nuisances, "delay of x").value);

  // What the plant states stays.
  setup.sensors[0].delay = 1e-4;
  const InPlantReport stated =
      identify_in_plant(find_law("bouc_wen"), setup, {recording}, {.grade = ""});
  CHECK(std::ranges::find(stated.nuisances, "delay of x", &FittedParameter::name) ==
        stated.nuisances.end());
}

TEST_CASE("in plant: a sensor behind a filter that the plant states" *
          doctest::test_suite("long")) {
  InPlantSetup setup = oscillator_setup();
  setup.sensors[0].filter = {30, 2};
  const InPlantReport report = identify_in_plant(find_law("bouc_wen"), setup, {behind_filter(30)},
                                                 {.starts = 6, .grade = ""});
  REQUIRE(report.has_models());
  CHECK_CLOSE(named(report.plant, "mass").value, 2, 0.01, 0);
  CHECK_CLOSE(named(report.damper, "c0").value, 12, 0.1, 0);
}

TEST_CASE("in plant: a sensor behind a filter whose cut-off is found, or told to be none" *
          doctest::test_suite("long")) {
  InPlantSetup setup = oscillator_setup();
  setup.sensors[0].finds_cutoff = CutoffRange{};
  const auto fit = [&](const PlantRecording& recording) {
    return identify_in_plant(find_law("bouc_wen"), setup, {recording}, {.starts = 2, .grade = ""});
  };
  const InPlantReport report = fit(behind_filter(30));
  REQUIRE(report.has_models());
  const FittedParameter& cutoff = named(report.nuisances, "cut-off of x");
  CHECK(cutoff.unit == "Hz");
  check_covers(cutoff, 30);
  CHECK_CLOSE(cutoff.value, 30, 0.02, 0);
  CHECK(cutoff.high - cutoff.low < 2);
  CHECK_CLOSE(named(report.plant, "mass").value, 2, 0.01, 0);
  CHECK(as_found(setup, report).sensors[0].filter == SensorFilter{cutoff.value, 2});
  CHECK_FALSE(as_found(setup, report).sensors[0].finds_cutoff);

  // None is as far as the samples tell.
  const InPlantReport none = fit(short_recording());
  REQUIRE(none.has_models());
  CHECK_CLOSE(named(none.plant, "mass").value, 2, 0.01, 0);
  CHECK(std::isinf(named(none.nuisances, "cut-off of x").high));
  CHECK(named(none.nuisances, "cut-off of x").low > 100);
  CHECK(std::ranges::any_of(none.warnings, [](const std::string& warning) {
    return contains(warning, "cut-off of x: nothing tells it from no filter");
  }));
}

TEST_CASE("in plant: a delay and a filter of one sensor that cannot be told apart are named" *
          doctest::test_suite("long")) {
  InPlantSetup setup = oscillator_setup();
  setup.sensors[0].finds_delay = true;
  setup.sensors[0].finds_cutoff = CutoffRange{};
  const InPlantReport report = identify_in_plant(find_law("bouc_wen"), setup, {short_recording()},
                                                 {.starts = 3, .grade = ""});
  REQUIRE(report.has_models());
  CHECK(named(report.nuisances, "delay of x").weak);
  CHECK(std::ranges::any_of(report.warnings, [](const std::string& warning) {
    return contains(warning, "delay of x and cut-off of x cannot be told apart");
  }));
}

TEST_CASE("in plant: where nothing fits, no number seems certain") {
  PlantRecording recording = short_recording();
  std::ranges::reverse(recording.channels[0].samples);  // another push than the one that moved it
  InPlantSetup setup = oscillator_setup();
  setup.unknown[0].about = 2;
  const InPlantReport report =
      identify_in_plant(find_law("tanh_guo"), setup, {recording}, {.starts = 2, .grade = ""});
  REQUIRE(report.has_models());
  CHECK(std::ranges::any_of(report.warnings, [](const std::string& warning) {
    return contains(warning, "neither numbers nor intervals can be relied on");
  }));
  CHECK_FALSE(has_interval(report.plant.front()));
}

TEST_CASE("in plant: what cannot be told apart is named, before and after the fit" *
          doctest::test_suite("long")) {
  InPlantSetup setup = oscillator_setup();
  setup.known.clear();
  setup.unknown.push_back({"stiffness", 0, 1e6, 4000});  // beside the law's own spring k0
  const InPlantReport report = identify_in_plant(find_law("bouc_wen"), setup, {short_recording()},
                                                 {.starts = 3, .grade = ""});
  REQUIRE(report.knowable.confounded.size() == 1);
  const std::vector<std::string>& group = report.knowable.confounded[0];
  CHECK(std::ranges::count(group, "stiffness") == 1);
  CHECK(std::ranges::count(group, "k0") == 1);
  CHECK(named(report.plant, "stiffness").weak);
  CHECK(named(report.damper, "k0").weak);
  CHECK_FALSE(named(report.plant, "mass").weak);
}

TEST_CASE("in plant: refuses what cannot serve, before any work") {
  const auto refused = [](const InPlantSetup& setup, const PlantRecording& recording,
                          const InPlantOptions& options = {}) {
    return message_of(
        [&] { identify_in_plant(find_law("bouc_wen"), setup, {recording}, options); });
  };
  PlantRecording still = short_recording();
  std::ranges::fill(still.channels[0].samples, 3.0);
  CHECK(contains(refused(oscillator_setup(), still), "push: is constant: nothing moves the plant"));
  PlantRecording broken = short_recording();
  std::ranges::fill(broken.channels[1].samples, 0.0);
  CHECK(contains(refused(oscillator_setup(), broken), "x: is constant"));

  // A form over a current that never changes.
  CHECK(contains(refused(oscillator_setup(), short_recording(),
                         {.choices = {{.law = {}, .parameter = "alpha", .form = Form::Linear}}}),
                 "form of alpha: cannot be told: the drive is 0"));

  InPlantSetup setup = oscillator_setup();
  setup.sensors[0].channel = "push";
  CHECK(contains(refused(setup, short_recording()), "push: is both an input and a sensor"));
  setup = oscillator_setup();
  setup.unknown[0].name = "mas";
  CHECK(contains(refused(setup, short_recording()), "'mas'"));
  setup = oscillator_setup();
  setup.known.emplace_back("mass", 2);
  CHECK(contains(refused(setup, short_recording()), "mass: is stated twice"));
  setup = oscillator_setup();
  setup.inputs[0].place.kind = PlantInput::GroundAcceleration;
  CHECK(contains(refused(setup, short_recording()), "not one that shakes with its ground"));
  setup = oscillator_setup();
  setup.sensors.clear();
  CHECK(contains(refused(setup, short_recording()), "no sensor is stated"));
  setup = oscillator_setup();
  setup.held_back = 0.89;
  setup.skip = 0.5;
  CHECK(contains(refused(setup, short_recording()), "samples to fit; at least 200"));
}

TEST_CASE("in plant: a building's damper from its floors' accelerations on shaking ground") {
  // The truth is integrated by the suspension's own integrator, with the error controlled.
  VehicleWords words;
  words.plant = "building";
  words.values = {"storeys=2"};
  words.dampers = {"jansen_dyke2000"};
  words.current = 2;
  const Vehicle building = make_vehicle(words);
  std::vector<double> shaken;
  for (int k = 0; k < 1500; ++k) shaken.push_back(0.02 * multisine(0.004 * k));
  const GroundPointer ground = shaking_ground("multisine", 0.004, shaken);
  SimulateOptions options = building.options(5.9);
  options.output_step = 0.004;
  const Record trace = simulate(building.on(*ground), options).record;

  // Accelerometers show what is absolute, the trace what is relative to the ground.
  PlantRecording recording = virtual_recording(
      trace, {{"ground_acceleration", 0}, {"floor_1_acceleration", 0}, {"floor_2_acceleration", 0}},
      1);
  for (std::size_t s = 1; s < 3; ++s)
    for (std::size_t k = 0; k < recording.samples; ++k)
      recording.channels[s].samples[k] += recording.channels[0].samples[k];
  InPlantSetup setup;
  setup.model = &find_machine("building", "test");
  setup.known = {{"storeys", 2}, {"mass", 98.3}, {"damping", 50}};
  setup.unknown = {{"stiffness", 1e5, 1e7, 5e5}};
  setup.inputs = {{"ground_acceleration", {PlantInput::GroundAcceleration, 0}}};
  setup.sensors = {{.channel = "floor_1_acceleration", .place = {PlantQuantity::Acceleration, 0}},
                   {.channel = "floor_2_acceleration", .place = {PlantQuantity::Acceleration, 1}}};
  const InPlantReport report =
      identify_in_plant(find_law("viscous_dahl"), setup, {recording}, {.starts = 6, .grade = ""});
  REQUIRE(report.has_models());
  CHECK_CLOSE(named(report.plant, "stiffness").value, 6.84e5, 0.03, 0);
  for (const SensorFigures& sensor : report.sensors) {
    CAPTURE(sensor.held_back);
    CHECK(sensor.held_back < 0.1 * sensor.rms);
  }
}

TEST_CASE("in plant: a virtual quarter car whose damper is of another structure" *
          doctest::test_suite("long")) {
  const std::vector<PlantRecording> recordings = car_rides();
  const InPlantSetup setup = car_setup();
  const InPlantReport report =
      identify_in_plant(find_law("tanh_kwok"), setup, recordings, {.starts = 4, .grade = ""});
  REQUIRE(report.has_models());
  CHECK_CLOSE(named(report.plant, "sprung_mass").value, 387, 0.03, 0);

  // The damper's force on another road.
  ModelFile file;
  file.model = report.kinds.front().model->with_offset(0);
  file.drive_unit = DriveUnit::Volt;
  file.domain = report.kinds.front().domain;
  for (const double voltage : {0.0, 2.0}) {
    const Record truth = car_ride(voltage, 9);
    const Record modelled = car_ride(voltage, 9, &file);
    const std::vector<double>& f = truth.channel("suspension_force").samples;
    const std::vector<double>& g = modelled.channel("suspension_force").samples;
    double squares = 0;
    for (std::size_t k = 0; k < f.size(); ++k) squares += (f[k] - g[k]) * (f[k] - g[k]);
    const auto [low, high] = std::ranges::minmax(f);
    CHECK(std::sqrt(squares / static_cast<double>(f.size())) < 0.02 * (high - low));
  }
}

TEST_CASE("in plant: filters are found out unasked, and delays stay delays" *
          doctest::test_suite("long")) {
  const InPlantSetup setup = car_setup();
  const auto fit = [&](const auto& sensor) {
    std::vector<PlantRecording> recordings = car_rides();
    recordings.resize(1);  // what depends on the voltage is fitted above
    for (PlantRecording& recording : recordings)
      for (const PlantSensor& one : setup.sensors) {
        std::vector<double>& samples =
            std::ranges::find(recording.channels, one.channel, &Channel::name)->samples;
        samples = sensor(samples, recording.sample_time);
      }
    return identify_in_plant(find_law("tanh_kwok"), setup, recordings, {.starts = 2, .grade = ""});
  };
  const InPlantReport filtered = fit([](const std::vector<double>& samples, double sample_time) {
    return behind({40, 2}, samples, sample_time);
  });
  REQUIRE(filtered.has_models());
  CHECK_CLOSE(named(filtered.nuisances, "cut-off of wheel_acceleration").value, 40, 0.02, 0);
  CHECK_CLOSE(named(filtered.nuisances, "cut-off of suspension_deflection").value, 40, 0.02, 0);
  CHECK(contains(filtered.warnings.back(),
                 "the sensor wheel_acceleration is as if behind a low-pass of"));
  const InPlantSetup found = as_found(setup, filtered);
  CHECK_CLOSE(found.sensors[1].filter.cutoff, 40, 0.02, 0);
  CHECK(found.sensors[1].delay == 0);

  const InPlantReport late = fit([](const std::vector<double>& samples, double sample_time) {
    return delayed(samples, sample_time, 0.006);
  });
  REQUIRE(late.has_models());
  CHECK_CLOSE(named(late.nuisances, "delay of wheel_acceleration").value, 0.006, 0.02, 0);
  CHECK(contains(late.warnings.back(), "not at one time: delay of"));
}

TEST_CASE("in plant: Noel and Schoukens' benchmark, all parameters unknown" *
          doctest::test_suite("long")) {
  const std::filesystem::path data = shared_data("bouc-wen-benchmark");
  if (data.empty()) return;
  PlantRecording recording =
      read_plant_recording(data / "train.csv", {"excitation", "displacement"});
  recording.samples = 2 * 8192;  // two of its five periods
  for (Channel& channel : recording.channels) channel.samples.resize(recording.samples);
  InPlantSetup setup;
  setup.model = &find_machine("oscillator", "test");
  setup.unknown = {{"mass", 1e-6, 1e9, {}}, {"damping", 0, 1e9, {}}, {"stiffness", 0, 1e12, {}}};
  setup.inputs = {{"excitation", {PlantInput::Force, 0}}};
  setup.sensors = {{.channel = "displacement", .place = {PlantQuantity::Displacement, 0}}};
  setup.held_back = 0.2;
  setup.skip = 0.05;
  InPlantOptions options{.starts = 4, .grade = ""};
  const auto hardening = load_law_text(project_file("examples/laws/hardening_bouc_wen.yaml"));
  const InPlantReport report = identify_in_plant(hardening->law(), setup, {recording}, options);
  REQUIRE(report.has_models());
  CHECK_CLOSE(named(report.plant, "mass").value, 2, 0.001, 0);
  CHECK_CLOSE(named(report.plant, "damping").value, 10, 0.01, 0);
  CHECK_CLOSE(named(report.plant, "stiffness").value, 5e4, 0.001, 0);
  CHECK_CLOSE(120 * named(report.damper, "alpha").value, 5e4, 0.002, 0);
  CHECK_CLOSE(named(report.damper, "gamma").value, 800, 0.005, 0);
  CHECK_CLOSE(named(report.damper, "beta").value, -1100, 0.005, 0);
  CHECK(report.sensors[0].held_back < 7.5e-6);  // the noise that the recording holds is 7.4e-6

  // Without the law's name: the rms over the noise grows by less than 1e-6 m does.
  options.choices = {{.law = {}, .parameter = "c", .fixed = 0.0}};
  const auto duhem = load_law_text(project_file("examples/laws/duhem.yaml"));
  const InPlantReport black = identify_in_plant(duhem->law(), setup, {recording}, options);
  REQUIRE(black.has_models());
  CHECK(black.sensors[0].held_back < 7.5e-6);
}
