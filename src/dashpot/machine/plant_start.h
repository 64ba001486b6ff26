#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/plant_residuals.h"

namespace dashpot {

/// Where the fit of a plant with a damper begins.
struct PlantStart {
  std::vector<double> plant;  ///< of each unknown of the plant, SI
  /// Per recording, coordinates and velocities at its beginning; empty: at rest.
  std::vector<double> states;
  DataScale scale;  ///< of the damper's force and motion
  std::vector<std::string> warnings;
};

/// Where the plant's unknowns start, before any simulation: as stated, in the middle of a range, or
/// the table's values, of which `warnings` then tells. regression: of a row of the plant's table
/// each; empty: there is none.
std::vector<double> first_numbers(const InPlantSetup& setup, const std::vector<double>& regression,
                                  std::vector<std::string>& warnings);

/// A dashpot of a fifth of the critical damping along the damper's way, N*s/m.
double usual_dashpot(const DrivenPlant& plant);

/// Fits the plant with a spring and a dashpot in the damper's place. Chooses cases.steps, unless
/// the options state it, so that half the step changes no sensor by more than a thousandth.
PlantStart plant_start(const InPlantSetup& setup, const std::vector<PlantRecording>& recordings,
                       PlantCases& cases, const InPlantOptions& options);

}  // namespace dashpot
