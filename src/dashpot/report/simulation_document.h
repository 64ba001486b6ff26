#pragma once
#include "dashpot/report/document.h"
#include "dashpot/suspension/ride/simulated_run.h"

namespace dashpot {

/// A run, beside another one of the same plant, on one ground.
struct Simulation {
  SimulatedRun run;
  std::optional<SimulatedRun> against;
  std::string ground;   ///< its description
  double duration = 0;  ///< s
  double discard = 0;   ///< s at the start that do not count
};

/// Measures, remarks, what happened over time.
Document simulation_document(const Simulation& simulation);
Value simulation_json(const Simulation& simulation);

}  // namespace dashpot
