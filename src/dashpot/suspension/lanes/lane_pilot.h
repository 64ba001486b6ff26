#pragma once
#include <span>
#include <vector>

#include "dashpot/suspension/control/sensors.h"
#include "dashpot/suspension/dampers/damper_state.h"
#include "dashpot/suspension/lanes/batch_vehicle.h"
#include "dashpot/suspension/lanes/ride.h"
#include "dashpot/suspension/plants/plant_forces.h"

namespace dashpot {

/// Gives a ride in lanes what it needs sample by sample: the road under each vehicle, and the
/// commands of its controller, with its own sensors and way from demand to current.
class LanePilot {
 public:
  /// One vehicle per lane; further lanes go as the last one's does.
  LanePilot(std::span<const BatchVehicle* const> vehicles, std::size_t lanes);
  /// Makes a ride ask this pilot, which must outlive it.
  void take(LaneRide& ride);

 private:
  struct Driver {
    explicit Driver(const BatchVehicle& vehicle);
    const BatchVehicle* vehicle;
    PlantForces forces;
    Sensors sensors;
    std::vector<CommandPath> paths;  ///< one per strut
    std::vector<double> state;       ///< of the controller
    // Room for command(): what the controller sees, strut by strut, and what it wants.
    std::vector<StrutSignals> signals;
    std::vector<DamperDemand> demands;
    std::vector<double> x, heights, resting;
  };
  // LaneRide::ground and LaneRide::control.
  void ground(std::size_t lane, std::size_t first, double* heights, double* rates) noexcept;
  void control(const double* signals, double* commands, const std::int64_t* which);
  /// signals and commands: of this driver's lane, in rows.
  void command(Driver& driver, const double* signals, double* commands) const;

  std::size_t lanes_;
  std::vector<Driver> drivers_;
  FootMotion feet_[kLaneNodes];  ///< room for ground()
};

}  // namespace dashpot
