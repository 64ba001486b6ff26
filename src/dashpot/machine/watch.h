#pragma once
#include <string>
#include <vector>

#include "dashpot/machine/day_estimate.h"
#include "dashpot/machine/health_chart.h"
#include "dashpot/value.h"

namespace dashpot {

// A damper that works in a plant, or several of them, followed from day to day: each day's
// recording says how much the force of each has become another than its model's, and a chart per
// quantity when it has fallen.

struct WatchOptions {
  std::vector<std::string> wears = {"force"};
  std::string level;               ///< channel of a sensor whose mean is followed; empty: none
  std::vector<std::string> known;  ///< channels whose mean may explain a day, as a temperature
  ChartOptions chart;              ///< days: between false alarms of all charts together
  int threads = 0;
  Monitor monitor;
};

/// A day as it is kept.
struct WatchedDay {
  DayEstimate estimate;
  std::vector<double> known;  ///< of the options' channels, means
};

/// Throws Error where options and plant do not fit together.
void require_watchable(const InPlantSetup& setup, const WatchOptions& options);

/// Of the work of watching, as progress tells it, what watched_plant() takes.
inline constexpr double kPreparation = 0.3;

/// Days, the first ones, that uncertainties are found on.
inline constexpr std::size_t kPreparationDays = 3;

/// The plant as the first reference days show it: uncertainties, and where its unknown numbers lie.
/// Throws Error before long work where options, plant, dampers and recordings do not fit together,
/// and where the sensors cannot tell one damper from another. There is a damper per strut.
WatchedPlant watched_plant(ObservedDampers dampers, InPlantSetup setup,
                           const std::vector<PlantRecording>& reference,
                           const WatchOptions& options);

/// What the sensors hardly tell of several dampers, one from another: a sentence each.
std::vector<std::string> hardly_apart(const WatchedPlant& watched);

/// One day. A channel of `known` must be in the recording.
WatchedDay watch_day(const WatchedPlant& watched, const PlantRecording& recording,
                     const WatchOptions& options);

/// A quantity that is followed, and its chart.
struct WatchedQuantity {
  std::string name, unit, meaning;  ///< "force", of several dampers "front_force"
  std::size_t place;                ///< among DayEstimate::wear
  std::string strut = {};           ///< of several dampers: where its own stands; a level: empty
  Chart chart = {};
};
/// The quantities of a plant without their charts.
std::vector<WatchedQuantity> watched_quantities(const WatchedPlant& watched);
/// The charts of all days, in their order. The stated rate of false alarms is shared out among
/// all of them, those of all dampers together. How strongly the plant was moved explains a day: so
/// much of its value is the model's error. A level is explained by the plant's unknown numbers of
/// the day too, since a load moves both.
std::vector<WatchedQuantity> watch_charts(const WatchedPlant& watched,
                                          const std::vector<WatchedDay>& days,
                                          const WatchOptions& options);

/// Days that are odd, a sentence each: reference days far from the other ones, since a chart takes
/// for healthy scatter what may be a fade; judged days far above what was to be expected, since
/// sensors raise what a fade would lower; days behind the reference on which a measured input seems
/// to count otherwise than on these, by 5 % and more, which looks like a fade as well.
std::vector<std::string> odd_days(const std::vector<WatchedQuantity>& quantities,
                                  const std::vector<WatchedDay>& days);

/// The quantity whose alarm came first; of those of several dampers on one day the one that went
/// furthest beyond its threshold. Null: none has.
const WatchedQuantity* first_alarm_of(const std::vector<WatchedQuantity>& quantities);

/// What of a watched plant was found, as JSON, and such a plant again.
Value found_of(const WatchedPlant& watched);
WatchedPlant watched_again(ObservedDampers dampers, InPlantSetup setup, const Value& found,
                           const WatchOptions& options);
Value to_json(const WatchedDay& day);
WatchedDay watched_day_from_json(const Value& value);

}  // namespace dashpot
