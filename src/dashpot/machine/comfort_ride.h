#pragma once
#include "dashpot/design/design_ride.h"

namespace dashpot {

/// The ride of a design request (docs/design.md): the damper in every strut of a plant, on a road,
/// under a controller or at one current. Throws Error at words that name nothing or do not fit
/// together, and at a plant that does not ride.
DesignRidePointer read_comfort_ride(const Value& value);

}  // namespace dashpot
