#pragma once
#include <string>

#include "dashpot/simulate.h"

namespace dashpot {

/// One vehicle of a batch: what simulate() takes. All that `setting` refers to must outlive the
/// batch; vehicles may share it.
struct BatchVehicle {
  Setting setting;
  ControlLimits limits;
  SensorOptions sensors;
};

/// s between the samples of a vehicle: its controller's, or 1 ms.
double sample_time_of(const BatchVehicle& vehicle);

/// Why a vehicle cannot ride in lanes, as a clause: "its road jumps"; empty where it can.
std::string reason_against_lanes(const BatchVehicle& vehicle);

}  // namespace dashpot
