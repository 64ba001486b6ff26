#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/vehicle.h"

namespace dashpot::cli {

/// The vehicle that a command works with.
struct VehicleChoice {
  std::string plant = VehicleWords{}.plant, damper, controller, inverse, force_loop;
  std::vector<std::string> values;
  double current = 0, current_max = 0,
         lag_rate = -1;               ///< A, A, 1/s; 0 and below 0: the damper's own
  double sample_time = 1, delay = 0;  ///< ms
  bool in_car = false;                ///< sensors as a car has them
  std::uint64_t seed = 1;             ///< of the road and of the sensors' noise
  bool operator==(const VehicleChoice&) const = default;
};

/// The ground that the vehicle drives over, and for how long.
struct RoadChoice {
  std::string road = "iso8608,class=C";
  double duration = 0;  ///< s; 0: as the ground has it, 20 s at most
  bool operator==(const RoadChoice&) const = default;
};

/// --plant, --set, --damper, --controller, --inverse, --force-loop, --current, --current-max,
/// --lag-rate,
/// --sample-time,
/// --in-car, --delay, --seed. A command of several controllers has its own row for them.
std::vector<Option> vehicle_options(VehicleChoice& choice);
std::vector<Option> controlled_vehicle_options(VehicleChoice& choice);
/// --road, --duration.
std::vector<Option> road_options(RoadChoice& choice);

/// The parts between semicolons: "skyhook;mix1,crossover=2Hz".
std::vector<std::string> words_between(const std::string& text);
VehicleWords words_of(const VehicleChoice& choice);
/// Throws UsageError at an option that would have no effect: one that serves a controller where
/// there is none, or a constant current where nothing keeps it. `against` is what a controlled
/// vehicle is compared with, as --against has it.
void require_effect(const VehicleChoice& choice, bool is_controlled, const std::string& against);
/// Throws Error where it suits no such plant: a road under a building.
GroundPointer ground_of(const RoadChoice& choice, std::uint64_t seed, const Plant& plant);

/// Whether left and right wheels of a car with both meet a rough road of one track: it never rolls.
bool sides_meet_one_road(const Plant& plant, const GroundMotion& ground);
/// s.
double duration_of(const RoadChoice& choice, const GroundMotion& ground);

}  // namespace dashpot::cli
