#include "dashpot/suspension/observe/plant_observer.h"

#include <algorithm>
#include <cmath>
#include <math.h>  // the C text says fabs, not std::fabs

#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr int FILTER_MOST = kMostObserved, FILTER_MOST_SENSORS = kMostObservedSensors,
              FILTER_MOST_INPUTS = kMostObservedInputs, FILTER_MOST_DAMPER = kMostObservedDamper;

#include "dashpot/suspension/observe/c_text/plant_filter.h"

/// The text's struct with the model that its functions step.
struct FilterWithDamper : PlantFilter {
  const DamperModel* model = nullptr;
};

inline double filter_force(const PlantFilter* f, const DamperInput* input, const double* z) {
  return static_cast<const FilterWithDamper*>(f)->model->force(
      *input, {z, static_cast<std::size_t>(f->damper)});
}

inline void filter_advance(const PlantFilter* f, const DamperInput* from, const DamperInput* to,
                           double dt, double* z) {
  static_cast<const FilterWithDamper*>(f)->model->advance(*from, *to, dt,
                                                          {z, static_cast<std::size_t>(f->damper)});
}

FilterWithDamper filter_of(const ObserverTables& t, const DamperModel& model) {
  FilterWithDamper f;
  static_cast<PlantFilter&>(f) = {.plant = t.plant,
                                  .inputs = t.inputs,
                                  .roads = t.roads,
                                  .errors = t.errors,
                                  .damper = t.damper,
                                  .sensors = t.sensors,
                                  .steps = t.steps,
                                  .step = t.step,
                                  .road_keep = t.road_keep,
                                  .force_keep = t.force_keep.data(),
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
                                  .speed = t.speed};
  f.model = &model;
  return f;
}

void keep(const ObserverTables& t, const FilterSample& told, bool moved, ObservedSample& sample) {
  const std::size_t moving = t.moving(), sensors = static_cast<std::size_t>(t.sensors);
  sample.transition.assign(told.transition, told.transition + (moved ? moving * moving : 0));
  sample.rows.assign(told.rows, told.rows + sensors * t.all());
  sample.innovation.assign(told.innovation, told.innovation + sensors);
  sample.variance.assign(told.variance, told.variance + sensors);
}

}  // namespace

PlantObserver::PlantObserver(ObserverTables tables, std::shared_ptr<const DamperModel> damper)
    : tables_(std::move(tables)), damper_(std::move(damper)) {
  if (!damper_->flows())
    throw Error(damper_->name(), "its states have no rates: a filter cannot follow them",
                "a law, a hybrid, or a network without a feedback of its force");
  const auto require = [](std::size_t count, std::size_t most, const std::string& what) {
    if (count > most)
      throw Error("observer", "has " + std::to_string(count) + " " + what,
                  "at most " + std::to_string(most));
  };
  require(tables_.all(), kMostObserved,
          "numbers to estimate (of plant, damper and sensors' offsets)");
  require(damper_->state_size(), kMostObservedDamper, "numbers of the damper's state");
  require(static_cast<std::size_t>(tables_.sensors), kMostObservedSensors, "sensors");
  require(static_cast<std::size_t>(tables_.inputs), kMostObservedInputs, "inputs");
}

void PlantObserver::start(std::span<const double> now, std::span<const double> measured,
                          std::span<const double> about, std::span<double> estimate,
                          std::span<double> covariance, ObservedSample& sample) const {
  constexpr double kKnown = 0.1;
  const std::size_t all = tables_.all(), own = tables_.moving() - damper_->state_size();
  std::ranges::fill(estimate, 0.0);
  std::ranges::fill(covariance, 0.0);
  damper_->rest({0, 0, now.back()}, estimate.subspan(own, damper_->state_size()));
  std::ranges::copy(about, estimate.begin());
  const auto plant = static_cast<std::size_t>(tables_.plant);
  for (std::size_t k = 0; k < all; ++k) {
    const bool is_velocity = k >= plant / 2 && k < plant;
    const double deviation =
        (!about.empty() && is_velocity ? kKnown : 1) * tables_.first_deviation[k];
    covariance[k * all + k] = deviation * deviation;
  }

  const FilterWithDamper f = filter_of(tables_, *damper_);
  FilterSample told;
  filter_update(&f, now.data(), now.data(), measured.data(), estimate.data(), covariance.data(),
                &told);
  keep(tables_, told, false, sample);
}

void PlantObserver::step(std::span<const double> before, std::span<const double> now,
                         std::span<const double> measured, std::span<double> estimate,
                         std::span<double> covariance, ObservedSample& sample) const {
  const FilterWithDamper f = filter_of(tables_, *damper_);
  FilterSample told;
  filter_predict(&f, before.data(), now.data(), estimate.data(), covariance.data(),
                 told.transition);
  filter_update(&f, before.data(), now.data(), measured.data(), estimate.data(), covariance.data(),
                &told);
  keep(tables_, told, true, sample);
}

PlantObserver::Damper PlantObserver::damper_at(std::span<const double> before,
                                               std::span<const double> now,
                                               std::span<const double> estimate,
                                               std::span<const double> covariance) const {
  const FilterWithDamper f = filter_of(tables_, *damper_);
  double out[4];
  filter_damper(&f, before.data(), now.data(), estimate.data(), covariance.data(), out);
  return {out[0], out[1], out[2], out[3]};
}

}  // namespace dashpot
