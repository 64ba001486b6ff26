#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"

namespace dashpot {

/// What sensors say against each other, whatever the damper, the plant's numbers and the inputs
/// are: a deflection bends as the accelerations of the coordinates below and above it say. Where
/// all of these are measured and one of them counts the other way round or in another unit, it is
/// named, a sentence each. Sensors behind filters that are stated or looked for are not asked.
std::vector<std::string> disagreeing_sensors(const InPlantSetup& setup,
                                             const std::vector<InPlantTrace>& traces);

}  // namespace dashpot
