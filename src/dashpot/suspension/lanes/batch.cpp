#include "dashpot/suspension/lanes/batch.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/nets/aligned.h"
#include "dashpot/error.h"
#include "dashpot/numerics/root_mean_square.h"
#include "dashpot/suspension/lanes/lane_pilot.h"
#include "dashpot/suspension/lanes/lane_vehicle.h"
#include "dashpot/suspension/ride/weighting.h"
#include "dashpot/suspension/trace.h"

namespace dashpot {
namespace {

/// Vehicles that ride side by side, by their place in the batch.
struct Group {
  LaneShape shape;
  std::vector<std::size_t> members;
};

std::size_t samples_within(double time, double step) {
  return static_cast<std::size_t>(std::floor(time / step * (1 + 1e-12) + 1e-9));
}

/// Rows of numbers, a number per lane, from the numbers of each lane.
class Rows {
 public:
  Rows(std::size_t lanes, std::size_t count) : lanes_(lanes), values_(lanes * count) {}
  void set(std::size_t lane, std::span<const double> numbers) {
    for (std::size_t k = 0; k < numbers.size(); ++k) values_[k * lanes_ + lane] = numbers[k];
  }
  double at(std::size_t row, std::size_t lane) const { return values_[row * lanes_ + lane]; }
  double* data() { return values_.data(); }

 private:
  std::size_t lanes_;
  AlignedVector<double> values_;
};

/// Vehicles of one shape, at most as many as there are lanes, which ride side by side.
class LaneBatch {
 public:
  LaneBatch(std::span<const BatchVehicle> vehicles, const BatchOptions& options,
            const LaneShape& shape, std::span<const std::size_t> members, const RideKernel& kernel)
      : options_(options), members_(members), kernel_(kernel), lanes_(kernel.lanes) {
    // One vehicle per lane; where there are too few, the last one again.
    for (std::size_t lane = 0; lane < lanes_; ++lane)
      vehicles_.push_back(&vehicles[members[std::min(lane, members.size() - 1)]]);

    // The shape that all have in common, and the options.
    ride_.equations = shape.equations.struts > 0 ? &shape.equations : nullptr;
    ride_.kind = shape.damper.kind;
    ride_.law = shape.damper.law;
    ride_.lags = shape.damper.lags;
    ride_.resists_more = shape.resists_more;
    ride_.control_law = shape.control;
    ride_.moderate = shape.moderate;
    ride_.network = &shape.damper.network;
    ride_.sample_time = shape.sample_time;
    ride_.relative_tolerance = options.relative_tolerance;
    ride_.absolute_tolerance = options.absolute_tolerance;
    ride_.samples = samples_within(options.duration, shape.sample_time);
    ride_.discarded = samples_within(options.discard, shape.sample_time);
  }

  /// Writes to the places of these vehicles in `results`.
  void run(std::span<BatchResult> results) {
    // Each vehicle as numbers, side by side.
    std::vector<LaneVehicle> lanes;
    for (const BatchVehicle* vehicle : vehicles_) lanes.push_back(lane_vehicle(*vehicle));
    Rows numbers(lanes_, lanes[0].numbers.size()), damper(lanes_, lanes[0].damper.size()),
        start(lanes_, lanes[0].start.size()), control(lanes_, lanes[0].control.size()),
        sums(lanes_, place_of_tyre(plant(0).tyres.size())),
        trace(lanes_, options_.traces ? (ride_.samples + 1) * rows_of_trace() : 0);
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      numbers.set(lane, lanes[lane].numbers);
      damper.set(lane, lanes[lane].damper);
      start.set(lane, lanes[lane].start);
      control.set(lane, lanes[lane].control);
    }

    // The ride asks the pilot for road and commands, and writes sums and traces.
    const std::vector<Biquad> weighting = weighting_filter(find_weighting("Wk"), ride_.sample_time);
    LanePilot pilot(std::span<const BatchVehicle* const>(vehicles_).first(members_.size()), lanes_);
    pilot.take(ride_);
    ride_.numbers = numbers.data();
    ride_.damper = damper.data();
    ride_.damper_size = lanes[0].damper.size() / plant(0).struts.size();
    ride_.start = start.data();
    ride_.control_numbers = lanes[0].control.empty() ? nullptr : control.data();
    static_assert(sizeof(Biquad) == 5 * sizeof(double), "b0, b1, b2, a1, a2 without gaps");
    assert(weighting.size() == kWeightingSections);
    ride_.weighting = &weighting[0].b0;
    ride_.results = sums.data();
    ride_.trace = options_.traces ? trace.data() : nullptr;
    kernel_.run(ride_);

    for (std::size_t lane = 0; lane < members_.size(); ++lane) {
      results[members_[lane]] = result_of(sums, lane);
      if (options_.traces)
        results[members_[lane]].trace = trace_of(trace, lane, results[members_[lane]]);
    }
  }

 private:
  const Plant& plant(std::size_t lane) const { return vehicles_[lane]->setting.plant; }
  /// LaneRide::results: the first row of a strut, and of a tyre.
  std::size_t place_of_strut(std::size_t strut) const {
    return kLaneResults + strut * kLaneStrutResults;
  }
  std::size_t place_of_tyre(std::size_t tyre) const {
    return place_of_strut(plant(0).struts.size()) + tyre * kLaneTyreResults;
  }
  std::size_t rows_of_trace() const {
    return trace_rows(plant(0).size(), plant(0).struts.size(), plant(0).tyres.size());
  }

  BatchResult result_of(const Rows& sums, std::size_t lane) const {
    BatchResult result{.in_lanes = true};
    const auto sum = [&](std::size_t row) { return sums.at(row, lane); };

    // A ride that diverged counts up to there.
    std::size_t end = ride_.samples + 1;
    if (sum(kDivergedAt) > 0) {
      end = static_cast<std::size_t>(sum(kDivergedAt));
      result.diverged_at = ride_.sample_time * sum(kDivergedAt);
    }
    const double count = static_cast<double>(std::max(end, ride_.discarded + 1) - ride_.discarded);
    const auto root_mean = [&](std::size_t row) { return std::sqrt(sum(row) / count); };
    const auto struts = static_cast<double>(plant(lane).struts.size());

    BatchMeasures& m = result.measures;
    m = {.body_acceleration = root_mean(kAcceleration2),
         .weighted_acceleration = root_mean(kWeighted2),
         .vibration_dose = std::pow(sum(kWeighted4) * ride_.sample_time, 0.25),
         .contact_lost = sum(kContactLost) / count,
         .energy = sum(kPower) * ride_.sample_time,
         .current = sum(kCurrentSum) / (count * struts)};

    // The worst strut, and the worst tyre.
    for (std::size_t s = 0; s < plant(lane).struts.size(); ++s) {
      m.deflection = std::max(m.deflection, root_mean(place_of_strut(s) + kDeflection2));
      m.greatest_deflection =
          std::max(m.greatest_deflection, sum(place_of_strut(s) + kGreatestDeflection));
    }
    for (std::size_t w = 0; w < plant(lane).tyres.size(); ++w) {
      m.tyre_load = std::max(m.tyre_load, root_mean(place_of_tyre(w) + kLoad2));
      m.tyre_deflection =
          std::max(m.tyre_deflection, root_mean(place_of_tyre(w) + kTyreDeflection2));
    }
    result.missed_tolerance = sum(kMissed) > 0;
    result.evaluations = static_cast<std::size_t>(sum(kEvaluations));
    return result;
  }

  /// Channels in the order of trace_rows().
  Record trace_of(const Rows& rows, std::size_t lane, const BatchResult& result) const {
    Record record;
    record.name = plant(lane).name;
    record.condition = vehicles_[lane]->setting.ground.description();
    record.source = "simulation";

    // A ride that diverged ends there.
    std::size_t count = ride_.samples + 1;
    if (result.diverged_at)
      count = static_cast<std::size_t>(std::lround(*result.diverged_at / ride_.sample_time));
    for (std::size_t k = 0; k < count; ++k)
      record.time.push_back(ride_.sample_time * static_cast<double>(k));

    const auto channel = [&](const std::string& name, const std::string& unit) {
      record.channels.push_back({.name = name, .unit = unit, .origin = "simulated"});
      record.channels.back().samples.resize(count);
    };
    for (const Coordinate& c : plant(lane).coordinates) {
      channel(c.name, c.unit);
      channel(c.name + "_velocity", c.unit + "/s");
      channel(c.name + "_acceleration", c.unit + "/s^2");
    }
    for (const Strut& strut : plant(lane).struts) {
      channel(strut.name + "_deflection", "m");
      channel(strut.name + "_velocity", "m/s");
      channel(strut.name + "_force", "N");
      channel(strut.name + "_current", "A");
    }
    for (const Tyre& tyre : plant(lane).tyres) {
      channel(tyre.name + "_road", "m");
      channel(tyre.name + "_load", "N");
    }

    const std::size_t width = record.channels.size();
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t row = 0; row < width; ++row)
        record.channels[row].samples[k] = rows.at(k * width + row, lane);
    return record;
  }

  const BatchOptions& options_;
  std::span<const std::size_t> members_;
  const RideKernel& kernel_;
  std::size_t lanes_;
  std::vector<const BatchVehicle*> vehicles_;
  LaneRide ride_;
};

/// The measures of a ride by simulate(), by the same definitions as in lanes.
BatchMeasures measures_of(const Trace& trace, const Plant& plant, double dt,
                          std::size_t discarded) {
  const std::size_t first = std::min(discarded, trace.record.time.size() - 1);
  const auto samples = [&](const std::string& name) {
    return std::span(trace.record.channel(name).samples).subspan(first);
  };

  // Comfort, of the body.
  const std::vector<double>& acceleration =
      trace.record.channel(plant.coordinates[0].name + "_acceleration").samples;
  const std::vector<double> weighted = weigh(find_weighting("Wk"), acceleration, dt);
  BatchMeasures m{.body_acceleration = root_mean_square(std::span(acceleration).subspan(first)),
                  .weighted_acceleration = root_mean_square(std::span(weighted).subspan(first)),
                  .contact_lost = trace.contact_lost};
  double fourth = 0;
  for (const double a : std::span(weighted).subspan(first)) fourth += a * a * a * a;
  m.vibration_dose = std::pow(fourth * dt, 0.25);

  // The worst strut; energy and current of all.
  for (const Strut& strut : plant.struts) {
    const auto travel = samples(strut.name + "_deflection"),
               current = samples(strut.name + "_current");
    m.deflection = std::max(m.deflection, root_mean_square(travel));
    for (const double x : travel)
      m.greatest_deflection = std::max(m.greatest_deflection, std::abs(x));
    m.energy += damper_energy(trace.record, strut, first);
    for (const double i : current)
      m.current += i / static_cast<double>(current.size() * plant.struts.size());
  }

  // The worst tyre.
  for (const Tyre& tyre : plant.tyres) {
    const auto load = samples(tyre.name + "_load");
    std::vector<double> more(load.begin(), load.end());
    for (double& value : more) value -= tyre.static_load;
    m.tyre_load = std::max(m.tyre_load, root_mean_square(more));
    m.tyre_deflection =
        std::max(m.tyre_deflection, root_mean_square(samples(tyre.name + "_deflection")));
  }
  return m;
}

BatchResult alone(const BatchVehicle& vehicle, const BatchOptions& options) {
  const double dt = sample_time_of(vehicle);
  Trace trace = simulate(vehicle.setting, {.duration = options.duration,
                                           .output_step = dt,
                                           .discard = options.discard,
                                           .relative_tolerance = options.relative_tolerance,
                                           .absolute_tolerance = options.absolute_tolerance,
                                           .sensors = vehicle.sensors,
                                           .limits = vehicle.limits,
                                           .monitor = options.monitor});
  BatchResult result{.measures = measures_of(trace, vehicle.setting.plant, dt,
                                             samples_within(options.discard, dt)),
                     .diverged_at = trace.diverged_at,
                     .evaluations = trace.evaluations};
  for (const std::string& warning : trace.warnings)
    result.missed_tolerance = result.missed_tolerance || warning.starts_with("the tolerance");
  if (options.traces) result.trace = std::move(trace.record);
  return result;
}

void require_options(std::span<const BatchVehicle> vehicles, const BatchOptions& options) {
  if (!(options.discard >= 0 && options.discard < options.duration))
    throw Error("batch", "the whole ride is left out of the measures");
  for (const BatchVehicle& vehicle : vehicles)
    require_fitting(vehicle.setting, {.duration = options.duration,
                                      .relative_tolerance = options.relative_tolerance,
                                      .absolute_tolerance = options.absolute_tolerance,
                                      .limits = vehicle.limits});
}

/// Groups of vehicles of one shape; `others` takes those that cannot ride in lanes.
std::vector<Group> groups_of(std::span<const BatchVehicle> vehicles,
                             std::vector<std::size_t>& others) {
  std::vector<Group> groups;
  for (std::size_t k = 0; k < vehicles.size(); ++k) {
    if (!reason_against_lanes(vehicles[k]).empty()) {
      others.push_back(k);
      continue;
    }

    const LaneShape shape = lane_vehicle(vehicles[k]).shape;
    const auto same = std::find_if(groups.begin(), groups.end(),
                                   [&](const Group& g) { return g.shape == shape; });
    if (same != groups.end())
      same->members.push_back(k);
    else
      groups.push_back({shape, {k}});
  }
  return groups;
}

}  // namespace

std::vector<BatchResult> simulate_batch(std::span<const BatchVehicle> vehicles,
                                        const BatchOptions& options) {
  require_options(vehicles, options);

  // Groups of vehicles that can ride side by side are cut into batches as wide as the lanes.
  std::vector<std::size_t> others;
  const std::vector<Group> groups = groups_of(vehicles, others);
  std::vector<LaneBatch> batches;
  const RideKernel& kernel = ride_kernel(vehicles.size());
  for (const Group& group : groups)
    for (std::size_t first = 0; first < group.members.size(); first += kernel.lanes)
      batches.emplace_back(
          vehicles, options, group.shape,
          std::span(group.members)
              .subspan(first, std::min(kernel.lanes, group.members.size() - first)),
          kernel);

  // Batches and single vehicles are tasks alike; each writes to places of its own.
  std::vector<BatchResult> results(vehicles.size());
  parallel_for(batches.size() + others.size(), options.threads, [&](std::size_t task) {
    options.monitor.check();
    if (task < batches.size())
      batches[task].run(results);
    else
      results[others[task - batches.size()]] =
          alone(vehicles[others[task - batches.size()]], options);
  });
  return results;
}

}  // namespace dashpot
