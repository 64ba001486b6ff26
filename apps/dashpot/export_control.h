#pragma once
#include <string>
#include <vector>

#include "damper_choice.h"
#include "dashpot/export.h"
#include "vehicle_options.h"

namespace dashpot::cli {

/// --controller and the options of the vehicle that it is made for.
std::vector<Option> control_options(VehicleChoice& choice);

/// The vehicle's controller; `damper` is its damper where the choice names none.
CBlockMaker controller_block(VehicleChoice choice, const DamperChoice& damper,
                             const ExportOptions& options, Console& console);
/// The scheme's inverse of the damper.
CBlockMaker scheme_block(const VehicleChoice& choice, DamperChoice damper,
                         const ExportOptions& options, Console& console);

}  // namespace dashpot::cli
