#include "dashpot/design/design_ride.h"

#include <cmath>

#include "dashpot/base/read_quantity.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/suspension/ride/simulated_run.h"

namespace dashpot {
namespace {

/// With the request's place in the message where there is none of this name.
PlantSet plant_of(const DesignRide& ride) {
  try {
    return load_plant(ride.vehicle);
  } catch (const Error& error) {
    throw Error(ride.vehicle.where, error.what());
  }
}

/// The words are tried with any damper.
void require_ride(const DesignRide& ride) {
  const std::string& where = ride.vehicle.where;
  const PlantSet set = plant_of(ride);
  if (set.plant.tyres.empty() || set.plant.struts.empty())
    throw Error(where, set.name + " has no tyres to ride on, or no strut for a damper",
                "a car or a bus: dashpot ride --list plants");
  if (ride.ground->shakes())
    throw Error(where, "this ground shakes buildings, not the " + set.plant.name, "a road, a bump");
  VehicleWords trial = ride.vehicle;
  trial.dampers = {"ideal"};
  trial.current = trial.current_max = 0;
  make_vehicle(trial);
}

}  // namespace

DesignRide read_design_ride(const Value& value) {
  constexpr double kLongest = 600;
  ObjectReader reader(value, "a ride");
  DesignRide ride;
  VehicleWords& vehicle = ride.vehicle;
  vehicle.where = value.where();
  vehicle.plant = reader.string("plant");
  vehicle.controller = reader.string("controller", "");
  const std::string road = reader.string("road", "iso8608,class=C");
  const double seed = reader.number("seed", 1);
  const auto quantity = [&](std::string_view key, std::string_view unit, double& target) {
    if (const Value* own = reader.optional(key)) target = read_quantity(*own, unit);
  };
  quantity("current", "A", vehicle.current);
  quantity("current_max", "A", vehicle.current_max);
  quantity("duration", "s", ride.duration);
  reader.finish();

  if (!(ride.duration > 0 && ride.duration <= kLongest))
    throw Error(value.where(), "the ride lasts " + format_number(ride.duration) + " s",
                "more than 0, 600 s at most");
  if (!(seed >= 0 && seed <= 1e9 && seed == std::floor(seed)))
    throw Error(value.where(), "the seed is " + format_number(seed), "a whole number from 0 on");
  ride.ground = make_ground(road, static_cast<std::uint64_t>(seed), value.where());
  require_ride(ride);
  return ride;
}

std::string describe(const DesignRide& ride) {
  return ride.vehicle.plant + ", " + ride.ground->description() + ", " +
         format_number(ride.duration) + " s, " +
         (ride.vehicle.controller.empty()
              ? "at " + format_number(ride.vehicle.current) + " A without a controller"
              : "by " + ride.vehicle.controller);
}

double ridden_comfort(const ModelFile& damper, const DesignRide& ride) {
  try {
    const SimulatedRun run =
        run_vehicle(std::make_shared<const Vehicle>(make_vehicle(ride.vehicle, damper)),
                    *ride.ground, {.duration = ride.duration});
    return unusable(run).empty() ? measure_named(run.measures, "weighted_acceleration") : NAN;
  } catch (const Error&) {
    return NAN;  // the words fit a damper, and not this one
  }
}

}  // namespace dashpot
