#pragma once
#include "dashpot/damper/kinds/family/line_family.h"
#include "dashpot/identify/fit/family_record.h"

namespace dashpot {

/// Each record becomes an ellipse: its size, its phase and its offset by least squares. The first
/// two are lines in the features by ridge regression, all records alike; the offset is their mean.
/// Throws Error where nothing moves.
FamilyLine fit_family_line(const std::vector<FamilyRecord>& records);

}  // namespace dashpot
