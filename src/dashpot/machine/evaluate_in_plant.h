#pragma once
#include <string>
#include <vector>

#include "dashpot/identify/fit/uncertainty.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/observer_tables.h"
#include "dashpot/machine/plant_recording.h"
#include "dashpot/monitor.h"

namespace dashpot {

// A plant and its dampers, all of whose numbers are known, judged on recordings in free run: the
// measured inputs in, what the sensors would show out. Nothing of plant and dampers is fitted.

struct PlantEvaluationOptions {
  std::size_t steps = 0;  ///< of the integrator per sample; 0: as many as its error asks for
  int threads = 0;
  Monitor monitor;
};

struct PlantEvaluation {
  /// Of each recording every sensor; `training` is the error over all that is compared, infinite
  /// where the plant diverges, and nothing is held back.
  std::vector<SensorFigures> sensors;
  std::vector<InPlantTrace> traces;  ///< one per recording
  std::size_t steps = 1;             ///< of the integrator per sample
  /// What half the step changes, rms, as a share of the rms error; the worst sensor.
  double step_error = 0;
  std::vector<std::string> warnings;
};

/// Runs plant and dampers free over each recording and compares what the sensors would show with
/// what they did show, from `skip` on. Nuisances, as on a bench: the offset of each sensor in each
/// recording and, unless the setup says that recordings begin at rest, where the plant is at their
/// beginnings. What a damper has at rest is borne by the springs. Throws Error, before long work,
/// where a number of the plant is unknown, nothing measures the road, a signal is constant, a
/// recording is too short or a model has too many states.
PlantEvaluation evaluate_in_plant(ObservedDampers dampers, const InPlantSetup& setup,
                                  const std::vector<PlantRecording>& recordings,
                                  const PlantEvaluationOptions& options);

}  // namespace dashpot
