#include "dashpot/machine/ride_rank.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/numerics/root_mean_square.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "dashpot/suspension/ride/ride.h"
#include "dashpot/suspension/ride/ride_measures.h"
#include "dashpot/suspension/ride/weighting.h"
#include "dashpot/suspension/sweep/statistics.h"

namespace dashpot {
namespace {

double rms_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

double greatest_rms(const std::vector<std::vector<double>>& signals) {
  double greatest = 0;
  for (const std::vector<double>& signal : signals)
    greatest = std::max(greatest, root_mean_square(signal));
  return greatest;
}

/// The median, and the interval between the quantiles of 5 % and 95 %.
Estimate estimate_of(std::vector<double> values) {
  std::ranges::sort(values);
  const auto quantile = [&](double share) { return quantile_of(values, share).value; };
  return {quantile(0.5), quantile(0.05), quantile(0.95)};
}

/// What a vehicle asks beyond the bench, no recording tells: the interval is wider by this factor
/// to both sides. With it 90 % of the true errors of the first four dampers of `dashpot study
/// ride-rank` lie inside, and of those of the seven others, which had no say in it.
constexpr double kBeyondBench = 1.45;

/// The interval of an error, and of a difference that is no greater than that error.
Estimate widened(const Estimate& error) {
  return {error.value, error.low / kBeyondBench, error.high * kBeyondBench};
}
Estimate widened(const Estimate& excess, const Estimate& error) {
  const double more = (kBeyondBench - 1) * error.value;
  return {excess.value, excess.low - more, excess.high + more};
}

/// Why a model is not ridden; empty where it is.
std::string refusal_of(const RankedModel& model) {
  if (!is_usable(model)) return "it has no usable force on the records left out";
  if (!model.dissipation.dissipates())
    return "it feeds energy into what moves it: its ride would be its own shaking";
  if (!model.forgetting.is_forgotten()) return "it does not forget how it began";
  return "";
}

}  // namespace

RideSignals ride_signals(const Plant& plant, const Record& trace, double discard) {
  const double dt = trace.time.at(1) - trace.time.at(0);
  const auto first = static_cast<std::ptrdiff_t>(std::lround(discard / dt));
  const auto counted = [&](const std::vector<double>& all, double factor, double offset) {
    std::vector<double> values(all.begin() + first, all.end());
    for (double& value : values) value = factor * (value - offset);
    return values;
  };

  // Comfort where the first coordinate is, as ride_measures() has it; then tyres and struts.
  RideSignals signals;
  const Channel& body = trace.channel(plant.coordinates.front().name + "_acceleration");
  signals[kComfort].push_back(counted(weigh(find_weighting("Wk"), body.samples, dt), 1, 0));
  for (const Tyre& tyre : plant.tyres)
    signals[kTyreLoad].push_back(counted(trace.channel(tyre.name + "_load").samples,
                                         100 / tyre.static_load, tyre.static_load));
  for (const Strut& strut : plant.struts)
    signals[kTravel].push_back(counted(trace.channel(strut.name + "_deflection").samples, 1000, 0));
  return signals;
}

RideDifference ride_difference(const RideSignals& ride, const RideSignals& reference) {
  RideDifference difference;
  double squares = 0;
  for (std::size_t q = 0; q < kRideQuantities; ++q) {
    for (std::size_t k = 0; k < ride[q].size(); ++k)
      difference.trace[q] =
          std::max(difference.trace[q], rms_difference(ride[q][k], reference[q][k]));
    const double whole = greatest_rms(reference[q]);
    difference.excess[q] = greatest_rms(ride[q]) - whole;
    squares += whole > 0 ? std::pow(difference.trace[q] / whole, 2) : 0;
  }
  difference.share = 100 * std::sqrt(squares / static_cast<double>(kRideQuantities));
  return difference;
}

void require_ridable(const RideRankOptions& options) {
  if (options.draws < 2)
    throw Error("--draws", std::to_string(options.draws) + " gives no interval", "20");
  const PlantSet set = load_plant(options.vehicle);
  if (set.plant.struts.empty())
    throw Error("--plant", set.name + " has no place for a damper",
                "a plant with struts: dashpot ride --list plants");
  if (set.plant.tyres.empty())
    throw Error("--plant", set.name + " has no tyres, so that it does not ride", "a car or a bus");
  if (make_ground(options.road, options.seed, "--road")->shakes())
    throw Error("--road", "'" + options.road + "' shakes buildings, not the " + set.plant.name,
                "a road, a bump");

  // The other words are tried with any damper; what needs a model's law waits for the models.
  VehicleWords trial = options.vehicle;
  trial.dampers = {"ideal"};
  trial.inverse.clear();
  trial.force_loop.clear();
  trial.current = 0;
  make_vehicle(trial);
}

std::vector<OtherDamper> possible_dampers(const ModelFile& model, const ErrorModel& errors,
                                          const RideRankOptions& options) {
  const ChosenDamper damper = choose_damper(model);
  std::vector<OtherDamper> dampers;
  for (int k = 0; k < options.draws; ++k)
    dampers.push_back({erring(damper.model, errors.draw(options.duration,
                                                        options.seed + static_cast<unsigned>(k))),
                       damper.lag_rate});
  return dampers;
}

RiddenModel::RiddenModel(const ModelFile& model, const GroundMotion& ground,
                         const RideRankOptions& options)
    : options_(options), ground_(ground), vehicle_(make_vehicle(options.vehicle, model)) {
  const Trace trace = ride(vehicle_.dampers);
  if (trace.diverged_at) throw Error("", "its ride diverges");
  own_ = ride_signals(vehicle_.set.plant, trace.record, usual_discard(ground, options.duration));
  warnings_ = trace.warnings;
}

Trace RiddenModel::ride(const std::vector<MountedDamper>& dampers) const {
  SimulateOptions settings = vehicle_.options(options_.duration);
  settings.monitor = options_.monitor;
  return simulate({vehicle_.set.plant, dampers, ground_, vehicle_.controller.get()}, settings);
}

std::optional<RideDifference> RiddenModel::against(const OtherDamper& damper) const {
  // The springs bear what the damper has at rest.
  std::vector<MountedDamper> dampers = vehicle_.dampers;
  for (MountedDamper& mounted : dampers) {
    mounted.model = damper.model->with_offset(-force_at_rest(*damper.model, mounted.current));
    if (options_.vehicle.lag_rate < 0) mounted.driver.lag_rate = damper.lag_rate;
  }

  const Trace trace = ride(dampers);
  if (trace.diverged_at) return std::nullopt;
  return ride_difference(own_, ride_signals(vehicle_.set.plant, trace.record,
                                            usual_discard(ground_, options_.duration)));
}

PredictedRide RiddenModel::predicted(std::span<const OtherDamper> dampers) const {
  PredictedRide predicted{.warnings = warnings_};
  std::vector<RideDifference> differences;
  for (const OtherDamper& damper : dampers)
    if (const std::optional<RideDifference> difference = against(damper))
      differences.push_back(*difference);
  if (differences.size() < dampers.size()) {
    predicted.refusal = "the ride diverges with a damper that the recordings allow";
    return predicted;
  }

  const auto over_dampers = [&](const auto& figure) {
    std::vector<double> values;
    for (const RideDifference& one : differences) values.push_back(figure(one));
    return estimate_of(std::move(values));
  };
  predicted.error = widened(over_dampers([](const RideDifference& d) { return d.share; }));
  const std::array traces{&predicted.acceleration, &predicted.tyre_load, &predicted.travel};
  const std::array excesses{&predicted.acceleration_excess, &predicted.tyre_load_excess,
                            &predicted.travel_excess};
  for (std::size_t q = 0; q < kRideQuantities; ++q) {
    *traces[q] = widened(over_dampers([q](const RideDifference& d) { return d.trace[q]; }));
    *excesses[q] =
        widened(over_dampers([q](const RideDifference& d) { return d.excess[q]; }), *traces[q]);
  }
  return predicted;
}

void predict_rides(Ranking& ranking, const Dataset& dataset, const RideRankOptions& options) {
  // What each model's errors tell, and which of them tells most of the damper.
  std::vector<std::optional<ErrorModel>> errors(ranking.models.size());
  parallel_for(errors.size(), options.threads, [&](std::size_t m) {
    RankedModel& model = ranking.models[m];
    model.ride = PredictedRide{.refusal = refusal_of(model)};
    if (model.ride->refusal.empty()) errors[m].emplace(model.left_out.records);
  });
  const auto unexplained = [](const std::optional<ErrorModel>& one) {
    return one ? one->unexplained() : INFINITY;
  };
  const auto best = std::ranges::min_element(errors, {}, unexplained);
  if (best == errors.end() || !*best) return;
  const RankedModel& known = ranking.models[static_cast<std::size_t>(best - errors.begin())];
  const std::vector<OtherDamper> dampers =
      possible_dampers(to_model_file(known, dataset, ""), **best, options);

  // Each model's ride beside those of the dampers.
  const GroundPointer ground = make_ground(options.road, options.seed, "--road");
  parallel_for(errors.size(), options.threads, [&](std::size_t m) {
    if (!errors[m]) return;
    RankedModel& model = ranking.models[m];
    options.monitor.report("riding " + model.name,
                           static_cast<double>(m) / static_cast<double>(errors.size()));
    try {
      model.ride =
          RiddenModel(to_model_file(model, dataset, ""), *ground, options).predicted(dampers);
    } catch (const Error& error) {
      model.ride->refusal = error.what();
    }
  });

  // What they all went through.
  const VehicleWords& words = options.vehicle;
  ranking.ridden = {.vehicle = load_plant(words).plant.title,
                    .road = ground->description(),
                    .controller = words.controller.empty() ? format_number(words.current) + ' ' +
                                                                 to_string(dataset.drive_unit)
                                                           : words.controller,
                    .duration = options.duration,
                    .known_by = known.name,
                    .unexplained = (*best)->unexplained(),
                    .draws = dampers.size()};
}

}  // namespace dashpot
