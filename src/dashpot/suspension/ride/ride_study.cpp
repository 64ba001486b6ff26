#include "dashpot/suspension/ride/ride_study.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <mutex>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/suspension/ground/deterministic.h"
#include "dashpot/suspension/ground/ground_sequences.h"

namespace dashpot {
namespace {

constexpr double kStepDuration = 5;  // s
constexpr const char* kBound = "--bound";
using SharedVehicle = std::shared_ptr<const Vehicle>;

SharedVehicle shared(const VehicleWords& words) {
  return std::make_shared<const Vehicle>(make_vehicle(words));
}

/// Every vehicle of the study: the passive one, then the controlled.
std::vector<SharedVehicle> make_vehicles(const RideStudyOptions& options,
                                         std::vector<std::string>& left_out) {
  std::vector<SharedVehicle> vehicles{shared(passive_words(options.vehicle, options.against))};
  VehicleWords words = options.vehicle;

  // The controllers that are named, or every law but "constant", which is the passive one.
  const bool all = options.controllers == std::vector<std::string>{"all"};
  std::vector<std::string> controllers = options.controllers;
  if (all) {
    controllers.clear();
    for (const ControlLaw* law : control_laws())
      if (law->name != "constant") controllers.emplace_back(law->name);
  }

  // Each once, however often it is named. Of "all", those that do not suit the vehicle are left
  // out, with the reason.
  for (const std::string& controller : controllers) {
    words.controller = controller;
    try {
      SharedVehicle vehicle = shared(words);
      if (std::ranges::none_of(vehicles, [&](const SharedVehicle& one) {
            return one->controller_name == vehicle->controller_name;
          }))
        vehicles.push_back(std::move(vehicle));
    } catch (const Error& error) {
      if (!all) throw;
      left_out.push_back(controller + " is left out: " + error.what());
    }
  }

  if (vehicles.size() == 1) throw Error(words.where, "no controller to study");
  return vehicles;
}

/// The same dampers at currents over their range, closer where they are soft.
std::vector<SharedVehicle> make_held(const RideStudyOptions& options, const ControlLimits& limits) {
  VehicleWords words = options.vehicle;
  words.controller.clear();
  words.inverse.clear();
  std::vector<SharedVehicle> vehicles;
  for (std::size_t k = 0; k < options.held; ++k) {
    const double share =
        options.held > 1 ? static_cast<double>(k) / static_cast<double>(options.held - 1) : 0;
    words.current = limits.current_min + share * share * (limits.current_max - limits.current_min);
    vehicles.push_back(shared(words));
  }
  return vehicles;
}

/// The range of the sines, finely, by equal ratios.
std::vector<double> chirp_frequencies(const std::vector<double>& sines) {
  constexpr int kPoints = 120;
  std::vector<double> f;
  for (int k = 0; k <= kPoints; ++k)
    f.push_back(sines.front() *
                std::pow(sines.back() / sines.front(), static_cast<double>(k) / kPoints));
  return f;
}

/// The runs of a study as tasks, each of which writes to a place of its own. Vehicles, options,
/// road and places must stay where they are until run() is over.
class Tasks {
 public:
  Tasks(const RideStudyOptions& options, const GroundMotion& road)
      : options_(options), road_(road), step_(step_ground(options.step_height, 0)) {}

  void add(const SharedVehicle& vehicle, RiddenVehicle& place) {
    // One task per sine.
    place.sines.resize(options_.frequencies.size());
    for (std::size_t k = 0; k < options_.frequencies.size(); ++k)
      tasks_.push_back([this, vehicle, &place, k] {
        place.sines[k] = gain_by_sine(*vehicle, options_.frequencies[k], gain_options());
      });
    tasks_.push_back([this, vehicle, &place] {
      place.chirp =
          gains_by_chirp(*vehicle, chirp_frequencies(options_.frequencies), gain_options());
    });
    tasks_.push_back([this, vehicle, &place] {
      place.road = run_vehicle(vehicle, road_, run_options(options_.road_duration));
    });
    tasks_.push_back([this, vehicle, &place] {
      place.step = run_vehicle(vehicle, *step_, run_options(kStepDuration));
    });
  }

  void add(const SharedVehicle& vehicle, TradeOff& place) {
    tasks_.push_back([this, vehicle, &place] {
      const SimulatedRun run = run_vehicle(vehicle, road_, run_options(options_.road_duration));
      place = {.setting = place.setting,
               .weighted = measure_named(run.measures, "weighted_acceleration"),
               .tyre = measure_named(run.measures, "tyre_load")};
    });
  }

  void run() {
    std::atomic<std::size_t> done = 0;
    std::mutex reporting;
    parallel_for(tasks_.size(), options_.threads, [&](std::size_t k) {
      tasks_[k]();
      const double share = static_cast<double>(++done) / static_cast<double>(tasks_.size());
      const std::lock_guard lock(reporting);
      options_.monitor.report("ride", share);
    });
  }

 private:
  /// Tasks do not report their own progress, but stop when the study is stopped.
  Monitor quiet() const { return {.on_progress = {}, .stop = options_.monitor.stop}; }
  GainOptions gain_options() const {
    GainOptions gains = options_.gains;
    gains.relative_tolerance = options_.relative_tolerance;
    gains.monitor = quiet();
    return gains;
  }
  RunOptions run_options(double duration) const {
    return {.duration = duration,
            .allowed_outside = options_.allowed_outside,
            .relative_tolerance = options_.relative_tolerance,
            .monitor = quiet()};
  }

  const RideStudyOptions& options_;
  const GroundMotion& road_;
  GroundPointer step_;
  std::vector<std::function<void()>> tasks_;
};

double integral_of(const RiddenVehicle& ridden, Gain GainPoint::* signal) {
  std::vector<double> f, gain;
  for (const GainPoint& point : ridden.sines) {
    f.push_back(point.frequency);
    gain.push_back((point.*signal).fundamental);
  }
  return gain_integral(f, gain);
}

void require_rideable(const RideStudyOptions& options, const Vehicle& vehicle) {
  if (vehicle.set.plant.tyres.empty() || vehicle.set.plant.struts.empty())
    throw Error(options.vehicle.where, vehicle.set.name + " has no tyres to ride on", "a vehicle");
  const std::vector<double>& frequencies = options.frequencies;
  const bool rises =
      std::ranges::adjacent_find(frequencies, std::greater_equal{}) == frequencies.end();
  if (frequencies.empty() || !rises || !(frequencies.front() > 0))
    throw Error(options.vehicle.where, "its frequencies do not rise from above 0");
  if (!(options.gains.amplitude > 0))
    throw Error(options.vehicle.where, "its sines have no amplitude", "an amplitude above 0");
  if (options.step_height == 0)
    throw Error(options.vehicle.where, "its step has no height", "a step up or down");

  // What would not end in a day is refused before it begins.
  constexpr double kLeastFrequency = 1e-3, kMostFrequency = 1e3;  // Hz
  constexpr std::size_t kMostHeld = 1000;
  if (frequencies.front() < kLeastFrequency || frequencies.back() > kMostFrequency)
    throw Error(options.vehicle.where,
                "its frequencies go from " + format_number(frequencies.front()) + " to " +
                    format_number(frequencies.back()) + " Hz",
                "vehicles answer between " + format_number(kLeastFrequency) + " and " +
                    format_number(kMostFrequency) + " Hz");
  if (options.held > kMostHeld)
    throw Error(options.vehicle.where,
                std::to_string(options.held) + " held currents are as many rides",
                "at most " + std::to_string(kMostHeld));
}

/// Of the strut, on the road.
StrutMotion greatest_motion(const RideStudy& study) {
  const auto of = [](const RiddenVehicle& one) {
    return strut_motion(one.road.trace, one.road.vehicle->set.plant);
  };
  StrutMotion greatest = of(study.passive);
  for (const RiddenVehicle& one : study.controlled) greatest.include(of(one));
  return greatest;
}

/// Whether a ride's forces lie in a range, but for roundings.
bool lies_within(const ForceRange& range, const SimulatedRun& run) {
  const Record& record = run.trace.record;
  const std::string& strut = run.vehicle->set.plant.struts.front().name;
  const std::vector<double>&x = record.channel(strut + "_deflection").samples,
        &v = record.channel(strut + "_velocity").samples,
        &force = record.channel(strut + "_force").samples;
  constexpr double kRounding = 1e-9;
  for (std::size_t k = 0; k < force.size(); ++k)
    if (!range.holds(x[k], v[k], force[k], kRounding * (1 + std::abs(force[k])))) return false;
  return true;
}

/// The bounds are for rides that move the damper up to this many times as far and as fast as the
/// study's own rides did, and the optima where these go further.
constexpr double kMotionFactor = 2;

void add_bound(RideStudy& study, const Vehicle& vehicle, const GroundMotion& road) {
  const Plant& plant = vehicle.set.plant;
  const RideStudyOptions& options = study.options;
  const RideSquares reference = ride_squares(study.passive.road.trace, plant);
  StrutMotion ridden = greatest_motion(study);
  constexpr int kTries = 3;
  for (int k = 0; k < kTries; ++k) {
    const ForceRange range = possible_forces(
        vehicle, {kMotionFactor * ridden.travel, kMotionFactor * ridden.speed}, kBound);
    study.bounded = motion_of(range);
    study.passive.in_range = lies_within(range, study.passive.road);
    for (RiddenVehicle& one : study.controlled) one.in_range = lies_within(range, one.road);
    study.front = front_of_ride(plant, road, range, reference,
                                {.duration = options.road_duration,
                                 .starts = {},
                                 .threads = options.threads,
                                 .monitor = options.monitor});
    if (std::ranges::none_of(study.front, &ClairvoyantBound::leaves)) return;

    // Some optimum goes beyond the range, which then has to be wider.
    for (const ClairvoyantBound& best : study.front) ridden.include(best.motion);
  }
}

}  // namespace

double comfort_integral(const RiddenVehicle& ridden) {
  return integral_of(ridden, &GainPoint::body_acceleration);
}
double holding_integral(const RiddenVehicle& ridden) {
  return integral_of(ridden, &GainPoint::tyre_deflection);
}

RideStudy study_ride(const RideStudyOptions& options) {
  RideStudy study{.options = options};

  // All that can be refused is refused before the long work.
  const std::vector<SharedVehicle> vehicles = make_vehicles(options, study.left_out);
  require_rideable(options, *vehicles.front());
  if (options.bound)
    possible_forces(*vehicles.back(), {0.1, 1}, kBound);  // throws where nothing can be proven
  const std::vector<SharedVehicle> held = make_held(options, vehicles.back()->limits);
  const GroundPointer road = make_ground(options.road, options.seed, "--road");
  if (road->shakes())
    throw Error("--road",
                "'" + options.road + "' shakes buildings, not the " + vehicles.front()->set.name,
                "a road, a bump");
  study.ground = road->description();

  // A task per run, each with a place of its own, which must not move any more.
  study.controlled.resize(vehicles.size() - 1);
  study.held.resize(held.size());
  Tasks tasks(options, *road);
  tasks.add(vehicles.front(), study.passive);
  for (std::size_t k = 1; k < vehicles.size(); ++k) tasks.add(vehicles[k], study.controlled[k - 1]);
  for (std::size_t k = 0; k < held.size(); ++k) {
    study.held[k].setting = held[k]->dampers.front().current;
    tasks.add(held[k], study.held[k]);
  }

  tasks.run();
  if (options.bound) add_bound(study, *vehicles.back(), *road);
  return study;
}

}  // namespace dashpot
