#pragma once
#include <string_view>

#include "dashpot/damper/model.h"
#include "dashpot/identify/judge/metrics.h"
#include "dashpot/record/record.h"

namespace dashpot {

/// Errors of predictions one step ahead: a model that feeds its force back is given the measured
/// force (less `offset`, N) at each of its steps instead of its own. A figure that flatters: at
/// high sample rates the last force alone predicts the next. Without samples for a model that feeds
/// nothing back.
ErrorSums one_step_errors(const DamperModel& model, const Record& record,
                          std::string_view drive_unit, double offset);

}  // namespace dashpot
