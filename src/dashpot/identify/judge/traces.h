#pragma once
#include <vector>

#include "dashpot/evaluate.h"

namespace dashpot {

/// Each result that kept its curves as a record: motion and drive as far as there are any, and the
/// forces "measured", "modelled" and "residual" (measured less modelled), in SI.
std::vector<Record> traces(const std::vector<RecordResult>& results, DriveUnit drive_unit);

}  // namespace dashpot
