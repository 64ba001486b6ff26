#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/observer_tables.h"

namespace dashpot {

/// How each damper moves in each recording: dampers x recordings x samples.
using DamperMotions = std::vector<std::vector<std::vector<DamperInput>>>;

/// Where dampers go beyond the motion and drive that their models were fitted on, in words, a
/// damper of several by its strut. A peak or two of the motion do not count.
std::vector<std::string> beyond_models(const ObservedDampers& dampers, const InPlantSetup& setup,
                                       const DamperMotions& motions);

}  // namespace dashpot
