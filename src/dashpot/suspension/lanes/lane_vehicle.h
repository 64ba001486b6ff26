#pragma once
#include <string>
#include <vector>

#include "dashpot/suspension/lanes/batch_vehicle.h"
#include "dashpot/suspension/lanes/lane_damper.h"

namespace dashpot {

/// The properties that vehicles must have in common to ride side by side.
struct LaneShape {
  LaneEquations equations;    ///< empty of quarter cars
  LaneDamperShape damper;     ///< of all struts
  bool resists_more = false;  ///< stops, friction or a tyre that may lift
  bool moderate = false;      ///< as LaneRide's, of quarter cars
  bool controlled = false;
  std::size_t control = kNoLaneControl;  ///< of a law that has lanes: its place in kLaneControls
  double sample_time = 0;                ///< s
  bool operator==(const LaneShape&) const = default;
};

/// One vehicle as numbers, ready to be put into rows.
struct LaneVehicle {
  LaneShape shape;
  std::vector<double> numbers, damper, start, control;  ///< as LaneRide's
};

/// The vehicle must have no reason_against_lanes().
LaneVehicle lane_vehicle(const BatchVehicle& vehicle);

}  // namespace dashpot
