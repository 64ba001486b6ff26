#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/report/document.h"

namespace dashpot::cli {

/// The sensors at the end of a recording, measured and modelled, and behind them the dampers'
/// forces over their deflection. sensors: of this recording first, in the setup's order; forces:
/// how they are told.
DocumentFigure sensor_figure(const InPlantTrace& trace, const std::vector<SensorFigures>& sensors,
                             const std::string& forces = "modelled");

}  // namespace dashpot::cli
