#pragma once
#include <string>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/machine/in_plant_report.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_recording.h"

namespace dashpot {

struct Law;

// Identification of a damper where it works: as the unknown part of a linear plant, from what is
// measured on the plant. Nobody measures the damper's force. Plant and damper are run together,
// free, under the measured inputs, and their unknown numbers are fitted at once, so that what the
// sensors would show is what they did show.
//
//   min  sum over sensors of |shown - measured - offset|^2 / scale^2
//
// over plant parameters, the law's parameters (table, forms and bounds as on the bench), the state
// at the beginning of each recording and, where asked for, the delay of a sensor. The offset of
// each sensor in each recording is eliminated. scale: the stated noise of a sensor, else the rms of
// what the fit leaves there.
//
// Where nothing measures the road, nothing can be run free; without_road.h says what is done then.

/// Identifies the law as the damper of this plant. Throws Error, before long work, where these
/// recordings cannot serve: an input that is constant, a current that never changes though a form
/// over current was asked for. Not converging is a status.
InPlantReport identify_in_plant(const Law& law, const InPlantSetup& setup,
                                const std::vector<PlantRecording>& recordings,
                                const InPlantOptions& options);

/// What the first sensor of the setup would show of this plant and damper over a recording, from
/// rest, without offset and delay; `steps` of the integrator per sample. Throws Error where it
/// diverges.
std::vector<double> plant_response(const Plant& plant, const DamperModel& damper,
                                   const InPlantSetup& setup, const PlantRecording& recording,
                                   std::size_t steps = 8);

}  // namespace dashpot
