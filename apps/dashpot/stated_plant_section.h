#pragma once
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/report/document.h"

namespace dashpot::cli {

/// What a plant's file says, for the pages that come of it: its numbers, known or not; what moves
/// it, what shows that, and what drives its dampers.
DocumentSection stated_plant_section(const InPlantSetup& setup);

}  // namespace dashpot::cli
