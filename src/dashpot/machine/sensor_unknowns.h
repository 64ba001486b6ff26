#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "dashpot/identify.h"
#include "dashpot/machine/in_plant_setup.h"

namespace dashpot {

// What is to be found of a sensor itself: how late it is, and from where on its filter holds back.

/// A number of a sensor in s: its delay, or the time of its filter, which is 1 over 2 pi times the
/// cut-off. What a sensor shows goes nearly straight with either, and 0 is no delay and no filter.
struct SensorUnknown {
  enum class Of { Delay, Cutoff } of = Of::Delay;
  std::size_t sensor = 0;
  double lower = 0, upper = 0;  ///< s
  double shortest = 0;          ///< s, of a filter: that at half the sample rate
};

/// Those that the setup asks for, at this sample time: first all delays, up to 20 samples late or
/// early, then all cut-offs, from a hundredth of the sample rate on where nothing is stated.
std::vector<SensorUnknown> sensor_unknowns(const InPlantSetup& setup, double sample_time);

/// "delay of az_wheel", "cut-off of az_wheel".
std::string name_of(const SensorUnknown& unknown, const InPlantSetup& setup);
/// Where its search starts, s.
double start_of(const SensorUnknown& unknown, const InPlantSetup& setup);
/// Puts what was found, s, in the place of what was unknown.
void put(const SensorUnknown& unknown, double seconds, std::vector<PlantSensor>& sensors);
/// Such a number with its interval, s, as people know it: the time of a filter as its cut-off, Hz,
/// whose interval is open where there may be no filter: nothing else than a short delay tells one
/// above half the sample rate.
void tell(const SensorUnknown& unknown, FittedParameter& found);

/// The filter of a sensor with the longest memory that it may have at this sample time.
SensorFilter slowest_filter(const PlantSensor& sensor, double sample_time);

/// Where its cut-off is looked for, that from half of this one on, or of 0.15 of the sample rate
/// where that is less.
void keep_cutoff_near(const SensorFilter& found, double sample_time, PlantSensor& sensor);

/// What a fit found of a sensor, among its nuisances; null where there is none.
struct FoundLags {
  const FittedParameter *delay = nullptr, *cutoff = nullptr;
};
FoundLags lags_found(const std::vector<FittedParameter>& nuisances, const std::string& channel);
/// Puts them in the sensor.
void take_found(const FoundLags& found, PlantSensor& sensor);

}  // namespace dashpot
