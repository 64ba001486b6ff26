#pragma once
#include "dashpot.h"
#include "dashpot/dataset.h"

namespace dashpot::capi {

/// A copy, with the conditions of recordings in arrays told apart. Throws Error where there is no
/// recording.
Dataset usable_dataset(const dashpot_recordings* recordings);

}  // namespace dashpot::capi
