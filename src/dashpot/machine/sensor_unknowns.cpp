#include "dashpot/machine/sensor_unknowns.h"

#include <algorithm>
#include <cmath>

#include "dashpot/numerics/constants.h"

namespace dashpot {
namespace {

/// 1 over 2 pi times the other one: the time of a filter and its cut-off, each of the other.
double time_or_cutoff(double other) { return other > 0 ? 1 / (kTurn * other) : INFINITY; }

double lowest_cutoff(const CutoffRange& range, double sample_time) {
  constexpr double kOfRate = 0.01;
  return range.lower > 0 ? range.lower : kOfRate / sample_time;
}

const FittedParameter* find_nuisance(const std::vector<FittedParameter>& list,
                                     const std::string& name) {
  const auto found = std::ranges::find(list, name, &FittedParameter::name);
  return found == list.end() ? nullptr : &*found;
}

}  // namespace

std::vector<SensorUnknown> sensor_unknowns(const InPlantSetup& setup, double sample_time) {
  constexpr double kMostDelay = 20;  // samples
  std::vector<SensorUnknown> unknowns;
  for (std::size_t s = 0; s < setup.sensors.size(); ++s)
    if (setup.sensors[s].finds_delay)
      unknowns.push_back(
          {SensorUnknown::Of::Delay, s, -kMostDelay * sample_time, kMostDelay * sample_time});
  for (std::size_t s = 0; s < setup.sensors.size(); ++s)
    if (const auto& range = setup.sensors[s].finds_cutoff) {
      unknowns.push_back({SensorUnknown::Of::Cutoff, s, time_or_cutoff(range->upper),
                          time_or_cutoff(lowest_cutoff(*range, sample_time)),
                          time_or_cutoff(0.5 / sample_time)});
    }
  return unknowns;
}

std::string name_of(const SensorUnknown& unknown, const InPlantSetup& setup) {
  return (unknown.of == SensorUnknown::Of::Delay ? "delay of " : "cut-off of ") +
         setup.sensors[unknown.sensor].channel;
}

double start_of(const SensorUnknown& unknown, const InPlantSetup& setup) {
  const PlantSensor& sensor = setup.sensors[unknown.sensor];
  if (unknown.of == SensorUnknown::Of::Delay) return sensor.delay;
  const double time = sensor.filter.cutoff > 0 ? time_or_cutoff(sensor.filter.cutoff) : 0;
  return std::clamp(time, unknown.lower, unknown.upper);
}

void put(const SensorUnknown& unknown, double seconds, std::vector<PlantSensor>& sensors) {
  PlantSensor& sensor = sensors[unknown.sensor];
  if (unknown.of == SensorUnknown::Of::Delay) {
    sensor.delay = seconds;
    sensor.finds_delay = false;
  } else {
    sensor.filter.cutoff = seconds > 0 ? time_or_cutoff(seconds) : 0;
    sensor.finds_cutoff.reset();
  }
}

void tell(const SensorUnknown& unknown, FittedParameter& found) {
  if (unknown.of == SensorUnknown::Of::Delay) return;
  const double longest = found.high, shortest = found.value < unknown.shortest ? 0 : found.low;
  found.unit = "Hz";
  found.value = time_or_cutoff(found.value);
  if (std::isnan(longest)) return;
  found.low = time_or_cutoff(longest);
  found.high = time_or_cutoff(shortest);
}

SensorFilter slowest_filter(const PlantSensor& sensor, double sample_time) {
  SensorFilter filter = sensor.filter;
  if (sensor.finds_cutoff) filter.cutoff = lowest_cutoff(*sensor.finds_cutoff, sample_time);
  return filter;
}

void keep_cutoff_near(const SensorFilter& found, double sample_time, PlantSensor& sensor) {
  constexpr double kNear = 0.5, kHighest = 0.15;
  if (!sensor.finds_cutoff) return;
  double cutoff = kHighest / sample_time;
  if (found.cutoff > 0) cutoff = std::min(cutoff, found.cutoff);
  double& lower = sensor.finds_cutoff->lower;
  lower = std::max(lowest_cutoff(*sensor.finds_cutoff, sample_time), kNear * cutoff);
}

FoundLags lags_found(const std::vector<FittedParameter>& nuisances, const std::string& channel) {
  return {find_nuisance(nuisances, "delay of " + channel),
          find_nuisance(nuisances, "cut-off of " + channel)};
}

void take_found(const FoundLags& found, PlantSensor& sensor) {
  if (found.delay) sensor.delay = found.delay->value;
  if (found.cutoff)
    sensor.filter.cutoff = std::isfinite(found.cutoff->value) ? found.cutoff->value : 0;
}

}  // namespace dashpot
