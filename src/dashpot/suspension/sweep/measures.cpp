#include "dashpot/suspension/sweep/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "dashpot/suspension/ride/domain_use.h"
#include "dashpot/suspension/trace.h"

namespace dashpot {
namespace {

using M = RideMeasures;

constexpr std::array kMeasures{
    SweepMeasure{"body_acceleration", "m/s^2", "Body acceleration", "root mean square",
                 &M::body_acceleration},
    SweepMeasure{"weighted_acceleration", "m/s^2", "Weighted acceleration",
                 "root mean square by Wk of ISO 2631-1", &M::weighted_acceleration},
    SweepMeasure{"vibration_dose", "m/s^1.75", "Vibration dose", "VDV: fourth-power dose, by Wk",
                 &M::vibration_dose},
    SweepMeasure{"tyre_load_index", "1", "Tyre load index",
                 "root mean square of the load that moves over the load at rest",
                 &M::tyre_load_index},
    SweepMeasure{"contact_lost", "1", "Contact lost",
                 "share of the time in which some tyre has no load", &M::contact_lost},
    SweepMeasure{"travel", "m", "Travel", "root mean square of the suspension's", &M::travel},
    SweepMeasure{"greatest_travel", "m", "Greatest travel",
                 "greatest magnitude of the suspension's", &M::greatest_travel},
    SweepMeasure{"stops_met", "1", "Stops met", "share of the time in which a stop is met",
                 &M::stops_met},
    SweepMeasure{"energy", "J", "Energy", "taken by the dampers", &M::energy},
    SweepMeasure{"current", "A", "Current",
                 "mean over time and dampers; V, or a place from 0 to 1, where that drives them",
                 &M::current},
    SweepMeasure{"outside_data", "1", "Outside the data",
                 "share of the time in which a damper is asked beyond its data", &M::outside_data},
    SweepMeasure{"diverged_at", "s", "Diverged at", "from when on nothing is finite; empty: never",
                 &M::diverged_at}};

// The measure of the drive where it is known what drives: by DriveUnit, then for unlike ones.
constexpr std::array kDrives{
    SweepMeasure{"current", "1", "Drive, 0 ... 1",
                 "mean over time and dampers, of their places from 0 to 1", &M::current},
    SweepMeasure{"current", "A", "Current", "mean over time and dampers", &M::current},
    SweepMeasure{"current", "V", "Voltage", "mean over time and dampers", &M::current},
    SweepMeasure{"current", "A|V|1", "Drive",
                 "mean over time and dampers, in what drives those of the controller",
                 &M::current}};

static_assert(static_cast<int>(DriveUnit::None) == 0 && static_cast<int>(DriveUnit::Ampere) == 1 &&
              static_cast<int>(DriveUnit::Volt) == 2);

/// A channel from the first sample that counts.
std::span<const double> kept(const Trace& trace, const std::string& channel, std::size_t first) {
  return std::span(trace.record.channel(channel).samples).subspan(first);
}

/// Of the tyre whose load moves most for the load that it carries.
double tyre_load_index(const Plant& plant, const Trace& trace, std::size_t first) {
  double greatest = 0;
  for (const Tyre& tyre : plant.tyres) {
    const std::span load = kept(trace, tyre.name + "_load", first);
    double squares = 0;
    for (const double value : load)
      squares += (value - tyre.static_load) * (value - tyre.static_load);
    const double rms = std::sqrt(squares / static_cast<double>(load.size()));
    greatest = std::max(greatest, rms / tyre.static_load);
  }
  return greatest;
}

bool has_stops(const Plant& plant) {
  return std::ranges::any_of(
      plant.struts, [](const Strut& s) { return s.extension_stop > 0 || s.compression_stop > 0; });
}

bool has_domain(const Vehicle& vehicle) {
  return std::ranges::any_of(vehicle.domains,
                             [](const auto& domain) { return domain.has_value(); });
}

}  // namespace

bool needs_trace(const Vehicle& vehicle) {
  return vehicle.set.plant.tyres.size() > 1 || has_stops(vehicle.set.plant) || has_domain(vehicle);
}

RideMeasures measure_ride(const Vehicle& vehicle, const BatchResult& result, double discard) {
  if (result.diverged_at) return {.diverged_at = *result.diverged_at};

  // The batch's own sums serve a vehicle with one tyre and without stops or limits of data.
  const Plant& plant = vehicle.set.plant;
  const BatchMeasures& m = result.measures;
  RideMeasures measures{
      .body_acceleration = m.body_acceleration,
      .weighted_acceleration = m.weighted_acceleration,
      .vibration_dose = m.vibration_dose,
      .tyre_load_index = plant.tyres.empty() ? 0 : m.tyre_load / plant.tyres[0].static_load,
      .contact_lost = m.contact_lost,
      .travel = m.deflection,
      .greatest_travel = m.greatest_deflection,
      .stops_met = 0,
      .energy = m.energy,
      .current = m.current,
      .outside_data = 0};
  if (!needs_trace(vehicle)) return measures;

  // The rest comes from the trace.
  const Trace trace{.record = result.trace};
  const std::vector<double>& time = trace.record.time;
  const auto first =
      static_cast<std::size_t>(std::ranges::lower_bound(time, discard) - time.begin());
  if (plant.tyres.size() > 1) measures.tyre_load_index = tyre_load_index(plant, trace, first);
  measures.stops_met = stops_met(trace.record, plant, first);
  for (const DomainUse& use : domain_use(vehicle, trace))
    measures.outside_data = std::max(measures.outside_data, use.any());
  return measures;
}

const SweepMeasure& as_driven(const SweepMeasure& measure, const std::optional<DriveUnit>& drive) {
  if (measure.field != &RideMeasures::current) return measure;
  return drive ? kDrives[static_cast<std::size_t>(*drive)] : kDrives.back();
}

std::span<const SweepMeasure> sweep_measures() { return kMeasures; }

std::span<const SweepMeasure> judged_measures() {
  return std::span(kMeasures).first(kMeasures.size() - 1);
}

}  // namespace dashpot
