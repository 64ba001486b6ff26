#pragma once
#include <string>
#include <vector>

#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/machine/build_in_plant.h"
#include "dashpot/model_file.h"
#include "dashpot/report/document.h"

namespace dashpot::cli {

class Console;

/// A member of a family that works in a plant.
struct MemberInPlantSettings {
  std::string plant;                    ///< a file or words
  std::string model;                    ///< the family's file
  std::vector<std::string> recordings;  ///< files of the plant
};

struct MemberInPlant {
  BuildInPlant build;
  Document document;  ///< plant and sensors beside it, and beside the mean build
};

/// Finds the build of this member from recordings of the plant, as `dashpot identify --in` finds a
/// damper; warnings go to the console. Throws Error, before long work, where these cannot serve.
MemberInPlant build_from_drive(const FamilyModel& member, const ModelFile& family,
                               const MemberInPlantSettings& settings, Console& console);

}  // namespace dashpot::cli
