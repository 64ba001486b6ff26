#include "dashpot/machine/plant_residuals.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <deque>
#include <latch>
#include <limits>
#include <memory>
#include <numeric>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/machine/between_samples.h"
#include "dashpot/machine/damper_drive.h"

namespace dashpot {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

double mean_of(std::span<const double> samples) {
  return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

double rms_about(std::span<const double> samples, double centre) {
  double sum = 0;
  for (const double sample : samples) sum += (sample - centre) * (sample - centre);
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

/// Opens a latch at the end of a scope, however that is left.
struct OpensLatch {
  std::latch& latch;
  ~OpensLatch() { latch.count_down(); }
};

/// Whether errors, in a sensor's scale, are so far beyond what it showed that the plant diverges,
/// although its numbers are still finite: no scale is to be taken from them.
bool is_far(std::span<const double> errors, std::span<const double> measured, double scale) {
  constexpr double kFar = 1e3;  // of its range; wide, since a start may be far off
  const auto [least, greatest] = std::ranges::minmax(measured);
  const auto [low, high] = std::ranges::minmax(errors);
  return greatest > least && std::max(-low, high) * scale > kFar * (greatest - least);
}

}  // namespace

PlantResiduals::PlantResiduals(const InPlantSetup& setup, const PlantCases& cases,
                               const DamperUnknowns& law, const std::vector<double>& plant,
                               const DataScale& scale)
    : PlantResiduals(setup, cases, &law, {}, plant, scale) {}

PlantResiduals::PlantResiduals(const InPlantSetup& setup, const PlantCases& cases,
                               std::vector<std::shared_ptr<const DamperModel>> held,
                               const std::vector<double>& plant, const DataScale& scale)
    : PlantResiduals(setup, cases, nullptr, std::move(held), plant, scale) {}

PlantResiduals::PlantResiduals(const InPlantSetup& setup, const PlantCases& cases,
                               const DamperUnknowns* law,
                               std::vector<std::shared_ptr<const DamperModel>> held,
                               const std::vector<double>& plant, const DataScale& scale)
    : setup_(&setup), cases_(&cases), law_(law), held_(std::move(held)) {
  assert(!law || std::ranges::all_of(cases.all, [&](const PlantCase& one) {
    return one.levels.size() == law->kinds();
  }));
  if (law) law_states_ = law->models(law->start()).front().law().states;
  for (const PlantInputChannel& input : setup.inputs) inputs_.push_back(input.place);
  for (const PlantSensor& sensor : setup.sensors) sensors_.push_back(sensor.place);
  const auto add = [&](double size, double lower, double upper) {
    size_.push_back(size);
    lower_.push_back(lower / size);
    upper_.push_back(upper / size);
  };

  // The plant's numbers, each in the size at which it starts.
  for (std::size_t k = 0; k < setup.unknown.size(); ++k)
    add(plant[k] != 0 ? std::abs(plant[k]) : 1, setup.unknown[k].lower, setup.unknown[k].upper);

  // The law's, which have sizes and bounds of their own.
  if (law) {
    lower_.insert(lower_.end(), law->lower().begin(), law->lower().end());
    upper_.insert(upper_.end(), law->upper().begin(), law->upper().end());
    size_.resize(lower_.size(), 1.0);
  }

  // The state at the beginning of each recording, in the size of the damper's motion.
  first_state_ = size_.size();
  coordinates_ = make_plant(*setup.model, setup.known).size();
  if (!setup.from_rest) {
    state_size_.assign(coordinates_, scale.stroke);
    state_size_.insert(state_size_.end(), coordinates_, scale.speed);
    for (std::size_t d = 0; d < setup.dampers(); ++d)
      for (const StateInfo& state : law_states_) state_size_.push_back(scale.of_unit(state.unit));
  }
  for (std::size_t c = 0; c < cases.all.size(); ++c)
    for (const double size : state_size_) add(size, -kUnbounded, kUnbounded);

  // Delays and times of filters, in samples.
  first_of_sensors_ = size_.size();
  const PlantCase& first = cases.all.front();
  of_sensors_ = sensor_unknowns(setup, first.driving.sample_time);
  for (const SensorUnknown& one : of_sensors_) add(first.driving.sample_time, one.lower, one.upper);

  // Each sensor's scale: its noise, or at first a hundredth of what it showed.
  constexpr double kFirstShare = 0.01;
  for (std::size_t s = 0; s < setup.sensors.size(); ++s) {
    const std::vector<double>& shown = first.measured[s];
    scale_.push_back(setup.sensors[s].noise > 0 ? setup.sensors[s].noise
                                                : kFirstShare * rms_about(shown, mean_of(shown)));
  }
}

std::vector<double> PlantResiduals::states_of(std::span<const double> x) const {
  std::vector<double> of;
  for (std::size_t c = 0; c < cases_->all.size() && states() > 0; ++c)
    for (std::size_t k = 0; k < 2 * coordinates_; ++k) {
      const std::size_t unknown = first_state_ + c * states() + k;
      of.push_back(size_[unknown] * x[unknown]);
    }
  return of;
}

std::vector<double> PlantResiduals::start(const std::vector<double>& plant,
                                          const std::vector<double>& beginnings,
                                          Random* random) const {
  std::vector<double> x(size_.size(), 0.0);
  for (std::size_t k = 0; k < plant.size(); ++k) x[k] = plant[k] / size_[k];
  if (law_)
    std::ranges::copy(law_->start(random), x.begin() + static_cast<std::ptrdiff_t>(plant.size()));
  for (std::size_t k = 0; k < beginnings.size(); ++k) {
    const std::size_t unknown =
        first_state_ + k / (2 * coordinates_) * states() + k % (2 * coordinates_);
    x[unknown] = beginnings[k] / size_[unknown];
  }
  for (std::size_t k = 0; k < of_sensors_.size(); ++k)
    x[first_of_sensors_ + k] = start_of(of_sensors_[k], *setup_) / size_[first_of_sensors_ + k];
  return x;
}

std::vector<double> PlantResiduals::off_bounds(std::vector<double> x) const {
  if (!law_) return x;
  const auto first = x.begin() + static_cast<std::ptrdiff_t>(plant_unknowns());
  const auto end = x.begin() + static_cast<std::ptrdiff_t>(first_state_);
  std::ranges::copy(law_->off_bounds({first, end}), first);
  return x;
}

bool PlantResiduals::acts_on(std::size_t k, std::size_t recording) const {
  const bool is_state = k >= first_state_ && k < first_of_sensors_;
  return !is_state || recording == (k - first_state_) / states();
}

bool PlantResiduals::is_of_law(std::size_t k) const {
  return k >= plant_unknowns() && k < first_state_;
}

const SensorUnknown* PlantResiduals::of_sensor(std::size_t k) const {
  return k >= first_of_sensors_ ? &of_sensors_[k - first_of_sensors_] : nullptr;
}

std::vector<LawModel> PlantResiduals::laws(std::span<const double> x) const {
  assert(law_);
  return law_->models(x.subspan(plant_unknowns(), law_->size()));
}

PlantResiduals::Dampers PlantResiduals::placed(
    std::vector<std::shared_ptr<const DamperModel>> kinds) const {
  Dampers dampers{std::move(kinds), {}};
  for (std::size_t d = 0; d < setup_->dampers(); ++d)
    dampers.in_struts.push_back(dampers.kinds[setup_->kinds.at(d)].get());
  return dampers;
}

PlantResiduals::Dampers PlantResiduals::dampers(std::span<const double> x) const {
  if (!law_) return placed(held_);
  std::vector<std::shared_ptr<const DamperModel>> kinds;
  for (LawModel& law : laws(x)) kinds.push_back(std::make_shared<LawModel>(std::move(law)));
  return placed(std::move(kinds));
}

PlantResiduals::Dampers PlantResiduals::laws_in(const PlantCase& one,
                                                std::vector<LawModel> laws) const {
  std::vector<std::shared_ptr<const DamperModel>> kinds;
  for (LawModel& law : at_held_levels(std::move(laws), one.levels))
    kinds.push_back(std::make_shared<LawModel>(std::move(law)));
  return placed(std::move(kinds));
}

PlantResiduals::Dampers PlantResiduals::dampers_in(const PlantCase& one,
                                                   std::span<const double> x) const {
  return law_ ? laws_in(one, laws(x)) : dampers(x);
}

std::vector<LawUnknowns::Coefficient> PlantResiduals::law_coefficients(
    std::span<const double> x) const {
  if (!law_) return {};
  return law_->coefficients(x.subspan(plant_unknowns(), law_->size()));
}

std::string PlantResiduals::name(std::size_t k) const {
  if (k < plant_unknowns()) return setup_->unknown[k].name;
  if (const SensorUnknown* one = of_sensor(k)) return name_of(*one, *setup_);
  if (k >= first_state_) return "state at the beginning";
  return name_in_law(*this, plant_unknowns(), k, size_.size());
}

FittedParameter PlantResiduals::described(std::size_t k, std::span<const double> x) const {
  FittedParameter p{.name = name(k), .unit = {}, .meaning = {}, .value = size_[k] * x[k]};
  const double margin = kAtBound * std::max(1.0, std::abs(x[k]));
  p.at_bound = x[k] <= lower_[k] + margin || x[k] >= upper_[k] - margin;

  // A number of the plant has its row; one of a sensor and a state at the beginning say what they
  // are.
  if (k < plant_unknowns()) {
    const auto& rows = setup_->model->parameters;
    const ParameterRow& row = rows[row_named(rows, p.name, setup_->model->name, "plant")];
    p.unit = row.unit;
    p.meaning = row.meaning;
    return p;
  }
  if (of_sensor(k)) {
    p.unit = "s";
    return p;
  }
  const std::size_t place = (k - first_state_) % states(), c = (k - first_state_) / states();
  const Plant plant = make_plant(*setup_->model, setup_->known);
  const std::size_t n = plant.size();
  p.meaning = "at the beginning of " + cases_->all[c].name;
  if (place < 2 * n) {
    const Coordinate& coordinate = plant.coordinates[place % n];
    p.name = coordinate.name + (place < n ? "" : "_velocity");
    p.unit = coordinate.unit + (place < n ? "" : "/s");
    return p;
  }
  const std::span<const StateInfo> own = law_states_;
  const StateInfo& state = own[(place - 2 * n) % own.size()];
  const std::string& strut = plant.struts[(place - 2 * n) / own.size()].name;
  p.name = (plant.struts.size() > 1 ? strut + "_" : "") + std::string(state.name);
  p.unit = state.unit;
  return p;
}

DrivenPlant PlantResiduals::equations(std::span<const double> x) const {
  NamedValues values = setup_->known;
  for (std::size_t k = 0; k < plant_unknowns(); ++k)
    values.emplace_back(
        setup_->unknown[k].name,
        std::clamp(size_[k] * x[k], setup_->unknown[k].lower, setup_->unknown[k].upper));
  return DrivenPlant(make_plant(*setup_->model, values), inputs_);
}

std::vector<double> PlantResiduals::state_at_first(std::span<const double> x, std::size_t place,
                                                   const DrivenPlant& plant,
                                                   PlacedDampers dampers) const {
  std::vector<double> state = plant.at_rest(dampers, cases_->all[place].driving);
  const auto unknown = [&](std::size_t k) {
    const std::size_t own = first_state_ + place * states() + k;
    return size_[own] * x[own];
  };
  const std::size_t of_plant = std::min(states(), 2 * coordinates_), of_law = law_states_.size();
  for (std::size_t k = 0; k < of_plant; ++k) state[k] += unknown(k);

  // Behind the law's states each damper may have one of its coil, which begins at rest.
  std::size_t first = of_plant;
  for (std::size_t k = of_plant; k < states(); ++k) {
    const std::size_t damper = (k - of_plant) / of_law, own = (k - of_plant) % of_law;
    state[first + own] += unknown(k);
    if (own + 1 == of_law) first += dampers[damper]->state_size();
  }
  return state;
}

/// What the plant does, before the sensors' filters and delays; where there are any a little
/// further, so that it is known between samples.
bool PlantResiduals::move(std::span<const double> x, const DrivenPlant& plant,
                          PlacedDampers dampers, const PlantCase& one, std::size_t place,
                          std::size_t samples, std::span<const PlantSensorPlace> sensors,
                          Shown& shown, const RunBeside& beside) const {
  std::vector<double> state = state_at_first(x, place, plant, dampers);
  if (one.driving.method == PlantMethod::StraightForce) plant.settle(dampers, one.driving, state);
  const bool may_be_late =
      !of_sensors_.empty() || std::ranges::any_of(setup_->sensors, [](const PlantSensor& sensor) {
        return sensor.delay != 0 || sensor.filter.cutoff > 0;
      });
  const std::size_t further =
      may_be_late ? std::min(samples + kSamplesAround, one.driving.samples) : samples;
  return plant.run(dampers, one.driving, further, sensors, state, shown, beside);
}

/// Puts what x says of the sensors in them.
void PlantResiduals::put_sensors(std::span<const double> x,
                                 std::vector<PlantSensor>& sensors) const {
  for (std::size_t k = 0; k < of_sensors_.size(); ++k)
    put(of_sensors_[k], size_[first_of_sensors_ + k] * x[first_of_sensors_ + k], sensors);
}

/// What comes out of a sensor's filter, and of a late one later.
void PlantResiduals::sense(std::span<const double> x, double sample_time, std::size_t samples,
                           Shown& shown) const {
  std::vector<PlantSensor> sensors = setup_->sensors;
  put_sensors(x, sensors);
  for (std::size_t s = 0; s < sensors.size() && s < shown.size(); ++s) {
    const SensorFilter& filter = sensors[s].filter;
    const double delay = sensors[s].delay;
    if (filter.cutoff > 0) shown[s] = behind(filter, shown[s], sample_time);
    if (delay != 0) shown[s] = delayed(shown[s], sample_time, delay);
  }
  for (std::vector<double>& one_shown : shown) one_shown.resize(samples);
}

bool PlantResiduals::run(std::span<const double> x, const DrivenPlant& plant, PlacedDampers dampers,
                         const PlantCase& one, std::size_t place, std::size_t samples,
                         std::span<const PlantSensorPlace> sensors, Shown& shown) const {
  if (!move(x, plant, dampers, one, place, samples, sensors, shown)) return false;
  sense(x, one.driving.sample_time, samples, shown);
  return true;
}

std::size_t PlantResiduals::end_of(const PlantCase& one, std::size_t samples) const {
  return samples > 0 ? std::min(one.training, one.first + samples) : one.training;
}

std::size_t PlantResiduals::residuals_of(std::size_t place, std::size_t samples) const {
  if (noise_) return (*noise_)[place].lines() * (*noise_)[place].rows_per_line();
  const PlantCase& one = cases_->all[place];
  return sensors_.size() * (end_of(one, samples) - one.first);
}

/// First residual of a recording.
std::size_t PlantResiduals::part_of(std::size_t place, std::size_t samples) const {
  std::size_t at = 0;
  for (std::size_t c = 0; c < place; ++c) at += residuals_of(c, samples);
  return at;
}

/// The residuals of one recording, which begin at r[0], of what its plant shows before its sensors.
bool PlantResiduals::compare(std::span<const double> x, std::size_t place, std::size_t samples,
                             Shown shown, std::span<double> r) const {
  const PlantCase& one = cases_->all[place];
  const std::size_t end = end_of(one, samples), length = end - one.first;
  sense(x, one.driving.sample_time, end, shown);
  std::vector<double> samples_beyond(noise_ ? sensors_.size() * length : 0);
  const std::span<double> beyond = noise_ ? std::span(samples_beyond) : r;
  for (std::size_t s = 0; s < sensors_.size(); ++s) {
    const std::span<double> out = beyond.subspan(s * length, length);
    for (std::size_t k = 0; k < length; ++k)
      out[k] = (shown[s][one.first + k] - one.measured[s][one.first + k]) / scale_[s];
    const double offset = mean_of(out);
    for (double& value : out) value -= offset;
    if (is_far(out, std::span(one.measured[s]).subspan(one.first, length), scale_[s])) return false;
  }
  if (noise_) (*noise_)[place].put_lines(beyond, length, r);
  return true;
}

/// The same at x.
bool PlantResiduals::evaluate_one(std::span<const double> x, std::size_t place, std::size_t samples,
                                  std::span<double> r, KnownRun* keep) const {
  const PlantCase& one = cases_->all[place];
  RunBeside beside;
  if (keep && one.driving.method == PlantMethod::StraightForce) beside.keep = &keep->tangent;
  const Dampers dampers = dampers_in(one, x);
  Shown shown;
  if (!move(x, equations(x), dampers.in_struts, one, place, end_of(one, samples), sensors_, shown,
            beside))
    return false;
  if (keep) keep->shown = shown;
  return compare(x, place, samples, std::move(shown), r);
}

bool PlantResiduals::evaluate(std::span<const double> x, std::size_t samples, std::span<double> r,
                              int threads) const {
  std::atomic<bool> complete = true;
  parallel_for(cases_->all.size(), threads, [&](std::size_t c) {
    if (!evaluate_one(x, c, samples, r.subspan(part_of(c, samples)))) complete = false;
  });
  return complete;
}

/// The step of a difference: up where the bounds leave room, or the other way; 0 where that would
/// leave them.
double PlantResiduals::difference_step(std::span<const double> x, std::size_t k,
                                       bool other_way) const {
  constexpr double kStep = 1e-6;
  const double length = kStep * std::max(1.0, std::abs(x[k]));
  const bool upward = x[k] + length <= upper_[k];
  const double step = upward != other_way ? length : -length, moved = x[k] + step;
  return moved < lower_[k] || moved > upper_[k] ? 0 : step;
}

/// A recording's rows of one column, where r holds those of the residuals at x.
bool PlantResiduals::difference(std::span<const double> x, std::size_t place, std::size_t samples,
                                std::span<const double> r, const KnownRun& at, std::size_t k,
                                bool other_way, std::span<double> column) const {
  if (!acts_on(k, place)) {
    std::ranges::fill(column, 0.0);
    return true;
  }
  const double step = difference_step(x, k, other_way);
  if (step == 0) return false;
  std::vector<double> moved(x.begin(), x.end());
  moved[k] += step;

  // What is of a sensor leaves the plant as it is; another beginning is forgotten.
  const PlantCase& one = cases_->all[place];
  Shown shown;
  if (k >= first_of_sensors_) {
    shown = at.shown;
  } else {
    RunBeside beside;
    if (one.driving.method == PlantMethod::StraightForce) beside.follow = &at.tangent;
    if (k >= first_state_) beside.comes_back_to = &at.shown;
    const Dampers dampers = dampers_in(one, moved);
    if (!move(moved, equations(moved), dampers.in_struts, one, place, end_of(one, samples),
              sensors_, shown, beside))
      return false;
  }
  if (!compare(moved, place, samples, std::move(shown), column)) return false;
  for (std::size_t i = 0; i < r.size(); ++i) column[i] = (column[i] - r[i]) / step;
  return true;
}

/// The unknowns of the law's parameter to which k belongs, where they act as one: at a current that
/// never changes.
std::optional<DamperUnknowns::Group> PlantResiduals::moved_as_one(std::size_t k,
                                                                  std::size_t place) const {
  if (!law_ || !is_of_law(k) || law_->slows_filter()) return {};
  const std::size_t own = k - plant_unknowns();
  for (const DamperUnknowns::Group& group : law_->groups())
    if (own >= group.first && own < group.first + group.count())
      return cases_->all[place].levels[group.kind] ? std::optional(group) : std::nullopt;
  return {};
}

/// Likewise of all columns of such a parameter, at the price of one; a column may be empty.
bool PlantResiduals::difference_of_group(std::span<const double> x, std::size_t place,
                                         std::size_t samples, std::span<const double> r,
                                         const KnownRun& at, const DamperUnknowns::Group& group,
                                         bool other_way,
                                         std::span<const std::span<double>> columns) const {
  const PlantCase& one = cases_->all[place];
  const std::span<const double> own = x.subspan(plant_unknowns(), law_->size());
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (!columns[k].empty() && difference_step(x, plant_unknowns() + group.first + k, false) == 0)
      return false;

  // The parameter a little more.
  const double step = law_->step(own, group) * (other_way ? -1 : 1);
  const Dampers dampers = laws_in(one, law_->moved(own, group, step));
  RunBeside beside;
  if (one.driving.method == PlantMethod::StraightForce) beside.follow = &at.tangent;
  Shown shown;
  std::vector<double> moved(r.size());
  if (!move(x, equations(x), dampers.in_struts, one, place, end_of(one, samples), sensors_, shown,
            beside) ||
      !compare(x, place, samples, std::move(shown), moved))
    return false;

  // Each of its unknowns moves it by so much.
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double slope = law_->slope(own, group, k, *one.levels[group.kind]) / step;
    for (std::size_t i = 0; i < columns[k].size(); ++i) columns[k][i] = (moved[i] - r[i]) * slope;
  }
  return true;
}

bool PlantResiduals::jacobian(std::span<const double> x, std::size_t samples, std::span<double> r,
                              std::span<double* const> columns, int threads) const {
  const std::size_t recordings = cases_->all.size(), n = x.size();
  std::vector<KnownRun> runs(recordings);
  const auto rows_of = [&](std::size_t c, std::span<double> all) {
    return all.subspan(part_of(c, samples), residuals_of(c, samples));
  };
  const auto column = [&](std::size_t c, std::size_t k) {
    return columns[k] ? rows_of(c, {columns[k], r.size()}) : std::span<double>();
  };

  // Column k of a recording; the first of those that act as one makes all of them.
  const auto differ = [&](std::size_t c, std::size_t k, bool other_way) {
    const auto group = moved_as_one(k, c);
    if (!group)
      return !columns[k] ||
             difference(x, c, samples, rows_of(c, r), runs[c], k, other_way, column(c, k));
    const std::size_t first = plant_unknowns() + group->first;
    std::vector<std::span<double>> own;
    for (std::size_t other = first; other < first + group->count(); ++other)
      own.push_back(column(c, other));
    const bool is_asked = std::ranges::any_of(own, [](const auto& rows) { return !rows.empty(); });
    return k != first || !is_asked ||
           difference_of_group(x, c, samples, rows_of(c, r), runs[c], *group, other_way, own);
  };

  // The recordings at x, and then column by column: a thread that finds no recording left goes on
  // with the columns of one that has been run. Tasks begin in their order, so that what waits for a
  // recording waits for one that is running.
  std::deque<std::latch> passed;
  for (std::size_t c = 0; c < recordings; ++c) passed.emplace_back(1);
  std::vector<std::atomic<bool>> is_finite(recordings), is_lost(recordings * n);
  parallel_for(recordings * (1 + n), threads, [&](std::size_t task) {
    if (task < recordings) {
      const OpensLatch at_the_end{passed[task]};
      is_finite[task] = evaluate_one(x, task, samples, rows_of(task, r), &runs[task]);
      return;
    }
    const std::size_t c = (task - recordings) / n, k = (task - recordings) % n;
    passed[c].wait();
    if (is_finite[c] && !differ(c, k, false)) is_lost[c * n + k] = true;
  });
  if (!std::ranges::all_of(is_finite, [](const auto& one) { return one.load(); })) return false;

  // The other way where the plant diverges on the first one.
  std::atomic<bool> complete = true;
  parallel_for(recordings * n, threads, [&](std::size_t task) {
    if (is_lost[task] && !differ(task / n, task % n, true)) complete = false;
  });
  return complete;
}

LeastSquaresProblem PlantResiduals::problem(std::size_t samples, int threads) const {
  LeastSquaresProblem problem;
  problem.parts.clear();

  // A part is a sensor of a recording, or some neighbouring frequencies of it.
  constexpr std::size_t kLines = 20;
  for (std::size_t c = 0; c < cases_->all.size(); ++c) {
    const std::size_t count = residuals_of(c, samples);
    const std::size_t part =
        noise_ ? kLines * (*noise_)[c].rows_per_line() : count / sensors_.size();
    for (std::size_t first = 0; first < count; first += part)
      problem.parts.push_back(problem.residuals + first);
    problem.residuals += count;
  }
  problem.lower = lower_;
  problem.upper = upper_;

  // The damper's states at a beginning, which a sharp hysteresis forgets, do not run away.
  constexpr double kMost = 3;  // in the size of the damper's motion
  for (std::size_t k = first_state_; k < first_of_sensors_ && keeps_states_near(); ++k)
    if (is_of_damper(k)) {
      problem.lower[k] = -kMost;
      problem.upper[k] = kMost;
    }
  for (const std::size_t k : forgotten_) problem.lower[k] = problem.upper[k] = 0;

  problem.residual = [this, samples, threads](std::span<const double> x, std::span<double> r) {
    return evaluate(x, samples, r, threads);
  };

  // The end of a search is asked for twice: the columns of the last point are kept.
  struct Last {
    std::vector<double> x, r;
    std::vector<std::vector<double>> columns;
  };
  problem.jacobian = [this, samples, threads, last = std::make_shared<Last>()](
                         std::span<const double> x, std::span<double> r,
                         std::span<double* const> columns) {
    if (!std::ranges::equal(x, last->x)) {
      last->x.clear();
      last->columns.assign(x.size(), {});
    }

    // What is not kept is made, and kept with the rest.
    std::vector<double*> missing(columns.size(), nullptr);
    bool is_complete = !last->x.empty();
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k] && last->columns[k].empty()) {
        missing[k] = columns[k];
        is_complete = false;
      }

    if (is_complete)
      std::ranges::copy(last->r, r.begin());
    else if (!jacobian(x, samples, r, missing, threads))
      return false;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (missing[k]) last->columns[k].assign(columns[k], columns[k] + r.size());
      if (columns[k] && !missing[k]) std::ranges::copy(last->columns[k], columns[k]);
    }
    last->x.assign(x.begin(), x.end());
    last->r.assign(r.begin(), r.end());
    return true;
  };
  return problem;
}

bool PlantResiduals::keeps_states_near() const {
  return cases_->method == PlantMethod::StraightForce;
}

bool PlantResiduals::is_of_damper(std::size_t state) const {
  return (state - first_state_) % states() >= 2 * coordinates_;
}

void PlantResiduals::leave_out_forgotten(const LeastSquaresReport& at) {
  constexpr double kFelt = 30;  // scales of a sensor, by all residuals together
  forgotten_.clear();
  for (std::size_t k = first_state_; k < first_of_sensors_ && keeps_states_near(); ++k) {
    double square = 0;
    for (const std::vector<double>& part : at.part_matrices) square += part[k * (size_.size() + 1)];
    if (is_of_damper(k) && square < kFelt * kFelt) forgotten_.push_back(k);
  }
}

double PlantResiduals::reweigh(std::span<const double> x) {
  const LeastSquaresProblem whole = problem();
  std::vector<double> r(whole.residuals);
  if (!evaluate(x, 0, r, 1)) return 0;

  // The rms that is left at each sensor, over all recordings.
  std::vector<double> squares(sensors_.size()), counts(sensors_.size());
  for (std::size_t part = 0; part < whole.parts.size(); ++part) {
    const std::size_t end = part + 1 < whole.parts.size() ? whole.parts[part + 1] : whole.residuals;
    for (std::size_t k = whole.parts[part]; k < end; ++k)
      squares[part % sensors_.size()] += r[k] * r[k];
    counts[part % sensors_.size()] += static_cast<double>(end - whole.parts[part]);
  }
  double change = 0;
  for (std::size_t s = 0; s < sensors_.size(); ++s) {
    const double rms = std::sqrt(squares[s] / counts[s]);
    if (setup_->sensors[s].noise > 0 || rms <= 0) continue;
    scale_[s] *= rms;
    if (sensors_.size() > 1) change = std::max(change, std::abs(rms - 1));
  }
  return change;
}

InPlantSetup PlantResiduals::setup_at(std::span<const double> x) const {
  InPlantSetup setup = *setup_;
  for (std::size_t k = 0; k < plant_unknowns(); ++k)
    setup.known.emplace_back(setup.unknown[k].name, described(k, x).value);
  setup.unknown.clear();
  put_sensors(x, setup.sensors);
  return setup;
}

Covariance PlantResiduals::covariance_at(const LeastSquaresReport& solved) const {
  const LeastSquaresProblem whole = problem();
  std::vector<double> r(whole.residuals);
  evaluate(solved.x, 0, r, 1);
  std::vector<std::pair<std::size_t, std::size_t>> segments;
  for (std::size_t part = 0; part < whole.parts.size(); ++part)
    segments.emplace_back(
        whole.parts[part],
        (part + 1 < whole.parts.size() ? whole.parts[part + 1] : r.size()) - whole.parts[part]);
  return covariance(solved.part_matrices, independent_variances(r, segments, solved.x.size()),
                    solved.x.size());
}

PlantResiduals::Shown PlantResiduals::other_sensors(
    std::span<const double> x, std::size_t recording,
    const std::vector<PlantSensorPlace>& places) const {
  std::vector<PlantSensorPlace> all = sensors_;
  all.insert(all.end(), places.begin(), places.end());
  const PlantCase& one = cases_->all[recording];
  Shown shown;
  if (!run(x, equations(x), dampers(x).in_struts, one, recording, one.training, all, shown))
    return {};
  shown.erase(shown.begin(), shown.begin() + static_cast<std::ptrdiff_t>(sensors_.size()));
  for (std::vector<double>& samples : shown) {
    samples.resize(one.training);
    samples.erase(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(one.first));
    const double mean = mean_of(samples);
    for (double& value : samples) value -= mean;
  }
  return shown;
}

double PlantResiduals::step_error(std::span<const double> x,
                                  const std::vector<PlantRecording>& recordings,
                                  int threads) const {
  const PlantCases finer = make_cases(*setup_, recordings, 2 * cases_->steps, cases_->method);
  const DrivenPlant plant = equations(x);
  const Dampers dampers = this->dampers(x);
  std::vector<double> worst(finer.all.size(), 0.0);
  parallel_for(finer.all.size(), threads, [&](std::size_t c) {
    const PlantCase& one = cases_->all[c];
    Shown coarse, fine;
    if (!run(x, plant, dampers.in_struts, one, c, one.training, sensors_, coarse) ||
        !run(x, plant, dampers.in_struts, finer.all[c], c, one.training, sensors_, fine)) {
      worst[c] = kUnbounded;
      return;
    }

    // The change against the error that is left, both without their means.
    for (std::size_t s = 0; s < sensors_.size(); ++s) {
      std::vector<double> change, error;
      for (std::size_t k = one.first; k < one.training; ++k) {
        change.push_back(coarse[s][k] - fine[s][k]);
        error.push_back(coarse[s][k] - one.measured[s][k]);
      }
      const double left = rms_about(error, mean_of(error));
      const double floor = 1e-9 * rms_about(one.measured[s], mean_of(one.measured[s]));
      worst[c] = std::max(worst[c], rms_about(change, mean_of(change)) / std::max(left, floor));
    }
  });
  return std::ranges::max(worst);
}

bool PlantResiduals::diverges(std::span<const double> x) const {
  const DrivenPlant plant = equations(x);
  const Dampers dampers = this->dampers(x);
  Shown shown;
  for (std::size_t c = 0; c < cases_->all.size(); ++c) {
    const PlantCase& one = cases_->all[c];
    if (!run(x, plant, dampers.in_struts, one, c, one.driving.samples, sensors_, shown))
      return true;
  }
  return false;
}

void PlantResiduals::describe(std::span<const double> x, std::vector<SensorFigures>& figures,
                              std::vector<InPlantTrace>& traces, int threads) const {
  // Beside the sensors, the dampers' own motion and force.
  const DrivenPlant plant = equations(x);
  const Plant shown_plant = make_plant(*setup_->model, setup_->known);
  std::vector<PlantSensorPlace> places = sensors_;
  for (std::size_t d = 0; d < plant.dampers().size(); ++d)
    for (const PlantQuantity own :
         {PlantQuantity::Deflection, PlantQuantity::DeflectionVelocity, PlantQuantity::DamperForce})
      places.push_back({own, 0, d});

  const Dampers dampers = this->dampers(x);
  figures.assign(cases_->all.size() * sensors_.size(), {});
  traces.assign(cases_->all.size(), {});
  parallel_for(cases_->all.size(), threads, [&](std::size_t c) {
    const PlantCase& one = cases_->all[c];
    const std::size_t count = one.driving.samples, stride = one.driving.stride();
    InPlantTrace trace{.recording = one.name,
                       .sample_time = one.driving.sample_time,
                       .first = one.first,
                       .training = one.training,
                       .measured = one.measured};
    Shown shown;
    const bool finite = run(x, plant, dampers.in_struts, one, c, count, places, shown);

    // Each sensor's offset is that of the part which was fitted; its errors with that taken off.
    for (std::size_t s = 0; s < sensors_.size(); ++s) {
      SensorFigures figure{.recording = one.name,
                           .channel = setup_->sensors[s].channel,
                           .unit = unit_of(sensors_[s], shown_plant)};
      std::vector<double> error(count);
      for (std::size_t k = 0; k < count; ++k) error[k] = one.measured[s][k] - shown[s][k];
      const std::span<const double> all(error);
      const std::span<const double> fitted = all.subspan(one.first, one.training - one.first);
      figure.offset = mean_of(fitted);
      figure.rms = rms_about(one.measured[s], mean_of(one.measured[s]));
      figure.training =
          finite || one.training < count ? rms_about(fitted, figure.offset) : kUnbounded;
      figure.held_back = std::numeric_limits<double>::quiet_NaN();
      if (one.training < count)
        figure.held_back =
            finite ? rms_about(all.subspan(one.training), figure.offset) : kUnbounded;
      for (double& value : shown[s]) value += figure.offset;
      figures[c * sensors_.size() + s] = figure;
    }

    // The dampers at each sample.
    const auto last = std::ptrdiff_t(sensors_.size());
    for (std::size_t d = 0; d < plant.dampers().size(); ++d) {
      const std::size_t own = sensors_.size() + 3 * d;
      trace.dampers.push_back({.strut = shown_plant.struts[d].name,
                               .deflection = shown[own],
                               .velocity = shown[own + 1],
                               .force = shown[own + 2]});
      for (std::size_t k = 0; k < count; ++k)
        trace.dampers.back().current.push_back(one.driving.current[d][stride * k]);
    }
    trace.modelled.assign(shown.begin(), shown.begin() + last);
    traces[c] = std::move(trace);
  });
}

}  // namespace dashpot
