#pragma once
#include <string_view>

#include "dashpot/damper_model.h"
#include "dashpot/drive.h"
#include "dashpot/evaluate.h"
#include "dashpot/record.h"

namespace dashpot {

/// Errors over a record where a model that feeds its force back is given the measured one (less
/// `offset`, N) at each of its steps instead: one step ahead. A figure that flatters: at high
/// sample rates the last force foretells the next by itself. Without samples for a model that feeds
/// nothing back.
ErrorSums one_step_errors(const DamperModel& model, const Record& record, DriveUnit drive_unit,
                          double offset);

}  // namespace dashpot
