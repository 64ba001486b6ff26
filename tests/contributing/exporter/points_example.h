#pragma once
#include <vector>

#include "dashpot/export.h"

namespace dashpot {

/// An exporter for CONTRIBUTING.md: the force at the ends of the model's velocities.
std::vector<ExportedFile> write_points_example(const ExportedModel& model,
                                               const ExportOptions& options);

}  // namespace dashpot
