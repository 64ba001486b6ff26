#include "dashpot/suspension/sweep_measures.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <vector>

#include "dashpot/suspension/domain_use.h"
#include "dashpot/suspension/ride.h"
#include "dashpot/suspension/weighting.h"

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
                 "root mean square of the load that moves over the load at rest", &M::tyre_load_index},
    SweepMeasure{"contact_lost", "1", "Contact lost", "share of the time in which some tyre has no load",
                 &M::contact_lost},
    SweepMeasure{"travel", "m", "Travel", "root mean square of the suspension's", &M::travel},
    SweepMeasure{"greatest_travel", "m", "Greatest travel", "greatest magnitude of the suspension's",
                 &M::greatest_travel},
    SweepMeasure{"stops_met", "1", "Stops met", "share of the time in which a stop is met", &M::stops_met},
    SweepMeasure{"energy", "J", "Energy", "taken by the dampers", &M::energy},
    SweepMeasure{"current", "A", "Current", "mean over time and dampers", &M::current},
    SweepMeasure{"outside_data", "1", "Outside the data",
                 "share of the time in which a damper is asked beyond its data", &M::outside_data},
    SweepMeasure{"diverged_at", "s", "Diverged at", "from when on nothing is finite; empty: never",
                 &M::diverged_at}};

/// A channel from the first sample that counts.
std::span<const double> kept(const Trace& trace, const std::string& channel, std::size_t first) {
  return std::span(trace.record.channel(channel).samples).subspan(first);
}

double greatest_magnitude(std::span<const double> x) {
  double greatest = 0;
  for (const double value : x) greatest = std::max(greatest, std::abs(value));
  return greatest;
}

double mean(std::span<const double> x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

void measure_body(const Plant& plant, const Trace& trace, double dt, double discard, RideMeasures& measures) {
  const auto& body = trace.record.channel(plant.coordinates.front().name + "_acceleration").samples;
  const RideComfort comfort = ride_comfort(find_weighting("Wk"), body, dt, discard);
  measures.body_acceleration = comfort.rms;
  measures.weighted_acceleration = comfort.weighted_rms;
  measures.vibration_dose = comfort.vdv;
}

void measure_tyres(const Plant& plant, const Trace& trace, std::size_t first, RideMeasures& measures) {
  if (plant.tyres.empty()) return;
  const std::size_t count = trace.record.size() - first;
  std::vector<char> lifted(count);
  measures.tyre_load_index = 0;
  for (const Tyre& tyre : plant.tyres) {
    const std::span load = kept(trace, tyre.name + "_load", first);
    double squares = 0;
    for (std::size_t k = 0; k < count; ++k) {
      squares += (load[k] - tyre.static_load) * (load[k] - tyre.static_load);
      lifted[k] |= load[k] <= 0;
    }
    const double index = std::sqrt(squares / static_cast<double>(count)) / tyre.static_load;
    measures.tyre_load_index = std::max(measures.tyre_load_index, index);
  }
  measures.contact_lost = static_cast<double>(std::ranges::count(lifted, 1)) / static_cast<double>(count);
}

void measure_struts(const Plant& plant, const Trace& trace, std::size_t first, RideMeasures& measures) {
  const std::size_t count = trace.record.size() - first;
  std::vector<char> met(count);
  measures.travel = measures.greatest_travel = measures.energy = measures.current = 0;
  for (const Strut& strut : plant.struts) {
    const std::span x = kept(trace, strut.name + "_deflection", first);
    const std::span v = kept(trace, strut.name + "_velocity", first);
    const std::span force = kept(trace, strut.name + "_force", first);
    measures.travel = std::max(measures.travel, root_mean_square(x));
    measures.greatest_travel = std::max(measures.greatest_travel, greatest_magnitude(x));
    measures.current +=
        mean(kept(trace, strut.name + "_current", first)) / static_cast<double>(plant.struts.size());
    for (std::size_t k = 0; k < count; ++k) {
      met[k] |= (strut.extension_stop > 0 && x[k] > strut.extension_stop) ||
                (strut.compression_stop > 0 && x[k] < -strut.compression_stop);
      if (k > 0)
        measures.energy += 0.5 * (force[k] * v[k] + force[k - 1] * v[k - 1]) *
                           (trace.record.time[first + k] - trace.record.time[first + k - 1]);
    }
  }
  measures.stops_met = static_cast<double>(std::ranges::count(met, 1)) / static_cast<double>(count);
}

}  // namespace

RideMeasures measure_ride(const Vehicle& vehicle, const Trace& trace, double discard) {
  RideMeasures measures;
  if (trace.diverged_at) {
    measures.diverged_at = *trace.diverged_at;
    return measures;
  }
  const std::vector<double>& time = trace.record.time;
  const double dt = time.size() > 1 ? time[1] - time[0] : 0;
  const auto first = static_cast<std::size_t>(std::lround(discard / dt));
  const Plant& plant = vehicle.set.plant;
  measure_body(plant, trace, dt, discard, measures);
  measure_tyres(plant, trace, first, measures);
  measure_struts(plant, trace, first, measures);
  measures.outside_data = 0;
  for (const DomainUse& use : domain_use(vehicle, trace))
    measures.outside_data = std::max(measures.outside_data, use.any());
  return measures;
}

std::span<const SweepMeasure> sweep_measures() { return kMeasures; }

std::span<const SweepMeasure> judged_measures() { return std::span(kMeasures).first(kMeasures.size() - 1); }

}  // namespace dashpot
