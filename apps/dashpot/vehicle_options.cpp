#include "vehicle_options.h"

#include <algorithm>
#include <cmath>

#include "damper_choice.h"
#include "dashpot/base/text.h"
#include "dashpot/suspension/ground/ground_sequences.h"

namespace dashpot::cli {
namespace {

constexpr double kOnRoad = 20;  // s
constexpr double kAfter = 5;    // s, to come to rest

}  // namespace

std::vector<Option> vehicle_options(VehicleChoice& choice) {
  return {
      // The plant and its dampers.
      {.names = "--plant",
       .target = &choice.plant,
       .help = "vehicle or building: a set, a kind of plant, or a file (--list plants)",
       .value = "NAME",
       .takes = Takes::File},
      {.names = "--set",
       .target = &choice.values,
       .help = "values in place of the plant's: sprung_mass=350kg,friction=40",
       .value = "NAME=VALUE",
       .default_text = "none"},
      {.names = "--damper",
       .target = &choice.damper,
       .help = "model file, parameter set, curve or kind (--list dampers); one for all struts, or "
               "one each, with ';' between",
       .value = "WORDS",
       .takes = Takes::File,
       .default_text = "the plant's own range, ideal"},

      // The way from a wanted force to a current.
      {.names = "--inverse",
       .target = &choice.inverse,
       .help = "from a wanted force to a current: a scheme of 'dashpot track' or a file of "
               "'dashpot invert'",
       .value = "NAME",
       .takes = Takes::File,
       .default_text = "damping in a straight line over the current"},
      {.names = "--force-loop",
       .target = &choice.force_loop,
       .help = "a PID controller that adds its correction of the force error to the force wanted "
               "of the inverse: proportional=0.5,integral=20 (or derivative)",
       .value = "WORDS",
       .default_text = "none"},

      // The current: its value without control, its greatest, and the lag of the coil.
      {.names = "--current",
       .target = &choice.current,
       .help = "constant current, A (or V, or a place from 0 to 1), where there is no controller",
       .value = "A",
       .minimum = 0},
      current_max_option(choice.current_max),
      lag_rate_option(choice.lag_rate),

      // The controller's clock and its sensors.
      {.names = "--sample-time",
       .target = &choice.sample_time,
       .help = "sample time of the controller, ms",
       .value = "MS"},
      {.names = "--in-car",
       .target = &choice.in_car,
       .help =
           "sensors as in a car: one accelerometer and one deflection per strut, noise, filters"},
      {.names = "--delay",
       .target = &choice.delay,
       .help = "delay of the sensors, ms, with --in-car",
       .value = "MS",
       .minimum = 0},
      seed_option(choice.seed)};
}

std::vector<Option> controlled_vehicle_options(VehicleChoice& choice) {
  std::vector<Option> options = vehicle_options(choice);
  options.insert(options.begin() + 3,
                 {.names = "--controller",
                  .target = &choice.controller,
                  .help = "a control law with its settings (--list controllers)",
                  .value = "WORDS",
                  .default_text = "none: the current stays"});
  return options;
}

std::vector<Option> road_options(RoadChoice& choice) {
  return {
      {.names = "--road",
       .target = &choice.road,
       .help = "road, step, sine, chirp, earthquake ... with its settings (--list roads)",
       .value = "WORDS"},
      {.names = "--duration",
       .target = &choice.duration,
       .help = "duration of the run, s",
       .value = "S",
       .minimum = 0,
       .default_text = choice.duration > 0
                           ? ""
                           : "20 on a road; to the end of a bump, chirp or earthquake and 5 more"}};
}

std::vector<std::string> words_between(const std::string& text) {
  std::vector<std::string> words;
  for (const std::string& one : split(text, ';'))
    if (!trim(one).empty()) words.emplace_back(trim(one));
  return words;
}

VehicleWords words_of(const VehicleChoice& choice) {
  VehicleWords words{.plant = choice.plant,
                     .values = choice.values,
                     .controller = choice.controller,
                     .inverse = choice.inverse,
                     .force_loop = choice.force_loop,
                     .current = choice.current,
                     .current_max = choice.current_max,
                     .lag_rate = choice.lag_rate,
                     .sample_time = choice.sample_time / 1000};

  words.dampers = words_between(choice.damper);

  // The sensors; the command line has their delay in ms.
  words.sensors.in_car = choice.in_car;
  words.sensors.delay = choice.delay / 1000;
  words.sensors.seed = choice.seed;
  return words;
}

void require_effect(const VehicleChoice& choice, bool is_controlled, const std::string& against) {
  // Without a controller no force is wanted, and nothing is sensed.
  if (!is_controlled)
    for (const auto& [option, is_said] : {std::pair{"--inverse", !choice.inverse.empty()},
                                          {"--force-loop", !choice.force_loop.empty()},
                                          {"--in-car", choice.in_car},
                                          {"--delay", choice.delay > 0}})
      if (is_said)
        throw UsageError(option, "serves a controller, and there is none",
                         "name one with --controller, or leave it out");

  if (choice.delay > 0 && !choice.in_car)
    throw UsageError("--delay", "is of the sensors of a car, and ideal ones have none",
                     "add --in-car, or leave it out");

  // With a controller, only another damper that the vehicle is compared with may keep a current.
  const bool is_kept = !against.empty() && against != "none" && !against.starts_with("current=");
  if (is_controlled && choice.current > 0 && !is_kept)
    throw UsageError("--current", "is where there is no controller, which chooses its own",
                     "leave it out");
}

GroundPointer ground_of(const RoadChoice& choice, std::uint64_t seed, const Plant& plant) {
  GroundPointer ground = make_ground(choice.road, seed, "--road");
  if (plant.tyres.empty() && !ground->shakes())
    throw Error("--road", "'" + choice.road + "' moves no building", "earthquake,file=...");
  if (plant.ground.empty() && ground->shakes())
    throw Error("--road", "'" + choice.road + "' shakes buildings, not the " + plant.name,
                "a road, a step");
  return ground;
}

bool sides_meet_one_road(const Plant& plant, const GroundMotion& ground) {
  if (!ground.is_steady() || !(ground.speed() > 0)) return false;
  if (std::ranges::all_of(plant.tyres, [](const Tyre& tyre) { return tyre.track == 0; }))
    return false;
  constexpr int kPlaces = 50;
  constexpr double kStep = 0.1;  // s
  for (int k = 1; k <= kPlaces; ++k)
    if (ground.foot(kStep * k, 0, 0).height != ground.foot(kStep * k, 1, 0).height) return false;
  return true;
}

double duration_of(const RoadChoice& choice, const GroundMotion& ground) {
  if (choice.duration > 0) return choice.duration;
  if (ground.is_steady()) return std::min(ground.duration(), kOnRoad);
  return std::isfinite(ground.duration()) ? ground.duration() + kAfter : kAfter;
}

}  // namespace dashpot::cli
