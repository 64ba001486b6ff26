#pragma once
#include <string>
#include <vector>

#include "dashpot/suspension/lanes/batch_vehicle.h"
#include "dashpot/suspension/lanes/ride.h"

namespace dashpot {

/// What vehicles must have in common to ride side by side.
struct LaneShape {
  LaneDamperKind kind = LaneDamperKind::Network;
  LaneNetwork network;
  std::size_t law = 0;
  std::size_t lags = 0;
  bool resists_more = false, controlled = false;
  double sample_time = 0;
  bool operator==(const LaneShape&) const = default;
};

/// One vehicle as numbers.
struct LaneVehicle {
  LaneShape shape;
  QuarterCarNumbers<double> numbers;
  std::vector<double> damper, start;  ///< as LaneRide's
};

/// Only of one that reason_against_lanes() has nothing against.
LaneVehicle lane_vehicle(const BatchVehicle& vehicle);

}  // namespace dashpot
