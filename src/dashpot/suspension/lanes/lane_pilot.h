#pragma once
#include <span>
#include <vector>

#include "dashpot/suspension/control/sensors.h"
#include "dashpot/suspension/damper_state.h"
#include "dashpot/suspension/lanes/batch.h"
#include "dashpot/suspension/lanes/ride.h"

namespace dashpot {

/// The road under the vehicles of a ride in lanes, and who drives their dampers.
class LanePilot {
 public:
  /// One vehicle per lane; further lanes go as the last one's does.
  LanePilot(std::span<const BatchVehicle* const> vehicles, std::size_t lanes);
  /// Makes a ride ask this pilot.
  void take(LaneRide& ride);

 private:
  struct Driver {
    const BatchVehicle* vehicle;
    Sensors sensors;
    CommandPath path;
    std::vector<double> state;
    double resting[2];  ///< where the plant rests on ground that is 1 m higher
  };
  void ground(std::size_t lane, std::size_t first, double* heights, double* rates) noexcept;
  void control(const double* signals, double* commands, const std::int64_t* which);
  double command(Driver& driver, const double* signals, double before) const;

  std::size_t lanes_;
  std::vector<Driver> drivers_;
  FootMotion feet_[kLaneNodes];
};

}  // namespace dashpot
