#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/in_plant_report.h"
#include "dashpot/machine/in_plant_setup.h"

namespace dashpot {

/// What speaks against sensors after a free run, of a fit or of known numbers, a sentence each:
/// where one flaw of the sensor, the same in all recordings, would explain most of what is left
/// there (it counts in another unit or the other way round, comes late or early, drifts), else
/// where a sensor is further from the model than from no motion at all. `figures` are those of the
/// traces.
std::vector<std::string> sensor_doubts(const InPlantSetup& setup,
                                       const std::vector<SensorFigures>& figures,
                                       const std::vector<InPlantTrace>& traces);

/// The same where nothing measures the road, so that nothing runs free: sensors that nearly all was
/// taken for noise of, a sentence each. `report` has sensors and nuisances.
std::vector<std::string> noise_doubts(const InPlantSetup& setup, const InPlantReport& report);

/// Whether even the sensor that is met best is so far from the model that its numbers, and how
/// certain they seem, cannot be relied on.
bool is_far_off(const InPlantSetup& setup, const std::vector<InPlantTrace>& traces);

/// Whether some sensor comes late or early, by what it shows beside the model.
bool seems_late(const InPlantSetup& setup, const std::vector<InPlantTrace>& traces);

}  // namespace dashpot
