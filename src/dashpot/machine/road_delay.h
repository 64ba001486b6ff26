#pragma once
#include <vector>

#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_recording.h"

namespace dashpot {

struct Law;

/// Whether the delay of a road that follows another one is to be found.
bool looks_for_road_delay(const InPlantSetup& setup);

/// The setup with the delays at which the sensors are met best, within a tenth of where they are
/// expected; several are taken to be wrong by one factor, that of the speed. By a fit of plant and
/// law from one start that is carried on from delay to delay under fixed weights.
InPlantSetup with_found_road_delay(const Law& law, const InPlantSetup& setup,
                                   const std::vector<PlantRecording>& recordings,
                                   const InPlantOptions& options);

}  // namespace dashpot
