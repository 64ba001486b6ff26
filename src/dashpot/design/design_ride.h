#pragma once
#include <memory>
#include <string>

#include "dashpot/model_file.h"
#include "dashpot/value.h"

namespace dashpot {

/// A ride that a design can be asked about. Vehicles lie beside this room, not below it: what reads
/// the words of a ride and drives it is machine/comfort_ride.h.
class DesignRide {
 public:
  virtual ~DesignRide() = default;
  /// "savaresi_spelta on ..., by skyhook"
  virtual std::string description() const = 0;
  /// The body's weighted acceleration with this damper (ISO 2631-1, Wk), rms, m/s^2. NaN where the
  /// ride diverges or the damper does not suit the controller.
  virtual double comfort(const ModelFile& damper) const = 0;
};
using DesignRidePointer = std::shared_ptr<const DesignRide>;

/// Reads the key `ride` of a request; throws Error at words that name nothing or do not fit.
using RideReader = DesignRidePointer (*)(const Value& value);

}  // namespace dashpot
