#pragma once
#include <string>
#include <vector>

#include "dashpot/base/print_units.h"
#include "dashpot/machine/in_plant_report.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_recording.h"
#include "dashpot/model_file.h"

namespace dashpot {

// The noise of sensors that nobody stated: found by an identification, kept in the files that it
// writes, and taken by observers.

/// Of each sensor and measured input that states none, as the fit tells it: among the nuisances,
/// where their interval is narrower than a factor of 2; else of a sensor the part of what is left
/// in free run that is white, where there is one, since the rest is the model's error. Without a
/// deviation where neither tells it. Nothing of a report without a model.
std::vector<FoundNoise> found_noise(const InPlantSetup& setup, const InPlantReport& report);

/// That of a report which is told, for the files of observers.
std::vector<FoundNoise> told_noise(const InPlantReport& report);

/// The sensors that show hardly more than white noise in these recordings.
std::vector<std::string> noise_alone(const InPlantSetup& setup,
                                     const std::vector<PlantRecording>& recordings);

/// The setup of an observer: what the plant's file says was found, else what the model's file
/// says, stands where no noise is stated (and no zero), and `from` names the file.
InPlantSetup with_identified_noise(InPlantSetup setup, const ModelFile& file,
                                   const std::string& model);

/// Which noise was not stated but is as identified, and who says so, in one sentence in these
/// units; empty where none is.
std::string identified_noise_words(const InPlantSetup& setup, const PrintUnits& units);

}  // namespace dashpot
