#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dashpot/machine/observe.h"
#include "dashpot/machine/worn_damper.h"

namespace dashpot {

/// How well a day can tell how much one damper of several is worn.
struct WearOutlook {
  double deviation = 0;  ///< standard, of its amount, beside all that is unknown
  double alone = 0;      ///< the same where the other dampers were known to be as their models
  std::size_t like = 0;  ///< the amount of another damper that is most easily taken for it
};

/// A plant that is watched: what all days share.
struct WatchedPlant {
  ObservedDampers dampers;         ///< as identified, in equilibrium at rest, in the struts' order
  InPlantSetup setup;              ///< what is unknown of the plant is found anew on each day
  std::vector<const Wear*> wears;  ///< of each damper
  std::string level;       ///< sensor whose mean is followed too, as a ride height; empty: none
  ObserverNoise noise;     ///< of the reference days
  int steps = 1;           ///< of the filter per sample
  double sample_time = 0;  ///< s, of the reference days; 0: not known, as in states of before
  std::vector<WearOutlook> outlook = {};  ///< of several dampers, per amount of wear
};

/// What one day's recording says of the damper, with the standard deviations that the day itself
/// gives: of its sensors' noise, the road and the model's error, a second of it counting as one.
struct DayEstimate {
  std::string name;
  /// The amounts of `wears`, those of one damper behind those of the other, and behind them, where
  /// it is followed, the level.
  std::vector<double> wear, wear_deviation;
  std::vector<double> plant, plant_deviation;  ///< what was unknown of the plant, SI
  /// How strongly the plant was moved: G_d(n0), m^3, of a road that nothing measures, else the rms
  /// of its first input, SI.
  double excitation = 0;
  /// By its channel, how many times what each measured input shows would move the plant as its
  /// sensors tell: to first order, beside all that is unknown.
  std::vector<std::pair<std::string, double>> input_gains = {};
  int iterations = 0;
  bool converged = false;  ///< with all that was unknown of the plant inside its range
};

/// The wear, unknown numbers of the plant and roughness under which the sensors of that day are
/// most likely, by a filter that knows how wrong the model may be (method of scoring). Throws Error
/// where the filter diverges or the recording cannot be used: an input or a sensor that is
/// constant, fewer than three seconds behind the first, another sample time than that of the
/// reference days. `outlook`, of several dampers: where it is wanted, how well the day tells each
/// amount. How far the dampers are told apart is the sensors' information; what is open of one
/// alone, the model's errors included, is found as the deviations of a DayEstimate.
DayEstimate estimate_day(const WatchedPlant& watched, const PlantRecording& recording,
                         std::vector<WearOutlook>* outlook = nullptr);

/// The first unknown number of the plant that stands at an end of its range; empty: none does.
std::string at_an_end(const WatchedPlant& watched, const DayEstimate& day);

}  // namespace dashpot
