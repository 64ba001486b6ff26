#pragma once
#include "dashpot/output/exporters/exporter.h"
#include "dashpot/suspension/vehicle.h"

namespace dashpot {

/// A vehicle's controller as C99: <prefix>_init, _reset and _step give a command per strut for what is
/// measured there, with the filters of the sensors where the vehicle has those of a car, and its inverse and
/// force loop where it has them. A header, a source and a main that checks them along a run. Throws Error
/// where the vehicle has no controller, or one that has no C text.
std::vector<ExportedFile> write_c_controller(const Vehicle& vehicle, const ExportOptions& options);

}  // namespace dashpot
