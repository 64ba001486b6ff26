#pragma once
#include <optional>
#include <span>
#include <vector>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_recording.h"

namespace dashpot {

// What drives the dampers of a plant, as recorded: channels, or levels that never change.

/// What a drive was at each sample of a recording, A or V.
std::vector<double> drive_samples(const DamperDrive& drive, const PlantRecording& recording);
/// The setup with levels in place of channels that never change in these recordings.
InPlantSetup with_held_drives(InPlantSetup setup, std::span<const PlantRecording> recordings);
/// Per kind of damper the level at which all of it are held; none where a channel drives one.
std::vector<std::optional<double>> held_levels(const InPlantSetup& setup);
/// The laws of each kind where these levels are held: parameters are constant there, which is
/// quicker.
std::vector<LawModel> at_held_levels(std::vector<LawModel> laws,
                                     std::span<const std::optional<double>> levels);

}  // namespace dashpot
