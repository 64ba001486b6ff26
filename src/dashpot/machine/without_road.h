#pragma once
#include <vector>

#include "dashpot/machine/in_plant_report.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_recording.h"

namespace dashpot {

struct Law;

/// Identifies the law as the damper of a plant on a road that nothing measures: all unknowns under
/// which the recordings are most likely, as the observer's filter expects them (prediction errors;
/// L. Ljung, System Identification, 1999, chapter 7). The road is filtered white noise of ISO 8608,
/// the law's own error two processes that come and go; class, noise and errors that are not stated
/// are unknowns as well, and so is what left and right roads of an axle share (road_pairs.h).
///
/// Starts: the filter with a dashpot and large errors in the law's place tells motion and force of
/// the damper, to which the law is fitted as on a bench. Then some seconds of each recording, then
/// all. Intervals: the inverse of the expected information, between scores that are summed over
/// blocks of half a second, so that prediction errors that are not white count as what they are.
///
/// Throws Error, before long work, where these sensors and recordings cannot tell: one sensor
/// alone, three roads side by side or one beside a measured one, no known mass, stiffness or force,
/// all delays unknown, a signal that is constant. Figures and traces of the report are one sample
/// ahead: nothing can run free on a road that is not known.
InPlantReport identify_without_road(const Law& law, const InPlantSetup& setup,
                                    const std::vector<PlantRecording>& recordings,
                                    const InPlantOptions& options);

}  // namespace dashpot
