#include "dashpot/machine/comfort_ride.h"

#include <cmath>

#include "dashpot/base/read_quantity.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/ground_motion.h"
#include "dashpot/suspension/ride/simulated_run.h"
#include "dashpot/vehicle.h"

namespace dashpot {
namespace {

/// A plant with the damper in every strut, on a ground.
class ComfortRide final : public DesignRide {
 public:
  /// vehicle: without dampers; duration: s.
  ComfortRide(VehicleWords vehicle, GroundPointer ground, double duration)
      : vehicle_(std::move(vehicle)), ground_(std::move(ground)), duration_(duration) {
    require_ride();
  }

  std::string description() const override {
    return vehicle_.plant + ", " + ground_->description() + ", " + format_number(duration_) +
           " s, " +
           (vehicle_.controller.empty()
                ? "at " + format_number(vehicle_.current) + " A without a controller"
                : "by " + vehicle_.controller);
  }

  double comfort(const ModelFile& damper) const override {
    try {
      const SimulatedRun run =
          run_vehicle(std::make_shared<const Vehicle>(make_vehicle(vehicle_, damper)), *ground_,
                      {.duration = duration_});
      return unusable(run).empty() ? measure_named(run.measures, "weighted_acceleration") : NAN;
    } catch (const Error&) {
      return NAN;  // the words fit a damper, and not this one
    }
  }

 private:
  /// With the request's place in the message where there is none of this name.
  PlantSet plant() const {
    try {
      return load_plant(vehicle_);
    } catch (const Error& error) {
      throw Error(vehicle_.where, error.what());
    }
  }

  /// The words are tried with any damper.
  void require_ride() const {
    const PlantSet set = plant();
    if (set.plant.tyres.empty() || set.plant.struts.empty())
      throw Error(vehicle_.where, set.name + " has no tyres to ride on, or no strut for a damper",
                  "a car or a bus: dashpot ride --list plants");
    if (ground_->shakes())
      throw Error(vehicle_.where, "this ground shakes buildings, not the " + set.plant.name,
                  "a road, a bump");
    VehicleWords trial = vehicle_;
    trial.dampers = {"ideal"};
    trial.current = trial.current_max = 0;
    make_vehicle(trial);
  }

  VehicleWords vehicle_;
  GroundPointer ground_;
  double duration_;
};

}  // namespace

DesignRidePointer read_comfort_ride(const Value& value) {
  constexpr double kLongest = 600;
  ObjectReader reader(value, "a ride");
  VehicleWords vehicle;
  vehicle.where = value.where();
  vehicle.plant = reader.string("plant");
  vehicle.controller = reader.string("controller", "");
  const std::string road = reader.string("road", "iso8608,class=C");
  const double seed = reader.number("seed", 1);
  double duration = 10;
  const auto quantity = [&](std::string_view key, std::string_view unit, double& target) {
    if (const Value* own = reader.optional(key)) target = read_quantity(*own, unit);
  };
  quantity("current", "A", vehicle.current);
  quantity("current_max", "A", vehicle.current_max);
  quantity("duration", "s", duration);
  reader.finish();

  if (!(duration > 0 && duration <= kLongest))
    throw Error(value.where(), "the ride lasts " + format_number(duration) + " s",
                "more than 0, 600 s at most");
  if (!(seed >= 0 && seed <= 1e9 && seed == std::floor(seed)))
    throw Error(value.where(), "the seed is " + format_number(seed), "a whole number from 0 on");
  GroundPointer ground = make_ground(road, static_cast<std::uint64_t>(seed), value.where());
  return std::make_shared<ComfortRide>(std::move(vehicle), std::move(ground), duration);
}

}  // namespace dashpot
