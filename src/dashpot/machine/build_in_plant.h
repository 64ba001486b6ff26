#pragma once
#include <string>
#include <vector>

#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/identify/fit/family_build.h"
#include "dashpot/machine/in_plant_report.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_recording.h"

namespace dashpot {

// A damper of a fitted family works in a plant: its drawing is known, its build is not. The few
// numbers by which builds differ are fitted in free run together with the plant's, from the mean
// build on. What the sensors then tell of the damper's motion and force is a recording of this
// build, and it is made what that says, with what the family knows of builds beside it, as from a
// recording on a bench. With the build held the plant is identified once more.

/// What a drive tells of a build.
struct BuildInPlant {
  /// The plant with the drawing's mean build held, with the three numbers of the build among the
  /// unknowns, and with the build that was found held. Without models where the plant diverges; the
  /// outer two have the family's member, of the mean build and of this one; `found` lists, as the
  /// damper's, the build's numbers as the drive alone tells them.
  InPlantReport free, mean, found;
  BuildReport build;            ///< its errors are of the force that the sensors tell
  std::vector<Record> records;  ///< from which it was found
};

/// Throws Error(where, ...) where the family does not know its builds, where nothing measures the
/// road, where the plant has several dampers.
void require_build_for_plant(const FamilyModel& member, const InPlantSetup& setup,
                             const std::string& where);

/// Finds the build of this member's drawing from recordings of the plant that it works in, without
/// their still ends (recording_parts.h). Throws Error, before long work, where these cannot serve.
/// Options: no choices, and as many starts as asked for, which are all alike.
BuildInPlant identify_build_in_plant(const FamilyModel& member, const InPlantSetup& setup,
                                     const std::vector<PlantRecording>& recordings,
                                     const InPlantOptions& options);

}  // namespace dashpot
