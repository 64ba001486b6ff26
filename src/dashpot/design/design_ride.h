#pragma once
#include <memory>
#include <string>

#include "dashpot/ground_motion.h"
#include "dashpot/model_file.h"
#include "dashpot/value.h"
#include "dashpot/vehicle.h"

namespace dashpot {

/// The ride that a design can be asked about: the damper in every strut of a plant, on a ground.
struct DesignRide {
  VehicleWords vehicle;  ///< without dampers
  std::shared_ptr<const GroundMotion> ground;
  double duration = 10;  ///< s
};

/// Reads the key `ride` of a request. Throws Error at words that name nothing or do not fit
/// together, and at a plant that does not ride.
DesignRide read_design_ride(const Value& value);
/// "savaresi_spelta on ..., by skyhook"
std::string describe(const DesignRide& ride);

/// The body's weighted acceleration in the ride with this damper (ISO 2631-1, Wk), rms, m/s^2. NaN
/// where the ride diverges or the damper does not suit the controller.
double ridden_comfort(const ModelFile& damper, const DesignRide& ride);

}  // namespace dashpot
