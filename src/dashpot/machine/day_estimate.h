#pragma once
#include <memory>
#include <string>
#include <vector>

#include "dashpot/machine/observe.h"
#include "dashpot/machine/worn_damper.h"

namespace dashpot {

/// A plant that is watched: what all days share.
struct WatchedPlant {
  std::shared_ptr<const DamperModel> damper;  ///< as identified, in equilibrium at rest
  Domain domain;                              ///< of its data
  InPlantSetup setup;  ///< what is unknown of the plant is found anew on each day
  std::vector<const Wear*> wears;
  std::string level;       ///< sensor whose mean is followed too, as a ride height; empty: none
  ObserverNoise noise;     ///< of the reference days
  int steps = 1;           ///< of the filter per sample
  double sample_time = 0;  ///< s, of the reference days; 0: not known, as in states of before
};

/// What one day's recording says of the damper, with the standard deviations that the day itself
/// gives: of its sensors' noise, the road and the model's error, a second of it counting as one.
struct DayEstimate {
  std::string name;
  std::vector<double> wear, wear_deviation;    ///< as `wears` and, where it is followed, the level
  std::vector<double> plant, plant_deviation;  ///< what was unknown of the plant, SI
  /// How strongly the plant was moved: G_d(n0), m^3, of a road that nothing measures, else the rms
  /// of its first input, SI.
  double excitation = 0;
  int iterations = 0;
  bool converged = false;  ///< with all that was unknown of the plant inside its range
};

/// The wear, unknown numbers of the plant and roughness under which the sensors of that day are
/// most likely, by a filter that knows how wrong the model may be (method of scoring). Throws Error
/// where the filter diverges or the recording cannot be used: an input or a sensor that is
/// constant, fewer than three seconds behind the first, another sample time than that of the
/// reference days.
DayEstimate estimate_day(const WatchedPlant& watched, const PlantRecording& recording);

/// The first unknown number of the plant that stands at an end of its range; empty: none does.
std::string at_an_end(const WatchedPlant& watched, const DayEstimate& day);

}  // namespace dashpot
