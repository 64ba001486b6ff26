#pragma once
#include <span>
#include <string>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_recording.h"
#include "dashpot/machine/plant_smoother.h"

namespace dashpot {

// Sensors that fail within a recording, by what they showed beyond what a filter had expected of
// them one sample ahead.

/// Sensors that stood at one value for 0.1 s and more while the filter expected another: there,
/// what they showed lies more than three times as far (rms) from what was expected as it does in
/// the rest of the recording. A coarse sensor of a plant that stands is none. A sentence each.
std::vector<std::string> held_sensors(const InPlantSetup& setup, const PlantRecording& recording,
                                      const ObservedRun& run);

/// The sensor whose zero drifts along a recording, in a sentence; empty where none does: a straight
/// line of the sensor explains what no slow error of the dampers' forces does as well. `tried`:
/// filters with slow errors of several sizes, the least ones last, under each of which the
/// recording is asked with the line and without it; the likelihoods of the best of both are
/// compared, less what correlation leaves of them (by 24 pieces of time). Where a filter is right,
/// one of 1000 sets of so many recordings raises a warning. Lines of less than three times what the
/// zeros are uncertain by
/// (`zeros`, per sensor) raise none.
/// Source: A. S. Willsky and H. L. Jones, A generalized likelihood ratio approach to the detection
/// and estimation of jumps in linear systems, IEEE Trans. Automatic Control 21, 1976, 108-112;
/// J. T. Kent, Robust properties of likelihood ratio tests, Biometrika 69, 1982, 19-27.
std::string drifting_sensor(const InPlantSetup& setup, const PlantRecording& recording,
                            const ObservedSamples& samples, std::span<const PlantObserver> tried,
                            std::span<const double> zeros, std::size_t recordings, int threads);

}  // namespace dashpot
