#pragma once
#include <vector>

#include "dashpot/record.h"

// A load cell on the side that moves feels the inertia of what lies between it and the damper.

namespace dashpot {

/// m/s^2: as recorded, else derived from the velocity without phase. Empty where the time stamps
/// are not uniform or too few.
std::vector<double> acceleration_of(const Record& record);

/// What the usual acceleration, derived from the velocity, cannot exceed: one look at the
/// differences, where deriving it takes a spectrum and filters. Infinite where that tells nothing.
double greatest_acceleration(const Record& record);

/// The greatest acceleration that is usual, m/s^2: one sample of noise is no motion.
double usual_acceleration(const std::vector<double>& acceleration);

/// Takes the inertia of `mass` kg off the record's force, beyond what is off already, and notes it.
/// False, with nothing done, where there is no acceleration.
bool take_off_inertia(Record& record, double mass);

}  // namespace dashpot
