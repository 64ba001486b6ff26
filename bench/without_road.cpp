#include "without_road.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include <fmt/format.h>

#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/damper/law_side.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/law_unknowns.h"
#include "dashpot/machine/in_plant.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/suspension/ground/road_profile.h"

using namespace dashpot;

namespace {

constexpr double kBody = 387, kTyre = 295200, kTyreDamping = 300;  // kg, N/m, N*s/m: the truth
const std::vector<double> kLevels = {0, 1, 2};

/// The car as its user knows it, on a road of this class (or "unknown"), with these sensors.
InPlantSetup car(const std::string& road_class, const std::vector<std::string>& sensors) {
  std::string text =
      "plant: quarter_car\n"
      "parameters:\n"
      "  unsprung_mass: 139.5 kg\n"
      "  spring_stiffness: 37300 N/m\n"
      "  sprung_mass: {about: 300 kg, from: 100 kg, to: 1000 kg}\n"
      "  tyre_stiffness: {about: 200 kN/m, from: 100 kN/m, to: 1000 kN/m}\n"
      "inputs:\n"
      "  - {kind: ground, class: " +
      road_class +
      ", speed: 20 m/s}\n"
      "voltage: coil\n"
      "sensors:\n";
  for (const std::string& sensor : sensors) {
    if (sensor == "body")
      text += "  - {channel: body, quantity: acceleration, at: body, noise: 0.05}\n";
    if (sensor == "wheel")
      text += "  - {channel: wheel, quantity: acceleration, at: wheel, noise: 0.05}\n";
    if (sensor == "level")
      text += "  - {channel: level, quantity: deflection, noise: 0.2 mm, delay: 2 ms}\n";
  }
  return parse_in_plant_setup(text, "car");
}

/// The same with its true numbers.
InPlantSetup true_car(InPlantSetup setup) {
  setup.unknown.clear();
  setup.known.insert(setup.known.end(), {{"sprung_mass", kBody}, {"tyre_stiffness", kTyre}});
  return setup;
}

/// A parameter set by its name; or "asymmetric": spencer1997 that resists extension more than
/// compression, as dampers of cars do; or "smooth": a tanh_guo about as strong; or "leaping": a
/// tanh_kwok, likewise, whose force leaps by 60 N at 0 V and by 210 at 2 V.
std::unique_ptr<LawModel> true_damper(const std::string& name) {
  if (name == "smooth")
    return std::make_unique<LawModel>(
        find_law("tanh_guo"),
        Dependence{.forms = {Form::Linear, Form::Linear, Form::Constant, Form::Constant,
                             Form::Constant, Form::Constant},
                   .coefficients = {{150, 500}, {700, 300}, {20}, {0.05}, {0.02}, {0}}},
        DriveUnit::Volt, 0);
  if (name == "leaping")
    return std::make_unique<LawModel>(
        find_law("tanh_kwok"),
        Dependence{
            .forms = {Form::Linear, Form::Linear, Form::Quadratic, Form::Constant, Form::Linear,
                      Form::Constant},
            .coefficients = {{700, 300}, {5000, -400}, {150, 500, -20}, {40}, {0.2, -0.05}, {0}}},
        DriveUnit::Volt, 0);
  if (name != "asymmetric") return std::make_unique<LawModel>(load_parameters(name));
  const LawModel alike = load_parameters("spencer1997");
  Dependence parameters = alike.parameters();
  for (const double rebound : {200.0, 700.0, 0.05}) {  // N, N*s/m, m/s
    parameters.forms.push_back(Form::Constant);
    parameters.coefficients.push_back({rebound});
  }
  return std::make_unique<LawModel>(with_side(alike.law()), std::move(parameters), DriveUnit::Volt,
                                    alike.lag_rate());
}

std::string road_of(const std::string& road_class) {
  return "iso8608,class=" + road_class + ",speed=20m/s";
}

PlantRecording as_recording(const VirtualRide& ride) {
  return {.name = ride.recorded.name,
          .sample_time = ride.recorded.sample_time,
          .samples = ride.recorded.size(),
          .channels = ride.recorded.channels};
}

/// Two tracks of class C whose coherence is exp(-2 pi n width), which no isotropic surface of this
/// spectrum has, as a file.
void write_tracks(const std::string& path, double length, double width, std::uint64_t seed) {
  constexpr double kLeast = 0.011, kGreatest = 2.83, kSpacing = 0.05;
  constexpr int kWaves = 1000;
  constexpr double kStep = (kGreatest - kLeast) / kWaves;
  Random random(seed);
  std::vector<RoadWave> left, right;
  for (int k = 0; k < kWaves; ++k) {
    const double n = kLeast + kStep * (k + random.uniform()),
                 amplitude = wave_amplitude(road_roughness('C'), n, kStep),
                 shared = std::exp(-kTurn * n * width);
    left.push_back({amplitude, n, random.uniform(0, kTurn)});
    right.push_back({shared * amplitude, n, left.back().phase});
    right.push_back({std::sqrt(1 - shared * shared) * amplitude, n, random.uniform(0, kTurn)});
  }
  std::string text = "distance [m],left [m],distance [m],right [m]\n";
  for (double s = 0; s < length; s += kSpacing)
    text += fmt::format("{0:.9g},{1:.9g},{0:.9g},{2:.9g}\n", s, height_at(left, s),
                        height_at(right, s));
  std::ofstream(path) << text;
}

/// Rides at each level on such tracks, so far apart.
std::vector<PlantRecording> exponential_rides(const InPlantSetup& truth, const DamperModel& damper,
                                              double width, double seconds, std::uint64_t seed) {
  constexpr double kSpeed = 20;  // m/s
  const std::string path =
      std::filesystem::temp_directory_path() / fmt::format("tracks_{}.csv", seed);
  std::vector<PlantRecording> recordings;
  for (const double level : kLevels) {
    const std::uint64_t own = seed + 1000 * recordings.size();
    write_tracks(path, kSpeed * seconds + 1, width, own);
    const VirtualCampaignOptions options{.duration = seconds,
                                         .levels = {level},
                                         .road = "measured,file=" + path + ",speed=20m/s",
                                         .seed = own};
    recordings.push_back(as_recording(virtual_campaign(truth, damper, options).front()));
    recordings.back().name = "ride_" + std::to_string(recordings.size());
  }
  std::filesystem::remove(path);
  return recordings;
}

std::vector<PlantRecording> rides(const InPlantSetup& truth, const DamperModel& damper,
                                  const std::string& road, double seconds, std::uint64_t seed) {
  const VirtualCampaignOptions options{
      .duration = seconds, .levels = kLevels, .road = road, .seed = seed};
  std::vector<PlantRecording> recordings;
  for (const VirtualRide& ride : virtual_campaign(truth, damper, options))
    recordings.push_back(as_recording(ride));
  return recordings;
}

double found(const InPlantReport& report, const std::string& name) {
  for (const FittedParameter& p : report.plant)
    if (p.name == name) return p.value;
  return NAN;
}

/// rms error of the damper's force over its span at each level, %, where both plants run free under
/// the same input.
std::vector<double> force_errors(const InPlantSetup& truth, const DamperModel& damper,
                                 const InPlantSetup& found, const DamperModel& model,
                                 const VirtualCampaignOptions& options) {
  const auto truly = virtual_campaign(truth, damper, options);
  const auto modelled = virtual_campaign(found, model, options);
  std::vector<double> errors;
  for (std::size_t r = 0; r < truly.size(); ++r) {
    const auto& f = truly[r].truth.channel("damper_force").samples;
    const auto& g = modelled[r].truth.channel("damper_force").samples;
    double square = 0;
    for (std::size_t k = 0; k < f.size(); ++k)
      square += std::pow(f[k] - g[k], 2) / static_cast<double>(f.size());
    const auto [low, high] = std::ranges::minmax(f);
    errors.push_back(100 * std::sqrt(square) / (high - low));
  }
  return errors;
}

/// The damper's force in free run, plant and all, on roads of another seed: rms error over span at
/// each level, %.
std::vector<double> force_errors(const InPlantReport& report, const DamperModel& damper,
                                 const InPlantSetup& setup, const std::string& road_class) {
  return force_errors(true_car(setup), damper, as_found(setup, report), *report.kinds.front().model,
                      {.duration = 10,
                       .levels = kLevels,
                       .road = "iso8608,class=" + road_class + ",speed=20m/s",
                       .seed = 9000});
}
std::string joined(const std::vector<double>& values) {
  std::string text;
  for (const double value : values)
    text += fmt::format("{}{:.2f}", text.empty() ? "" : ", ", value);
  return text;
}

/// The same in words; that it diverges, where it does.
std::string shown_errors(const InPlantReport& report, const DamperModel& damper,
                         const InPlantSetup& setup, const std::string& road_class) {
  try {
    return joined(force_errors(report, damper, setup, road_class));
  } catch (const Error& error) {
    return error.what();
  }
}

/// Error one sample ahead on the time held back over the rms of the signal, %: the worst sensor.
double worst_sensor(const InPlantReport& report) {
  double worst = 0;
  for (const SensorFigures& s : report.sensors) worst = std::max(worst, 100 * s.held_back / s.rms);
  return worst;
}

void print_fit(const InPlantReport& report) {
  fmt::print("{}; {} iterations, {:.1f} s of CPU, {} steps per sample\n", report.message,
             report.iterations, report.seconds, report.steps);
  for (const auto* list : {&report.plant, &report.damper, &report.nuisances})
    for (const FittedParameter& p : *list)
      if (!p.fixed)
        fmt::print("  {:<32} {:>12} {:<8} {} ... {}{}{}\n", p.name, format_number(p.value, 6),
                   p.unit, format_number(p.low, 6), format_number(p.high, 6),
                   p.at_bound ? "  (bound)" : "", p.weak ? "  (weak)" : "");
  if (!report.knowable.singular_values.empty())
    fmt::print("singular values {:.3g} ... {:.3g}\n", report.knowable.singular_values.front(),
               report.knowable.singular_values.back());
  for (const std::string& warning : report.warnings) fmt::print("warning: {}\n", warning);
}

InPlantOptions told_options() {
  InPlantOptions options;
  options.asymmetric = true;
  options.monitor.on_progress = [](const Progress& progress) {
    fmt::print(stderr, "{:3.0f} %  {}\n", 100 * progress.fraction, progress.stage);
  };
  return options;
}

/// unmeasured TRUTH CLASS SECONDS LAW...: fits in full.
void run_unmeasured(const std::string& truth, const std::string& road_class, double seconds,
                    const std::vector<std::string>& laws) {
  const std::unique_ptr<LawModel> damper = true_damper(truth);
  const InPlantSetup setup = car(road_class, {"body", "wheel", "level"});
  const auto recordings = rides(true_car(setup), *damper, road_of(road_class), seconds / 3, 1);
  for (const std::string& law : laws) {
    const InPlantReport report =
        identify_in_plant(find_law(law), setup, recordings, told_options());
    fmt::print("\n{} in a car with {}, class {}, {} s\n", law, truth, road_class, seconds);
    print_fit(report);
    if (!report.has_models()) continue;
    for (const std::string& other : std::vector<std::string>{"B", "C", "D"})
      fmt::print("force on another road, class {}, at 0, 1, 2 V: {} % of its span, rms\n", other,
                 shown_errors(report, *damper, setup, other));
    std::fflush(stdout);
  }
}

/// named TRUTH CLASS SECONDS SEED LAW...: what the laws are listed by, beside how well each truly
/// does.
void run_named(const std::string& truth, const std::string& road_class, double seconds,
               std::uint64_t seed, const std::vector<std::string>& laws) {
  const std::unique_ptr<LawModel> damper = true_damper(truth);
  const InPlantSetup setup = car(road_class, {"body", "wheel", "level"});
  const auto recordings = rides(true_car(setup), *damper, road_of(road_class), seconds / 3, seed);
  for (const std::string& law : laws) {
    InPlantOptions options;
    options.asymmetric = true;
    const InPlantReport report = identify_in_plant(find_law(law), setup, recordings, options);
    if (!report.has_models()) {
      fmt::print("{}, {}: {}\n", truth, law, report.message);
      continue;
    }
    fmt::print(
        "{}, {}: force error {:.0f} N, worst sensor {:.1f} %, body {:.0f} kg, force on another "
        "road at 0, 1, 2 V {} % of its span{}\n",
        truth, law, report.force_error, worst_sensor(report), found(report, "sprung_mass"),
        shown_errors(report, *damper, setup, road_class),
        report.lacks.empty() ? "" : ", lacks a " + report.lacks);
    std::fflush(stdout);
  }
}

/// How often intervals hold the truth.
class Coverage {
 public:
  void add(const FittedParameter& p, double truth) {
    if (p.fixed) return;
    auto one = std::ranges::find(counts_, p.name, &Count::name);
    if (one == counts_.end()) one = counts_.insert(one, {p.name, 0, 0, 0, 0, 0});
    one->inside += truth >= p.low && truth <= p.high;
    one->of += 1;
    one->error += (p.value - truth) / truth;
    one->worst = std::max(one->worst, std::abs(p.value / truth - 1));
    one->half += (p.high - p.low) / 2 / std::abs(truth);
  }
  void print() const {
    for (const Count& one : counts_)
      fmt::print(
          "{:<24} {:>3} of {} (95 % intervals); mean error {:+.2f} %, half interval {:.2f} %\n",
          one.name, one.inside, one.of, 100 * one.error / one.of, 100 * one.half / one.of);
  }
  void print_share() const {
    int inside = 0, of = 0;
    for (const Count& one : counts_) {
      inside += one.inside;
      of += one.of;
    }
    if (of > 0) fmt::print("all: {} of {}, {:.1f} %\n", inside, of, 100.0 * inside / of);
  }
  /// By how much a number was off at worst, over the truth.
  double worst(const std::string& name) const {
    const auto one = std::ranges::find(counts_, name, &Count::name);
    return one == counts_.end() ? 0 : one->worst;
  }

 private:
  struct Count {
    std::string name;
    int inside, of;
    double error, half, worst;
  };
  std::vector<Count> counts_;
};

/// The law's numbers as a fit names them, of the true damper, where it is of the same law.
std::vector<LawUnknowns::Coefficient> true_coefficients(const LawModel& damper,
                                                        const InPlantReport& report) {
  if (report.kinds.front().model->law_inside()->law().name != damper.law().name) return {};
  if (report.kinds.front().model->law_inside()->law().params.size() != damper.law().params.size())
    return {};
  DataScale scale;
  scale.drive = {kLevels.front(), kLevels.back(), false, kLevels.size()};
  const LawUnknowns unknowns(damper.law(), scale, DriveUnit::Volt, OffsetMode::Record);
  return unknowns.coefficients(unknowns.of(damper));
}

/// Fits of one vehicle, each on drives of another seed.
struct CoverPlan {
  InPlantSetup setup, truth;
  const LawModel& damper;
  std::string road;  ///< on which it truly drives
  double seconds;
  std::string law;
  int repetitions;
  InPlantOptions options = {};
  std::uint64_t first_seed = 5000;
  double exponential = 0;  ///< m; where above 0, its tracks are such in the place of `road`
};

/// How often their intervals held the plant's and the damper's numbers.
struct Covered {
  Coverage plant, damper;
  double cpu = 0;  ///< s of each
};

std::string found_words(const FittedParameter& p) {
  return fmt::format("{} {} ({} ... {})", p.name, format_number(p.value, 5),
                     format_number(p.low, 5), format_number(p.high, 5));
}

/// Counts those coefficients of the damper for which `counts` holds.
template <class Counts>
Covered cover(const CoverPlan& plan, const Counts& counts) {
  Covered covered;
  for (int k = 0; k < plan.repetitions; ++k) {
    const std::uint64_t seed = plan.first_seed + 7 * static_cast<std::uint64_t>(k);
    const InPlantReport report = identify_in_plant(
        find_law(plan.law), plan.setup,
        plan.exponential > 0
            ? exponential_rides(plan.truth, plan.damper, plan.exponential, plan.seconds / 3, seed)
            : rides(plan.truth, plan.damper, plan.road, plan.seconds / 3, seed),
        plan.options);
    covered.cpu += report.seconds / plan.repetitions;

    // The plant's numbers, those that are found told on the way.
    fmt::print(stderr, "{}: {}", k, report.message);
    for (const FittedParameter& p : report.plant)
      for (const auto& [name, value] : plan.truth.known)
        if (p.name == name) {
          covered.plant.add(p, value);
          fmt::print(stderr, ", {}", found_words(p));
        }
    for (const FittedParameter& p : report.nuisances)
      if (p.name == "track width of the road") fmt::print(stderr, ", {}", found_words(p));
    fmt::print(stderr, "\n");
    if (plan.repetitions == 1) print_fit(report);

    // The damper's.
    if (!report.has_models()) continue;
    for (const auto& c : true_coefficients(plan.damper, report))
      for (const FittedParameter& p : report.damper)
        if (p.name == c.name && counts(c)) covered.damper.add(p, c.value);
  }
  return covered;
}

/// cover REPETITIONS TRUTH CLASS SECONDS LAW
void run_cover(int repetitions, const std::string& truth, const std::string& road_class,
               double seconds, const std::string& law) {
  const std::unique_ptr<LawModel> damper = true_damper(truth);
  const InPlantSetup setup = car(road_class, {"body", "wheel", "level"});
  InPlantOptions options;
  options.asymmetric = truth == "asymmetric";
  const Covered covered = cover(
      {setup, true_car(setup), *damper, road_of(road_class), seconds, law, repetitions, options},
      [](const auto&) { return true; });
  fmt::print(
      "{} in a car with {}, class {}, {} s, {} repetitions; {:.1f} s of CPU each, body mass "
      "at worst {:.2f} % off\n",
      law, truth, road_class, seconds, repetitions, covered.cpu,
      100 * covered.plant.worst("sprung_mass"));
  covered.plant.print();
  covered.plant.print_share();
  covered.damper.print();
  covered.damper.print_share();
}

/// The car on a road that is measured with noise, with three numbers to be found.
InPlantSetup measured_car(double road_noise) {
  InPlantSetup setup = car("C", {"body", "wheel", "level"});
  setup.inputs = {{"road", {PlantInput::Ground, 0}, road_noise}};
  setup.unknown.push_back({"tyre_damping", 0, 10000, 500});
  for (PlantSensor& sensor : setup.sensors) sensor.delay = 0;
  setup.sensors[1].noise = 0.5;
  return setup;
}

/// covered REPETITIONS TRUTH CLASS SECONDS LAW NOISE: where the road is measured with so many mm of
/// noise; nothing of the noise is stated. What is 0 in truth is not counted, nor the V0 of
/// tanh_guo, which counts in the stroke of the data.
void run_covered(int repetitions, const std::string& truth, const std::string& road_class,
                 double seconds, const std::string& law, double millimetres) {
  const std::unique_ptr<LawModel> damper = true_damper(truth);
  const InPlantSetup noisy = measured_car(millimetres / 1000);
  InPlantSetup true_setup = true_car(noisy);
  true_setup.known.emplace_back("tyre_damping", kTyreDamping);
  InPlantSetup setup = noisy;
  for (PlantSensor& sensor : setup.sensors) sensor.noise = 0;
  setup.inputs.front().noise = 0;
  setup.skip = 0.2;

  InPlantOptions options;
  options.grade = "";
  const Covered covered =
      cover({setup, true_setup, *damper, road_of(road_class), seconds, law, repetitions, options},
            [](const LawUnknowns::Coefficient& c) { return c.value != 0 && c.name != "V0"; });
  fmt::print(
      "{} in a car with {}, class {} measured with {} mm of noise, {} s, {} repetitions; {:.1f} s "
      "of CPU each\n",
      law, truth, road_class, millimetres, seconds, repetitions, covered.cpu);
  covered.plant.print();
  covered.plant.print_share();
  covered.damper.print();
  covered.damper.print_share();
}

/// sensors TRUTH CLASS SECONDS LAW: which of them suffice.
void run_sensors(const std::string& truth, const std::string& road_class, double seconds,
                 const std::string& law) {
  const std::unique_ptr<LawModel> damper = true_damper(truth);
  fmt::print("| sensors | body mass, kg | tyre, N/m | force on another road, % | remark |\n");
  const std::vector<std::vector<std::string>> sets = {{"body", "wheel", "level"},
                                                      {"body", "wheel"},
                                                      {"body", "level"},
                                                      {"wheel", "level"},
                                                      {"body"}};
  for (const std::vector<std::string>& sensors : sets) {
    const InPlantSetup setup = car(road_class, sensors);
    std::string row = "| " + join(sensors, ", ") + " | ";
    try {
      const InPlantReport report = identify_in_plant(
          find_law(law), setup,
          rides(true_car(setup), *damper, road_of(road_class), seconds / 3, 1), {});
      for (const FittedParameter& p : report.plant)
        row +=
            fmt::format("{} ({} ... {}){} | ", format_number(p.value, 4), format_number(p.low, 4),
                        format_number(p.high, 4), p.weak ? " weak" : "");
      row += (report.has_models() ? shown_errors(report, *damper, setup, road_class) : "") + " | ";
      row += report.message + " |";
    } catch (const Error& error) {
      row += "refused: " + std::string(error.what()) + " |";
    }
    fmt::print("{}\n", row);
    std::fflush(stdout);
  }
}

/// building SECONDS LAW...: three storeys, half scale, the base's motion measured, from the floors'
/// accelerations alone.
void run_building(double seconds, const std::vector<std::string>& laws) {
  InPlantSetup setup = parse_in_plant_setup(
      "plant: building\n"
      "parameters:\n"
      "  storeys: 3\n"
      "  mass: 1000 kg\n"
      "  stiffness: {about: 1.5 MN/m, from: 0.5 MN/m, to: 5 MN/m}\n"
      "  damping: {about: 500 N*s/m, from: 0, to: 10000 N*s/m}\n"
      "inputs: [{channel: base, kind: ground_acceleration, noise: 0.02}]\n"
      "sensors:\n"
      "  - {channel: first, quantity: acceleration, at: floor_1, noise: 0.05}\n"
      "  - {channel: second, quantity: acceleration, at: floor_2, noise: 0.05}\n"
      "  - {channel: third, quantity: acceleration, at: floor_3, noise: 0.05, delay: 2 ms}\n"
      "voltage: coil\n",
      "building");
  InPlantSetup truth = setup;
  truth.unknown.clear();
  truth.known.insert(truth.known.end(), {{"stiffness", 2e6}, {"damping", 800}});
  const std::unique_ptr<LawModel> damper = true_damper("spencer1997");
  VirtualCampaignOptions options{
      .duration = seconds / 3, .levels = kLevels, .road = "", .push = 2, .seed = 1};
  std::vector<PlantRecording> recordings;
  for (const VirtualRide& ride : virtual_campaign(truth, *damper, options))
    recordings.push_back(as_recording(ride));
  options.seed = 9000;
  options.duration = 10;
  for (const std::string& law : laws) {
    const InPlantReport report =
        identify_in_plant(find_law(law), setup, recordings, told_options());
    fmt::print("\n{} in a building with spencer1997, {} s\n", law, seconds);
    print_fit(report);
    for (const SensorFigures& s : report.sensors)
      fmt::print("{} {}: rms {:.4g}, error {:.4g} where it was fitted, {:.4g} held back {}\n",
                 s.recording, s.channel, s.rms, s.training, s.held_back, s.unit);
    if (report.has_models())
      fmt::print("force under another base motion at 0, 1, 2 V: {} % of its span, rms\n",
                 joined(force_errors(truth, *damper, as_found(setup, report),
                                     *report.kinds.front().model, options)));
    std::fflush(stdout);
  }
}

/// A half car as its user knows it; in truth its rear meets the road that its front met.
InPlantSetup half_car(const std::string& road_class) {
  return parse_in_plant_setup(
      "plant: half_car\n"
      "parameters:\n"
      "  mass: {about: 600 kg, from: 400 kg, to: 1000 kg}\n"
      "  inertia: {about: 1000 kg*m^2, from: 500 kg*m^2, to: 2500 kg*m^2}\n"
      "  front_wheel_mass: 40 kg\n"
      "  rear_wheel_mass: 45 kg\n"
      "  front_stiffness: 17 N/mm\n"
      "  rear_stiffness: 22 N/mm\n"
      "  front_tyre_stiffness: {about: 150 kN/m}\n"
      "  rear_tyre_stiffness: {about: 150 kN/m}\n"
      "  front_distance: 1.3 m\n"
      "  rear_distance: 1.5 m\n"
      "inputs:\n"
      "  - {kind: ground, at: front, class: " +
          road_class +
          ", speed: 20 m/s}\n"
          "  - {kind: ground, at: rear, class: " +
          road_class +
          ", speed: 20 m/s}\n"
          "sensors:\n"
          "  - {channel: body, quantity: acceleration, at: body, noise: 0.05}\n"
          "  - {channel: pitch, quantity: velocity, at: pitch, noise: 5e-3}\n"
          "  - {channel: front, quantity: acceleration, at: front_wheel, noise: 0.05}\n"
          "  - {channel: rear, quantity: acceleration, at: rear_wheel, noise: 0.05}\n"
          "  - {channel: level_front, quantity: deflection, at: front, noise: 0.2 mm}\n"
          "  - {channel: level_rear, quantity: deflection, at: rear, noise: 0.2 mm}\n"
          "voltage: coil\n",
      "half car");
}
const NamedValues kHalfCar = {{"mass", 690},
                              {"inertia", 1222},
                              {"front_tyre_stiffness", 200e3},
                              {"rear_tyre_stiffness", 200e3}};

/// half REPETITIONS TRUTH CLASS SECONDS LAW: how often a half car's intervals hold the truth.
void run_half(int repetitions, const std::string& truth, const std::string& road_class,
              double seconds, const std::string& law) {
  const std::unique_ptr<LawModel> damper = true_damper(truth);
  const InPlantSetup setup = half_car(road_class);
  const std::string true_class = road_class == "unknown" ? "C" : road_class;
  InPlantSetup true_setup = setup;
  true_setup.unknown.clear();
  true_setup.known.insert(true_setup.known.end(), kHalfCar.begin(), kHalfCar.end());
  InPlantOptions options;
  options.asymmetric = truth == "asymmetric";
  const Covered covered =
      cover({setup, true_setup, *damper, road_of(true_class), seconds, law, repetitions, options},
            [](const auto&) { return false; });
  fmt::print("{} in a half car with {}, class {}, {} s, {} repetitions; {:.1f} s of CPU each\n",
             law, truth, road_class, seconds, repetitions, covered.cpu);
  covered.plant.print();
  covered.plant.print_share();
}

/// A full car as its user knows it, without those sensors whose names begin so.
InPlantSetup full_car(const std::vector<std::string>& without) {
  InPlantSetup setup = parse_in_plant_setup(
      "plant: full_car\n"
      "parameters:\n"
      "  mass: {about: 1300 kg}\n"
      "  pitch_inertia: {about: 1900 kg*m^2}\n"
      "  roll_inertia: {about: 600 kg*m^2}\n"
      "  wheel_mass: 59 kg\n"
      "  front_stiffness: 35 kN/m\n"
      "  rear_stiffness: 38 kN/m\n"
      "  tyre_stiffness: {about: 150 kN/m}\n"
      "  front_distance: 1.4 m\n"
      "  rear_distance: 1.7 m\n"
      "  front_track: 1.5 m\n"
      "  rear_track: 1.5 m\n"
      "inputs:\n"
      "  - {kind: ground, at: front_left, class: C, speed: 20 m/s}\n"
      "  - {kind: ground, at: front_right, class: C, speed: 20 m/s}\n"
      "  - {kind: ground, at: rear_left, class: C, speed: 20 m/s}\n"
      "  - {kind: ground, at: rear_right, class: C, speed: 20 m/s}\n"
      "sensors:\n"
      "  - {channel: body, quantity: acceleration, at: body, noise: 0.05}\n"
      "  - {channel: pitch, quantity: velocity, at: pitch, noise: 5e-3}\n"
      "  - {channel: roll, quantity: velocity, at: roll, noise: 5e-3}\n"
      "  - {channel: wheel_fl, quantity: acceleration, at: front_left_wheel, noise: 0.05}\n"
      "  - {channel: wheel_fr, quantity: acceleration, at: front_right_wheel, noise: 0.05}\n"
      "  - {channel: wheel_rl, quantity: acceleration, at: rear_left_wheel, noise: 0.05}\n"
      "  - {channel: wheel_rr, quantity: acceleration, at: rear_right_wheel, noise: 0.05}\n"
      "  - {channel: level_fl, quantity: deflection, at: front_left, noise: 0.2 mm}\n"
      "  - {channel: level_fr, quantity: deflection, at: front_right, noise: 0.2 mm}\n"
      "  - {channel: level_rl, quantity: deflection, at: rear_left, noise: 0.2 mm}\n"
      "  - {channel: level_rr, quantity: deflection, at: rear_right, noise: 0.2 mm}\n"
      "voltage: coil\n",
      "full car");
  for (const std::string& name : without)
    std::erase_if(setup.sensors,
                  [&](const PlantSensor& sensor) { return sensor.channel.starts_with(name); });
  return setup;
}
const NamedValues kFullCar = {
    {"mass", 1500}, {"pitch_inertia", 2160}, {"roll_inertia", 460}, {"tyre_stiffness", 190e3}};

/// full REPETITIONS SEED TRUTH SECONDS LAW TRACKS WITHOUT...: the same of a full car, on tracks of
/// an isotropic surface so many m apart (0: one and the same), or below 0 on those of
/// write_tracks().
void run_full(int repetitions, std::uint64_t seed, const std::string& truth, double seconds,
              const std::string& law, double tracks, const std::vector<std::string>& without) {
  const std::unique_ptr<LawModel> damper = true_damper(truth);
  const InPlantSetup setup = full_car(without);
  InPlantSetup true_setup = setup;
  true_setup.unknown.clear();
  true_setup.known.insert(true_setup.known.end(), kFullCar.begin(), kFullCar.end());
  InPlantOptions options;
  options.asymmetric = truth == "asymmetric";
  const std::string road = road_of("C") + fmt::format(",track_width={}m", std::max(tracks, 0.0));
  const Covered covered =
      cover({setup, true_setup, *damper, road, seconds, law, repetitions, options, seed, -tracks},
            [](const auto&) { return false; });
  fmt::print(
      "{} in a full car with {}, tracks {} m apart, {} s, {} repetitions{}; {:.1f} s of CPU "
      "each\n",
      law, truth, tracks, seconds, repetitions,
      without.empty() ? "" : ", without " + join(without, ", "), covered.cpu);
  covered.plant.print();
  covered.plant.print_share();
}

}  // namespace

bool run_without_road(const std::vector<std::string>& words) {
  if (words.size() >= 5 && words[0] == "unmeasured") {
    run_unmeasured(words[1], words[2], std::stod(words[3]), {words.begin() + 4, words.end()});
    return true;
  }
  if (words.size() >= 6 && words[0] == "named") {
    run_named(words[1], words[2], std::stod(words[3]), std::stoull(words[4]),
              {words.begin() + 5, words.end()});
    return true;
  }
  if (words.size() == 6 && words[0] == "cover") {
    run_cover(std::stoi(words[1]), words[2], words[3], std::stod(words[4]), words[5]);
    return true;
  }
  if (words.size() == 6 && words[0] == "half") {
    run_half(std::stoi(words[1]), words[2], words[3], std::stod(words[4]), words[5]);
    return true;
  }
  if (words.size() >= 7 && words[0] == "full") {
    run_full(std::stoi(words[1]), std::stoull(words[2]), words[3], std::stod(words[4]), words[5],
             std::stod(words[6]), {words.begin() + 7, words.end()});
    return true;
  }
  if (words.size() == 7 && words[0] == "covered") {
    run_covered(std::stoi(words[1]), words[2], words[3], std::stod(words[4]), words[5],
                std::stod(words[6]));
    return true;
  }
  if (words.size() >= 3 && words[0] == "building") {
    run_building(std::stod(words[1]), {words.begin() + 2, words.end()});
    return true;
  }
  if (words.size() == 5 && words[0] == "sensors") {
    run_sensors(words[1], words[2], std::stod(words[3]), words[4]);
    return true;
  }
  return false;
}
