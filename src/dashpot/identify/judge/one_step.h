#pragma once
#include <string_view>

#include "dashpot/damper/model.h"
#include "dashpot/identify/judge/metrics.h"
#include "dashpot/record/record.h"

namespace dashpot {

/// Errors over a record where a model that feeds its force back is given the measured one (less
/// `offset`, N) at each of its steps instead: one step ahead. A figure that flatters: at high
/// sample rates the last force foretells the next by itself. Without samples for a model that feeds
/// nothing back.
ErrorSums one_step_errors(const DamperModel& model, const Record& record,
                          std::string_view drive_unit, double offset);

}  // namespace dashpot
