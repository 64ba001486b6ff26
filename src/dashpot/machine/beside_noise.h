#pragma once
#include <optional>
#include <string>
#include <vector>

#include "dashpot/machine/any_force.h"
#include "dashpot/machine/in_plant_report.h"
#include "dashpot/machine/input_noise.h"
#include "dashpot/machine/plant_residuals.h"
#include "dashpot/numerics/jackknife.h"

namespace dashpot {

// The second part of a fit inside a plant: beside the noise of its inputs (input_noise.h).

/// Whether there is a second part: the noise of an input is stated, or several sensors can tell
/// that of a ground's motion. A force whose noise is not stated counts as exact.
bool has_noisy_inputs(const InPlantSetup& setup);

struct NoisyFit {
  PlantCases cases;                   ///< with the inputs as they were measured
  std::vector<RecordingNoise> noise;  ///< by which the residuals are weighed; empty: no second part
  NoiseFound found;
  Covariance spread;                        ///< of the unknowns
  std::optional<Jackknife> alone;           ///< what it comes from
  std::optional<BesideAnyForce> any_force;  ///< where the law is shown not to be the damper's
  std::vector<FittedParameter> numbers;     ///< of the plant then, and the same in words
  std::string told;
  /// Behind the unknowns what the damper shows beside the law, where that is more than chance.
  std::optional<Jackknife> with_more;
  std::vector<std::string> more;  ///< the same in words
};

/// Noise and unknowns in turn, from where the first fit ended, until these stay; where the
/// integrator's step is too long for the error, once more in twice as many. `cases`, those of the
/// residuals, are then without the likely noise. The report gets the step's error.
LeastSquaresReport solve_beside_noise(const InPlantSetup& setup,
                                      const std::vector<PlantRecording>& recordings,
                                      const InPlantOptions& options, const DataScale& scale,
                                      PlantCases& cases, PlantResiduals& residuals,
                                      LeastSquaresReport solved, NoisyFit& fit,
                                      InPlantReport& report);

/// The intervals of a fit beside noise, by Student's t; where the damper shows more than the law
/// has, they reach to where the numbers would go with that, and those of the plant to where they go
/// beside any force. Empty where there was no second part.
Reach reach_of(const NoisyFit& fit);

/// What was found of the noise, with its intervals, as nuisances.
void add_noise(const InPlantSetup& setup, const NoiseFound& found, InPlantReport& report);

}  // namespace dashpot
