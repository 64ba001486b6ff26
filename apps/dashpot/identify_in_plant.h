#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"
#include "ranking_run.h"

namespace dashpot::cli {

/// What an identification inside a plant is told beside what the bench's is.
struct InPlantSettings {
  std::string plant;  ///< in which the damper works; empty: on a bench
  std::string grade = InPlantOptions().grade;
  std::vector<std::string> profiles;
};
/// `ride`: the options of a ride with the models found, which have no effect inside a plant.
std::vector<Option> in_plant_options(InPlantSettings& settings, const std::vector<Option>& ride);

/// Identifies the models asked for as the damper of a plant from its recordings: prints and
/// writes a report, and a model file per model. Throws UsageError at settings that have no meaning
/// there, Error at a plant and recordings that do not fit.
int run_in_plant(const InPlantSettings& asked, const RankingSettings& settings, Console& console);

}  // namespace dashpot::cli
