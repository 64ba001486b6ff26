#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_recording.h"

namespace dashpot {

// Parts of recordings.
//
// A recording often begins before the plant moves, and goes on after it has stopped: the car
// stands, the shaker waits. Such ends tell nothing of plant and damper but fill the time over which
// starts are tried, and the time that is held back. Or it begins on a smooth road, where a damper
// hardly bends.

/// The part of each recording that may be fitted, behind what is skipped.
std::vector<PlantRecording> fitted_parts(const InPlantSetup& setup,
                                         const std::vector<PlantRecording>& recordings);
/// The samples of a recording from `first` up to `end`.
PlantRecording part_of(const PlantRecording& recording, std::size_t first, std::size_t end);
/// Samples of a recording that are fitted, from the first one on; those behind judge the result.
std::size_t fitted_samples(const InPlantSetup& setup, const PlantRecording& recording);

/// Where the plant moves in a recording, in order: all but the ends at which every input and sensor
/// stays at its level, of 500 samples or more but for the last hundred. Where nothing measures the
/// road, which is taken as the same all along, pauses of a second or more are left out as well.
std::vector<SampleRange> moving_stretches(const InPlantSetup& setup,
                                          const PlantRecording& recording);
/// These of each recording as recordings of their own.
std::vector<PlantRecording> moving_parts(const InPlantSetup& setup,
                                         const std::vector<PlantRecording>& recordings);

/// What moving_parts() leaves out, in a sentence; empty: nothing.
std::string still_parts(const InPlantSetup& setup, const std::vector<PlantRecording>& recordings);

/// For recordings of which one moves less than half as much over its first `horizon` samples as on
/// the whole: from where each moves as much up to the end of what is fitted, which is also where
/// their own fitted part ends. Empty where none is so, and where all begin at rest.
std::vector<PlantRecording> lively_parts(const InPlantSetup& setup,
                                         const std::vector<PlantRecording>& recordings,
                                         std::size_t horizon);

}  // namespace dashpot
