// Prints the figures of docs/in-plant-measured.md: how well a damper is identified inside a plant.
//
//   bench_in_plant grey train.csv     Noel and Schoukens' benchmark, its structure known; in the
//                                     clone, whose examples/laws it reads
//   bench_in_plant black train.csv    the same, no law named
//   bench_in_plant car MODEL...       a virtual quarter car whose damper is of another structure
//   bench_in_plant minute LAW...      the same over 60 s, three numbers of the plant unknown
//   bench_in_plant stands|late|filtered MODEL...   the same behind 8 s of standing; on a road that
//   is
//                                     10 ms late; with sensors behind low-pass filters
//   bench_in_plant unmeasured TRUTH CLASS SECONDS LAW...   the same on a road that nothing measures
//   bench_in_plant named TRUTH CLASS SECONDS SEED LAW...   there, what the laws are listed by
//   bench_in_plant cover REPETITIONS TRUTH CLASS SECONDS LAW, sensors TRUTH CLASS SECONDS LAW,
//   covered REPETITIONS TRUTH CLASS SECONDS LAW NOISE, building SECONDS LAW...
//                                     see bench/without_road.cpp

#include "dashpot/machine/in_plant.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/law/law_text.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/machine/model_in_plant.h"
#include "dashpot/machine/virtual_recording.h"
#include "dashpot/numerics/filter.h"
#include "dashpot/simulate.h"
#include "dashpot/vehicle.h"
#include "without_road.h"

using namespace dashpot;

namespace {

void print_parameters(const std::vector<FittedParameter>& parameters) {
  for (const FittedParameter& p : parameters)
    if (!p.fixed)
      fmt::print("  {:<18} {:>12} {:<8} {}{}\n", p.name, format_number(p.value, 6), p.unit,
                 std::isnan(p.low) ? "no interval"
                                   : format_number(p.low, 6) + " ... " + format_number(p.high, 6),
                 p.at_bound ? "  (bound)" : "");
}

void print_report(const InPlantReport& report) {
  fmt::print(
      "{}; {} iterations, {:.1f} s of CPU, {} steps per sample, half the step changes {:.2g} "
      "of the error\n",
      report.message, report.iterations, report.seconds, report.steps, report.step_error);
  print_parameters(report.plant);
  print_parameters(report.damper);
  for (const SensorFigures& s : report.sensors)
    fmt::print("{} {}: rms {:.4g}, error {:.4g} where it was fitted, {:.4g} held back {}\n",
               s.recording, s.channel, s.rms, s.training, s.held_back, s.unit);
  for (const std::string& warning : report.warnings) fmt::print("warning: {}\n", warning);
}

/// The benchmark's recording: five periods of 8192 samples, of which the last is held back. The
/// force is known, all of the oscillator is not.
constexpr std::size_t kPeriod = 8192, kPeriods = 5;

InPlantSetup benchmark_setup() {
  InPlantSetup setup;
  setup.model = &find_machine("oscillator", "benchmark");
  setup.unknown = {{"mass", 1e-6, 1e9, {}}, {"damping", 0, 1e9, {}}, {"stiffness", 0, 1e12, {}}};
  setup.inputs = {{"excitation", {PlantInput::Force, 0}}};
  setup.sensors = {{.channel = "displacement", .place = {PlantQuantity::Displacement, 0}}};
  setup.held_back = 1.0 / kPeriods;
  setup.skip = 0.05;
  return setup;
}

/// The sensor's noise differs from period to period and what the model lacks does not: the mean
/// product of the errors of two periods is the square of what is lacking, and the spread of the
/// samples' differences is the noise.
void print_noise_and_model_error(const InPlantTrace& trace) {
  const auto error = [&](std::size_t period, std::size_t k) {
    const std::size_t at = period * kPeriod + k;
    return trace.measured[0][at] - trace.modelled[0][at];
  };
  double product = 0, products = 0, difference = 0;
  for (std::size_t k = 0; k < kPeriod; ++k) {
    double fitted = 0;
    for (std::size_t period = 1; period + 1 < kPeriods; ++period)
      fitted += error(period, k) / (kPeriods - 2);
    const double held_back = error(kPeriods - 1, k), one = fitted * held_back;
    product += one / kPeriod;
    products += one * one / kPeriod;
    difference += std::pow(held_back - error(1, k), 2) / kPeriod;
  }
  const double deviation = std::sqrt((products - product * product) / kPeriod);
  fmt::print("noise of the sensor, from the difference of two periods: {:.4g} m rms\n",
             std::sqrt(difference / 2));
  fmt::print(
      "error of the model without it: mean square {:.2g} +- {:.2g} m^2, so at most {:.2g} m "
      "rms (95 %)\n",
      product, deviation, std::sqrt(std::max(0.0, product + 1.645 * deviation)));
}

InPlantOptions quiet_options() {
  InPlantOptions options;
  options.monitor.on_progress = [](const Progress& progress) {
    fmt::print(stderr, "{:3.0f} %  {}\n", 100 * progress.fraction, progress.stage);
  };
  return options;
}

double shown_as(const InPlantReport& report, const std::string& name) {
  for (const auto* list : {&report.plant, &report.damper})
    for (const FittedParameter& p : *list)
      if (p.name == name) return p.value;
  return NAN;
}

/// The distance to the published system, both run on the same excitation by the same integrator,
/// over the period that is held back: what noise cannot hide.
double distance_to_published(const PlantRecording& recording, const InPlantReport& report) {
  const LawModel published = LawModel::constant(
      find_law("bouc_wen"), {5e4 / 120, 0, 0, 0, 1e3 * 0.8, 1e3 * -1.1, 120, 1, 0});
  const InPlantSetup setup = benchmark_setup();
  std::vector<double> response[2];
  for (const bool is_fitted : {false, true}) {
    NamedValues values = {{"mass", 2}, {"damping", 10}, {"stiffness", 5e4}};
    if (is_fitted)
      for (auto& [name, value] : values) value = shown_as(report, name);
    response[is_fitted] = plant_response(
        make_plant(*setup.model, values),
        is_fitted ? *report.kinds.front().model : static_cast<const DamperModel&>(published), setup,
        recording);
  }
  double sum = 0;
  const std::size_t first = (kPeriods - 1) * kPeriod;
  for (std::size_t k = 0; k < kPeriod; ++k)
    sum += std::pow(response[0][first + k] - response[1][first + k], 2) / kPeriod;
  return std::sqrt(sum);
}

void run_benchmark(bool grey, const std::string& path) {
  const PlantRecording recording = read_plant_recording(path, {"excitation", "displacement"});
  InPlantOptions options = quiet_options();
  if (!grey)  // the plant has a dashpot
    options.choices = {{.law = {}, .parameter = "c", .fixed = 0.0}};
  const auto law = load_law_text(std::string("examples/laws/") +
                                 (grey ? "hardening_bouc_wen.yaml" : "duhem.yaml"));
  const InPlantReport report =
      identify_in_plant(law->law(), benchmark_setup(), {recording}, options);
  print_report(report);
  print_noise_and_model_error(report.traces.front());
  if (grey) {
    // z = alpha A z_D maps the published equation onto the law: alpha A = alpha, gamma = beta gamma
    // and beta = beta delta at nu = 1.
    fmt::print(
        "as published: alpha {:.6g} (5e4) N/m, beta gamma {:.6g} (800), beta delta {:.6g} "
        "(-1100) 1/m, nu {:.4g} (1)\n",
        120 * shown_as(report, "alpha"), shown_as(report, "gamma"), shown_as(report, "beta"),
        shown_as(report, "n"));
  }
  fmt::print(
      "distance to the published system, in free run over the period held back: {:.3g} m "
      "rms\n",
      distance_to_published(recording, report));
}

/// A ride of the quarter car with a damper at one voltage.
constexpr double kRate = 500;  // Hz
const std::vector<double> kVoltages = {0, 1, 2};

VehicleWords car_words(double voltage, bool is_minute = false) {
  VehicleWords words;
  if (is_minute) words.values.push_back("tyre_damping=300 N*s/m");
  words.plant = "quarter_car";
  words.current = voltage;
  words.dampers = {"spencer1997"};
  return words;
}

Record ride(const Vehicle& car, std::uint64_t road_seed, double seconds = 10) {
  const GroundPointer road = make_ground("iso8608,class=C,speed=20m/s", road_seed);
  SimulateOptions options = car.options(seconds);
  options.output_step = 1 / kRate;
  return simulate(car.on(*road), options).record;
}

/// rms error of the damper's force over its span, %, on a road that the fit has not seen; and the
/// same with the mass that is found.
double force_error(const InPlantReport& report, bool is_minute) {
  double squares = 0, count = 0, low = INFINITY, high = -INFINITY;
  for (const double voltage : kVoltages) {
    const Record truth = ride(make_vehicle(car_words(voltage, is_minute)), 99);
    VehicleWords words = car_words(voltage);
    for (const FittedParameter& p : report.plant)
      words.values.push_back(p.name + "=" + format_exact(p.value));
    ModelFile file;
    file.model = report.kinds.front().model->with_offset(0);
    file.drive_unit = DriveUnit::Volt;
    file.domain = report.kinds.front().domain;
    const Record modelled = ride(make_vehicle(words, file), 99);
    const auto& f = truth.channel("suspension_force").samples;
    const auto& g = modelled.channel("suspension_force").samples;
    for (std::size_t k = 0; k < f.size(); ++k) {
      squares += std::pow(f[k] - g[k], 2);
      count += 1;
      low = std::min(low, f[k]);
      high = std::max(high, f[k]);
    }
  }
  return 100 * std::sqrt(squares / count) / (high - low);
}

/// From rest, so that what comes out is late.
void pass_through(const std::vector<Biquad>& sections, std::vector<double>& samples) {
  for (const Biquad& one : sections) {
    double first = 0, second = 0;
    for (double& sample : samples) {
      const double out = one.b0 * sample + first;
      first = one.b1 * sample - one.a1 * out + second;
      second = one.b2 * sample - one.a2 * out;
      sample = out;
    }
  }
}

/// The ride as a logger has it that was started while the car stood, whose road comes late, or
/// whose sensors are behind filters.
PlantRecording tampered(PlantRecording recording, const std::string& how) {
  constexpr std::size_t kStands = 4000, kLate = 5;          // samples
  constexpr double kAccelerations = 50, kDeflections = 30;  // Hz
  Random random(3);
  for (Channel& channel : recording.channels) {
    std::vector<double>& samples = channel.samples;
    const bool is_road = channel.name == "tyre_road", is_current = channel.unit == "V";
    if (how == "stands") {
      const double noise = is_current ? 0 : channel.unit == "m" ? 0.0002 : 0.05;
      std::vector<double> still;
      for (std::size_t k = 0; k < kStands; ++k)
        still.push_back(samples.front() + noise * random.normal());
      samples.insert(samples.begin(), still.begin(), still.end());
    }
    if (how == "late" && is_road)
      std::copy_backward(samples.begin(), samples.end() - kLate, samples.end());
    if (how == "filtered" && !is_road && !is_current) {
      const double level = samples.front();
      for (double& sample : samples) sample -= level;
      pass_through(butterworth_lowpass(2, channel.unit == "m" ? kDeflections : kAccelerations,
                                       recording.sample_time),
                   samples);
      for (double& sample : samples) sample += level;
    }
  }
  recording.samples = recording.channels.front().samples.size();
  return recording;
}

void run_car(const std::vector<std::string>& models, const std::string& how) {
  const bool is_minute = how == "minute";

  // Three rides at three voltages; road, two accelerations and the deflection are measured.
  std::vector<PlantRecording> recordings;
  for (std::size_t k = 0; k < kVoltages.size(); ++k) {
    recordings.push_back(virtual_recording(
        ride(make_vehicle(car_words(kVoltages[k], is_minute)), 1 + k, is_minute ? 20 : 10),
        {{"tyre_road", 0.0002},
         {"body_acceleration", 0.05},
         {"wheel_acceleration", 0.5},
         {"suspension_deflection", 0.0002},
         {"suspension_current", 0}},
        11 + k));
    recordings.back() = tampered(std::move(recordings.back()), how);
    recordings.back().name = fmt::format("{} V", kVoltages[k]);
  }

  InPlantSetup setup;
  setup.model = &find_machine("quarter_car", "car");
  setup.known = {{"unsprung_mass", 139.5}, {"spring_stiffness", 37300}};
  setup.unknown = {{"sprung_mass", 100, 1000, 300}, {"tyre_stiffness", 1e5, 1e6, 2e5}};
  if (is_minute) setup.unknown.push_back({"tyre_damping", 0, 10000, 500});
  setup.inputs = {{"tyre_road", {PlantInput::Ground, 0}}};
  setup.sensors = {{.channel = "body_acceleration", .place = {PlantQuantity::Acceleration, 0}},
                   {.channel = "wheel_acceleration", .place = {PlantQuantity::Acceleration, 1}},
                   {.channel = "suspension_deflection", .place = {PlantQuantity::Deflection, 0}}};
  setup.drives = {{.channel = "suspension_current"}};
  setup.drive_unit = DriveUnit::Volt;
  setup.skip = 0.2;
  // Each by itself, but for what learns along a law.
  std::vector<std::vector<std::string>> turns;
  if (std::ranges::all_of(models, is_law))
    for (const std::string& law : models) turns.push_back({law});
  else
    turns.push_back(models);
  for (const std::vector<std::string>& turn : turns) {
    const auto started = std::chrono::steady_clock::now();
    const std::vector<InPlantFit> fits =
        identify_in_plant(turn, setup, recordings, quiet_options());
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - started;
    fmt::print("\n{:.1f} s passed\n", passed.count());
    for (const InPlantFit& fit : fits) {
      fmt::print("\n{}{}{}\n", fit.model, fit.report.along.empty() ? "" : ", along ",
                 fit.report.along);
      print_report(fit.report);
      fmt::print("force on another road: {:.2f} % of its span, rms\n",
                 force_error(fit.report, is_minute));
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  constexpr std::array kCars{"car", "minute", "stands", "late", "filtered"};
  if (words.size() > 1 && std::ranges::find(kCars, words[0]) != kCars.end()) {
    run_car({words.begin() + 1, words.end()}, words[0]);
  } else if (words.size() == 2 && (words[0] == "grey" || words[0] == "black")) {
    run_benchmark(words[0] == "grey", words[1]);
  } else if (!run_without_road(words)) {
    fmt::print(stderr, "usage: the head of bench/in_plant.cpp names what there is\n");
    return 2;
  }
  return 0;
}
