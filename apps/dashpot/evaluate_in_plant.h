#pragma once
#include <string>
#include <vector>

namespace dashpot::cli {

class Console;

/// `evaluate --in`: a model, or one of each damper, judged in a plant.
struct PlantEvaluateSettings {
  std::string model, plant;
  std::vector<std::string> recordings;
  std::string report, traces, units, folder;
  int threads = 0;
};

int run_evaluate_in_plant(const PlantEvaluateSettings& settings, Console& console);

}  // namespace dashpot::cli
