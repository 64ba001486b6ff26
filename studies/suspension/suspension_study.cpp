#include "studies/suspension/suspension_study.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/suspension/plants/linear.h"
#include "studies/suspension/study_dampers.h"

namespace dashpot {
namespace {

constexpr const char* kPlant = "tudon_martinez2012";
constexpr double kPassiveDamping = 1804;  // N*s/m, for the paper's gain at the wheel's resonance
constexpr double kCrossoverRatio = 1.75;  // of the body's resonance
constexpr double kStepHeight = 0.03, kLargeChirp = 0.02, kSmallChirp = 0.002;  // m
constexpr double kBand = 0.05;         // of settling, as a share of the peak
constexpr double kAnyDamping = 20000;  // N*s/m: next to rigid here
constexpr const char* kRoad = "iso8608,class=C,speed=20";
constexpr double kLeastDampings[] = {600,  900,  1200, 1500, 1800, 2100, 2400,
                                     2700, 3000, 3300, 3600, 3900, 4200, 4500};

std::vector<double> gain_frequencies() {
  constexpr int kCount = 80;
  std::vector<double> frequencies;
  for (int k = 0; k <= kCount; ++k) frequencies.push_back(0.5 * std::pow(40.0, double(k) / kCount));
  return frequencies;
}

/// The paper's car with a damper in it; law: a controller's words, or empty.
Vehicle make_car(const PlantSet& set, const MountedDamper& damper, const ControlLimits& limits,
                 const std::string& law) {
  Vehicle vehicle{.set = set, .limits = limits, .sensors = {}};
  vehicle.dampers.push_back(damper);
  vehicle.damper_names.emplace_back("damper");
  vehicle.domains.emplace_back();
  vehicle.controller_name = law;
  if (!law.empty()) vehicle.controller = make_controller(law, {vehicle.limits, vehicle.set.plant});
  return vehicle;
}

MountedDamper passive_damper(std::shared_ptr<const DamperModel> model) {
  MountedDamper damper;
  damper.model = std::move(model);
  return damper;
}

std::string mix1(double crossover) { return "mix1,crossover=" + format_exact(crossover); }

void add_schemes(SuspensionStudy& study, const PlantSet& set, double lag_rate) {
  // Passive references: the identified curve and the linear damper.
  const auto add = [&](std::string key, std::string title, Vehicle vehicle, bool within) {
    study.schemes.push_back({std::move(key), std::move(title), std::move(vehicle), within,
                             within ? study.damper.fastest : INFINITY});
  };
  add("passive", "passive: identified curve",
      make_car(set, passive_damper(study.passive.model), {}, ""), false);
  study.schemes.back().fastest = study.passive.fastest;
  add("linear", "passive: linear, 1804 N*s/m",
      make_car(set, mounted(damping_range(kPassiveDamping, kPassiveDamping)), {}, ""), false);

  // The identified damper with its coil's lag, under each controller.
  MountedDamper damper = passive_damper(study.damper.model);
  damper.driver = {.current_min = 0, .current_max = study.limits.current_max, .lag_rate = lag_rate};
  const auto controlled = [&](std::string key, std::string title, const std::string& law) {
    add(std::move(key), std::move(title), make_car(set, damper, study.limits, law), true);
  };
  controlled("mix1", "Mix-1-sensor", mix1(study.crossover));
  controlled("mix1-car", "Mix-1-sensor, accelerometer in the car", mix1(study.crossover));
  study.schemes.back().vehicle.sensors.in_car = true;
  controlled("skyhook", "skyhook, two states", "skyhook");
  controlled("add", "ADD", "add");
  controlled("sh_add", "SH-ADD", "sh_add,crossover=" + format_exact(study.crossover));
  controlled("groundhook", "groundhook", "groundhook");

  // Its two ends, without control.
  controlled("off", "MR2 at 0 A", "");
  controlled("on", "MR2 at 2.5 A", "");
  study.schemes.back().vehicle.dampers[0].current = study.limits.current_max;

  // An ideal damper of a wide range.
  const ControlLimits soft{.damping_min = 900, .damping_max = 4300};
  add("ideal", "Mix-1-sensor, ideal damper 900 to 4300 N*s/m",
      make_car(set, mounted(damping_range(900, 4300)), soft, mix1(study.crossover)), false);
}

Trace run(const Vehicle& vehicle, const GroundMotion& ground, double duration,
          const Monitor& monitor, double parts = 1) {
  SimulateOptions options = vehicle.options(duration);
  options.output_step /= parts;
  options.monitor = monitor;
  return simulate(vehicle.on(ground), options);
}

void read_step(SchemeRide& ride) {
  const Record& record = ride.step.record;
  const double dt = record.time[1] - record.time[0];
  const std::vector<double>& body = record.channel("body_acceleration").samples;
  double peak = 0;
  for (const double value : body) peak = std::max(peak, std::abs(value));
  ride.comfort = step_measures(body, dt, 0, kBand * peak);
  ride.holding =
      step_measures(record.channel("tyre_deflection").samples, dt, 0, kBand * kStepHeight);
  ride.travel = *std::ranges::max_element(record.channel("suspension_deflection").samples, {},
                                          [](double x) { return std::abs(x); });
}

/// Shares of the paper's chirp that its model is not made for.
void read_chirp(SchemeRide& ride, const SuspensionScheme& scheme, const Monitor& monitor) {
  const GroundPointer chirp = make_ground("chirp,amplitude=2cm", 1);
  const Trace trace = run(scheme.vehicle, *chirp, chirp->duration(), monitor);
  const std::vector<double>& velocity = trace.record.channel("suspension_velocity").samples;
  const auto fast =
      std::ranges::count_if(velocity, [&](double v) { return std::abs(v) > scheme.fastest; });
  ride.contact_lost = trace.contact_lost;
  ride.too_fast = static_cast<double>(fast) / static_cast<double>(velocity.size());
}

SchemeRide ride_of(const SuspensionScheme& scheme, const GroundMotion& road,
                   const SuspensionStudyOptions& options) {
  // Gains at two amplitudes, since the damper is not linear.
  const Vehicle& vehicle = scheme.vehicle;
  SchemeRide ride;
  ride.large = gains_by_chirp(vehicle, gain_frequencies(),
                              {.amplitude = kLargeChirp, .monitor = options.monitor});
  ride.small = gains_by_chirp(vehicle, gain_frequencies(),
                              {.amplitude = kSmallChirp, .monitor = options.monitor});
  read_chirp(ride, scheme, options.monitor);

  // The step, for its measures and its mean squares.
  const GroundPointer step = make_ground("step,height=3cm", 1);
  ride.step = run(vehicle, *step, options.step_duration, options.monitor, 4);
  read_step(ride);
  ride.on_step = ride_squares(ride.step, vehicle.set.plant);

  // The road.
  ride.on_road = ride_squares(run(vehicle, road, options.road_duration, options.monitor, 4),
                              vehicle.set.plant);
  return ride;
}

LeastDamping with_least(double least, const SuspensionStudy& study, const PlantSet& set,
                        const GroundMotion& road) {
  // Ideal dampers from this least damping to the identified one's greatest, or a fifth
  // above the least.
  const ControlLimits limits{.damping_min = least,
                             .damping_max = std::max(study.limits.damping_max, 1.2 * least)};
  const Vehicle vehicle =
      make_car(set, mounted(damping_range(limits.damping_min, limits.damping_max)), limits,
               mix1(study.crossover));

  // The small chirp, on which the tyre stays on the road, the step and the road.
  const SuspensionStudyOptions& options = study.options;
  const std::vector<GainPoint> gains = gains_by_chirp(
      vehicle, gain_frequencies(), {.amplitude = kSmallChirp, .monitor = options.monitor});
  const GroundPointer step = make_ground("step,height=3cm", 1);
  return {.least = least,
          .wheel_gain = greatest_gain(gains, &GainPoint::tyre_deflection, 0.5, 20),
          .body_gain = greatest_gain(gains, &GainPoint::body_acceleration, 0.5, 2),
          .on_step = ride_squares(run(vehicle, *step, options.step_duration, options.monitor, 4),
                                  set.plant),
          .on_road = ride_squares(run(vehicle, road, options.road_duration, options.monitor, 4),
                                  set.plant)};
}

std::vector<ClairvoyantBound> front_of(const SuspensionStudy& study, const GroundMotion& ground,
                                       const ForceRange& range, const RideSquares& reference,
                                       double duration) {
  return front_of_ride(study.plant, ground, range, reference,
                       {.duration = duration,
                        .starts = {},
                        .threads = study.options.threads,
                        .monitor = {.on_progress = {}, .stop = study.options.monitor.stop}});
}

void add_bounds(SuspensionStudy& study, const GroundMotion& road) {
  const SchemeRide& passive = study.rides.front();
  const ForceRange range =
      model_range(*study.damper.model, {.current_min = 0,
                                        .current_max = study.limits.current_max,
                                        .velocity = 2 * study.damper.fastest});
  study.road_front = front_of(study, road, range, passive.on_road, study.options.road_duration);
  const GroundPointer step = make_ground("step,height=3cm", 1);
  study.step_front = front_of(study, *step, range, passive.on_step, study.options.step_duration);
  study.any_damper =
      front_of(study, *step, damping_range(study.least_possible, study.greatest_possible),
               passive.on_step, study.options.step_duration);
}

}  // namespace

std::size_t SuspensionStudy::place(const std::string& key) const {
  const auto found = std::ranges::find(schemes, key, &SuspensionScheme::key);
  return static_cast<std::size_t>(found - schemes.begin());
}

double greatest_gain(const std::vector<GainPoint>& gains, Gain GainPoint::* signal, double from,
                     double to) {
  double top = 0;
  for (const GainPoint& point : gains)
    if (point.frequency >= from && point.frequency <= to)
      top = std::max(top, (point.*signal).fundamental);
  return top;
}

double damping_for_wheel_gain(const Plant& plant, double gain) {
  const auto greatest = [&](double damping) {
    double top = 0;
    for (double f = 1; f <= 20; f += 0.02)
      top = std::max(top, std::abs(frequency_response(plant, {damping}, f)[1] - 1.0));
    return top;
  };
  double low = 100, high = 6000;
  while (high - low > 0.5) (greatest(0.5 * (low + high)) > gain ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

SuspensionStudy study_suspension(const SuspensionStudyOptions& options) {
  const PlantSet set = load_plant_set(kPlant);
  const ParameterSet mr2 = load_parameter_set("mr2");
  SuspensionStudy study{.options = options, .plant = set.plant, .limits = {}};

  // Both dampers, side by side.
  options.monitor.report("identify the dampers", 0);
  parallel_for(2, options.threads, [&](std::size_t k) {
    (k == 0 ? study.damper : study.passive) =
        k == 0 ? identified_mr2(options.seed) : identified_passive(kPassiveDamping, options.seed);
  });

  // Limits and crossover of the controllers follow from the damper and the car.
  const ReferenceStroke stroke;
  const auto damping = [&](double current) {
    return equivalent_damping(*study.damper.model, current, stroke.amplitude, stroke.speed);
  };
  study.limits = {damping(mr2.drive_min), damping(mr2.drive_max), mr2.drive_min, mr2.drive_max,
                  1e-3};
  study.crossover = kCrossoverRatio * natural_frequencies(linear_plant(set.plant)).front();
  study.greatest_possible = kAnyDamping;
  add_schemes(study, set, mr2.model.lag_rate());

  // Every scheme and every least damping is a drive of its own.
  const GroundPointer road = make_ground(kRoad, options.seed);
  study.road = road->description();
  study.rides.resize(study.schemes.size());
  study.least_damping.resize(std::size(kLeastDampings));
  const std::size_t all = study.rides.size() + study.least_damping.size();
  std::atomic<std::size_t> done = 0;
  parallel_for(all, options.threads, [&](std::size_t k) {
    if (k < study.rides.size())
      study.rides[k] = ride_of(study.schemes[k], *road, options);
    else
      study.least_damping[k - study.rides.size()] =
          with_least(kLeastDampings[k - study.rides.size()], study, set, *road);
    options.monitor.report("drive",
                           0.1 + 0.5 * static_cast<double>(++done) / static_cast<double>(all));
  });

  // The bounds come last: they refer to the ride of the passive damper.
  options.monitor.report("bound what is possible", 0.6);
  add_bounds(study, *road);
  return study;
}

}  // namespace dashpot
