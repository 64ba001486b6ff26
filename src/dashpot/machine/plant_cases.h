#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/evaluate.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_recording.h"
#include "dashpot/machine/plant_run.h"

namespace dashpot {

// Recordings as a fit runs them: inputs and drives between the samples, and what is fitted of each.

constexpr std::size_t kMostSteps = 16;  ///< of the integrator per sample, unasked
constexpr double kStepShare = 0.05;     ///< of the error that is left: what half a step may change

/// One recording, ready to be run.
struct PlantCase {
  std::string name;
  PlantDriving driving;
  std::vector<std::vector<double>> measured;  ///< per sensor
  std::size_t first = 0;                      ///< sample that is compared first
  std::size_t training = 0;                   ///< samples up to the end of what is fitted
  /// Of each kind of damper its drive, where that is one and never changes (held_levels).
  std::vector<std::optional<double>> levels;
};

struct PlantCases {
  std::vector<PlantCase> all;
  std::size_t steps = 1;  ///< of the integrator per sample
  PlantMethod method = PlantMethod::RungeKutta;
};

/// steps: of the integrator per sample; 0: a first guess. Inputs are band-limited between samples,
/// the current goes straight. Throws Error at an input that is constant, at a recording too short.
PlantCases make_cases(const InPlantSetup& setup, const std::vector<PlantRecording>& recordings,
                      std::size_t steps, PlantMethod method = PlantMethod::RungeKutta);

/// How far the drives of all dampers go in all of them.
DriveRange drive_range(const PlantCases& cases);

}  // namespace dashpot
