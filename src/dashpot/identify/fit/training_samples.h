#pragma once
#include <functional>
#include <string>
#include <vector>

#include "dashpot/damper/nets/mlp.h"
#include "dashpot/drive.h"
#include "dashpot/evaluate.h"

namespace dashpot {

/// A record's inputs as a model without feedback sees them, row by row.
using InputRows = std::function<std::vector<double>(const std::vector<DamperInput>&,
                                                    const std::vector<double>& time)>;

/// All samples of all records from their warm-up on; a group per record with OffsetMode::Record.
TrainingSamples training_samples(const std::vector<Record>& records, DriveUnit drive_unit,
                                 OffsetMode offset, const InputRows& rows);

}  // namespace dashpot
