#pragma once
#include <vector>

#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_recording.h"

namespace dashpot {

// A rear axle meets the road that the front axle met a little before: wheelbase over speed. Where
// the road under the front is measured, nobody need measure the one under the rear.

/// The recordings with a channel for each input that follows another one, which is that of the
/// other, later. Without their beginning, in which a rear axle was still on a road that no channel
/// has shown, as where `longest` s is one more delay; unchanged where nothing follows. Throws Error
/// where no time is left.
std::vector<PlantRecording> with_followers(const InPlantSetup& setup,
                                           const std::vector<PlantRecording>& recordings,
                                           double longest = 0);

}  // namespace dashpot
