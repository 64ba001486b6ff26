#pragma once
#include "dashpot.h"
#include "dashpot/dataset.h"

namespace dashpot::capi {

/// A copy, in which recordings given as arrays have conditions, by infer_conditions(). Throws Error
/// where there is no recording.
Dataset usable_dataset(const dashpot_recordings* recordings);

}  // namespace dashpot::capi
