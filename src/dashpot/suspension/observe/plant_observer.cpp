#include "dashpot/suspension/observe/plant_observer.h"

#include <algorithm>
#include <cmath>
#include <math.h>  // the C text says fabs, not std::fabs

#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr int FILTER_MOST = kMostObserved, FILTER_MOST_SENSORS = kMostObservedSensors,
              FILTER_MOST_INPUTS = kMostObservedInputs, FILTER_MOST_DAMPERS = kMostObservedDampers,
              FILTER_MOST_DAMPER = kMostObservedDamper, FILTER_MOST_MEMORY = kMostMemory;

#include "dashpot/suspension/observe/c_text/plant_filter.h"

/// The text's struct with the models that its functions step.
struct FilterWithDampers : PlantFilter {
  const std::shared_ptr<const DamperModel>* models = nullptr;
};

std::size_t memory_of(const PlantFilter& f, int d) { return static_cast<std::size_t>(f.memory[d]); }

std::size_t state_size(const PlantFilter& f, int d) {
  return static_cast<std::size_t>(f.damper[d] + f.memory[d]);
}

inline double filter_force(const PlantFilter* f, int d, const DamperInput* input, const double* z) {
  return static_cast<const FilterWithDampers*>(f)->models[d]->force(*input, {z, state_size(*f, d)});
}

inline void filter_advance(const PlantFilter* f, int d, const DamperInput* from,
                           const DamperInput* to, double dt, double* z) {
  static_cast<const FilterWithDampers*>(f)->models[d]->advance(*from, *to, dt,
                                                               {z, state_size(*f, d)});
}

FilterWithDampers filter_of(const ObserverTables& t,
                            const std::vector<std::shared_ptr<const DamperModel>>& models) {
  FilterWithDampers f;
  static_cast<PlantFilter&>(f) = {.plant = t.plant,
                                  .inputs = t.inputs,
                                  .drives = t.drives,
                                  .roads = t.roads,
                                  .dampers = t.dampers,
                                  .errors = t.errors,
                                  .shifts = t.shifts,
                                  .sensors = t.sensors,
                                  .steps = t.steps,
                                  .step = t.step,
                                  .road_keep = t.road_keep,
                                  .damper = t.damper.data(),
                                  .memory = t.memory.data(),
                                  .by_way = t.by_way.data(),
                                  .error_keep = t.error_keep.data(),
                                  .transition = t.transition.data(),
                                  .by_start = t.by_start.data(),
                                  .by_end = t.by_end.data(),
                                  .deflection = t.deflection.data(),
                                  .on_ground = t.on_ground.data(),
                                  .sensor_plant = t.sensor_plant.data(),
                                  .sensor_input = t.sensor_input.data(),
                                  .sensor_slope = t.sensor_slope.data(),
                                  .sensor_road = t.sensor_road.data(),
                                  .sensor_force = t.sensor_force.data(),
                                  .sensor_variance = t.sensor_variance.data(),
                                  .process = t.process.data(),
                                  .difference = t.difference.data(),
                                  .way = t.way,
                                  .speed = t.speed,
                                  .shift_added = t.shift_added};
  f.models = models.data();
  return f;
}

void keep(const ObserverTables& t, const FilterSample& told, bool moved, ObservedSample& sample) {
  const std::size_t moving = t.moving(), sensors = static_cast<std::size_t>(t.sensors);
  sample.transition.assign(told.transition, told.transition + (moved ? moving * moving : 0));
  sample.rows.assign(told.rows, told.rows + sensors * t.all());
  sample.innovation.assign(told.innovation, told.innovation + sensors);
  sample.variance.assign(told.variance, told.variance + sensors);
}

/// What the sensors show now, taken in by their rows at the known motion.
void take_along(const FilterWithDampers& f, PlantObserver::Known known,
                std::span<const double> before, std::span<const double> now,
                std::span<const double> measured, std::span<double> estimate,
                std::span<double> covariance, FilterSample& told) {
  filter_expect(&f, before.data(), now.data(), measured.data(), known.estimate.data(),
                known.covariance.data(), &told);
  const auto all = static_cast<std::size_t>(filter_all(&f));
  for (std::size_t s = 0; s < measured.size(); ++s)
    for (std::size_t k = 0; k < all; ++k)
      told.innovation[s] -= told.rows[s * all + k] * (estimate[k] - known.estimate[k]);
  filter_take(&f, estimate.data(), covariance.data(), &told);
}

}  // namespace

PlantObserver::PlantObserver(ObserverTables tables,
                             std::vector<std::shared_ptr<const DamperModel>> dampers)
    : tables_(std::move(tables)), dampers_(std::move(dampers)) {
  // What the arrays of the filter have room for.
  for (const auto& damper : dampers_)
    if (damper->state_size() > kMostMemory)
      throw Error(damper->name(),
                  "has " + std::to_string(damper->state_size()) + " states, and a filter carries " +
                      std::to_string(kMostMemory),
                  "a law of the same damper, as tanh_kwok or bouc_wen");
  const auto require = [](std::size_t count, std::size_t most, const std::string& what) {
    if (count > most)
      throw Error("observer", "has " + std::to_string(count) + " " + what,
                  "at most " + std::to_string(most));
  };
  require(tables_.all(), kMostObserved,
          "numbers to estimate (of plant, dampers and sensors' offsets)");
  require(dampers_.size(), kMostObservedDampers, "dampers");
  require(static_cast<std::size_t>(tables_.sensors), kMostObservedSensors, "sensors");
  require(static_cast<std::size_t>(tables_.inputs), kMostObservedInputs, "inputs");
}

void PlantObserver::before_first(std::span<const double> now, std::span<const double> about,
                                 std::span<double> estimate, std::span<double> covariance) const {
  constexpr double kKnown = 0.1;
  const std::size_t all = tables_.all();
  std::ranges::fill(estimate, 0.0);
  std::ranges::fill(covariance, 0.0);

  // Each damper at rest under its drive; plant and roads as far as they are known.
  const FilterWithDampers f = filter_of(tables_, dampers_);
  for (int d = 0; d < tables_.dampers; ++d)
    if (tables_.memory[static_cast<std::size_t>(d)] == 0)
      dampers_[static_cast<std::size_t>(d)]->rest(
          {0, 0, now[static_cast<std::size_t>(filter_drive(&f, d))]},
          estimate.subspan(static_cast<std::size_t>(filter_own(&f, d)), state_size(f, d)));
  std::ranges::copy(about, estimate.begin());
  remember_first(now, estimate);

  // How uncertain all of it is.
  const auto plant = static_cast<std::size_t>(tables_.plant);
  for (std::size_t k = 0; k < all; ++k) {
    const bool is_velocity = k >= plant / 2 && k < plant;
    const double deviation =
        (!about.empty() && is_velocity ? kKnown : 1) * tables_.first_deviation[k];
    covariance[k * all + k] = deviation * deviation;
  }
}

void PlantObserver::start(std::span<const double> now, std::span<const double> measured,
                          std::span<const double> about, std::span<double> estimate,
                          std::span<double> covariance, ObservedSample& sample) const {
  before_first(now, about, estimate, covariance);
  const FilterWithDampers f = filter_of(tables_, dampers_);
  FilterSample told;
  filter_update(&f, now.data(), now.data(), measured.data(), estimate.data(), covariance.data(),
                &told);
  keep(tables_, told, false, sample);
}

void PlantObserver::step(std::span<const double> before, std::span<const double> now,
                         std::span<const double> measured, std::span<double> estimate,
                         std::span<double> covariance, ObservedSample& sample) const {
  const FilterWithDampers f = filter_of(tables_, dampers_);
  const std::vector<double> past(estimate.begin(), estimate.end());
  FilterSample told;
  filter_predict(&f, before.data(), now.data(), estimate.data(), covariance.data(),
                 told.transition);
  filter_update(&f, before.data(), now.data(), measured.data(), estimate.data(), covariance.data(),
                &told);
  filter_remember(&f, before.data(), now.data(), past.data(), covariance.data(), estimate.data());
  keep(tables_, told, true, sample);
}

void PlantObserver::start_along(Known later, std::span<const double> now,
                                std::span<const double> measured, std::span<const double> about,
                                std::span<double> estimate, std::span<double> covariance,
                                ObservedSample& sample) const {
  before_first(now, about, estimate, covariance);
  FilterSample told;
  take_along(filter_of(tables_, dampers_), later, now, now, measured, estimate, covariance, told);
  keep(tables_, told, false, sample);
}

void PlantObserver::step_along(Known earlier, Known later, std::span<const double> before,
                               std::span<const double> now, std::span<const double> measured,
                               std::span<double> estimate, std::span<double> covariance,
                               ObservedSample& sample) const {
  const FilterWithDampers f = filter_of(tables_, dampers_);
  const std::size_t moving = tables_.moving();
  FilterSample told;

  // Where the known motion goes, and how the estimate lies beside it.
  std::vector<double> known(earlier.estimate.begin(), earlier.estimate.end()), beside(moving);
  for (std::size_t k = 0; k < moving; ++k) beside[k] = estimate[k] - known[k];
  filter_move(&f, before.data(), now.data(), earlier.covariance.data(), known.data(),
              told.transition);
  for (std::size_t i = 0; i < moving; ++i)
    estimate[i] =
        std::inner_product(beside.begin(), beside.end(), &told.transition[i * moving], known[i]);
  filter_spread(&f, told.transition, covariance.data());
  take_along(f, later, before, now, measured, estimate, covariance, told);
  keep(tables_, told, true, sample);
}

void PlantObserver::remember_first(std::span<const double> now, std::span<double> estimate) const {
  const FilterWithDampers f = filter_of(tables_, dampers_);
  const std::vector<double> still(static_cast<std::size_t>(filter_given(&f)));
  for (int d = 0; d < tables_.dampers; ++d) {
    DamperInput rest;
    filter_input(&f, d, now.data(), still.data(), estimate.data(), &rest);
    rest.velocity = 0;
    const auto place = static_cast<std::size_t>(filter_memory(&f, d)), size = memory_of(f, d);
    for (std::size_t copy = 0; copy < 3 && size > 0; ++copy)
      dampers_[static_cast<std::size_t>(d)]->rest(rest,
                                                  estimate.subspan(place + copy * size, size));
  }
}

void PlantObserver::remember(std::span<const double> before, std::span<const double> now,
                             std::span<const double> past, std::span<const double> covariance,
                             std::span<double> estimate) const {
  const FilterWithDampers f = filter_of(tables_, dampers_);
  filter_remember(&f, before.data(), now.data(), past.data(), covariance.data(), estimate.data());
}

PlantObserver::Damper PlantObserver::damper_at(std::size_t damper, std::span<const double> before,
                                               std::span<const double> now, Known known) const {
  const FilterWithDampers f = filter_of(tables_, dampers_);
  double out[4];
  filter_damper(&f, static_cast<int>(damper), before.data(), now.data(), known.estimate.data(),
                known.covariance.data(), out);
  return {out[0], out[1], out[2], out[3]};
}

}  // namespace dashpot
