#pragma once
#include "dashpot.h"
#include "dashpot/dataset.h"
#include "dashpot/record/readers/table.h"

namespace dashpot::capi {

/// A copy, in which recordings given as arrays have conditions, by infer_conditions(). Throws Error
/// where there is no recording.
Dataset usable_dataset(const dashpot_recordings* recordings);

/// The caller's arrays as a file's table. Throws Error at a column without name or samples.
RawTable copy_table(const dashpot_table& table, const std::string& name);

}  // namespace dashpot::capi
