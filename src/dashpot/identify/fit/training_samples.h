#pragma once
#include <functional>
#include <string>
#include <utility>
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

/// Mean and standard deviation of every `stride`-th value from `first` on; a constant has scale 1.
std::pair<double, double> mean_and_scale(const std::vector<double>& values, std::size_t first,
                                         std::size_t stride);

}  // namespace dashpot
