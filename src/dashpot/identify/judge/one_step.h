#pragma once
#include <string_view>

#include "dashpot/damper_model.h"
#include "dashpot/drive.h"
#include "dashpot/evaluate.h"
#include "dashpot/record.h"

namespace dashpot {

/// Errors of predictions one step ahead: a model that feeds its force back is given the measured
/// force (less `offset`, N) at each of its steps instead of its own. A figure that flatters: at
/// high sample rates the last force alone predicts the next. Without samples for a model that feeds
/// nothing back.
ErrorSums one_step_errors(const DamperModel& model, const Record& record, DriveUnit drive_unit,
                          double offset);

}  // namespace dashpot
