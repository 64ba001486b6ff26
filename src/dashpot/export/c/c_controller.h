#pragma once
#include "dashpot/export/c/c_block.h"
#include "dashpot/vehicle.h"

namespace dashpot {

/// A vehicle's controller: a command per strut for what is measured there, with the filters of the
/// sensors where the vehicle has those of a car, and its inverse and force loop where it has them.
/// Throws Error where the vehicle has no controller, or one that has no C text.
CBlock c_controller_block(const Vehicle& vehicle, const ExportOptions& options);

}  // namespace dashpot
