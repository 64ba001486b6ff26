#pragma once
#include <string>
#include <vector>

#include "campaign.h"

namespace dashpot::cli {

/// A campaign inside a plant in place of a test bench.
struct PlantBenchSettings {
  std::string plant;  ///< a file or words; empty: on the bench
  std::vector<std::string> truth, wear;
  std::string road, grade = "car";
  double hold = 0;  ///< s, of a level within one ride; 0: a ride per level
  double duration = 10, push = 0;
};

std::vector<Option> plant_bench_options(PlantBenchSettings& settings);

/// Makes the rides, writes what the sensors recorded, the truth beside it, and the plant as it
/// truly is. Returns the exit code.
int record_in_plant(const PlantBenchSettings& settings, const CampaignSettings& campaign,
                    const std::string& folder, Console& console);

}  // namespace dashpot::cli
