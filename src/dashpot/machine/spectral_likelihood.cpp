#include "dashpot/machine/spectral_likelihood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "dashpot/base/parallel.h"
#include "dashpot/error.h"
#include "dashpot/machine/damper_drive.h"
#include "dashpot/machine/plant_at_line.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/numerics/spectrum.h"
#include "dashpot/suspension/ground/road_profile.h"
#include "dashpot/suspension/plants/linear.h"

namespace dashpot {
namespace {

using Complex = std::complex<double>;

constexpr double kLongest = 0.01;  // cycle/m, below which a road counts as level

/// ISO 8608 says nothing of shorter waves, cycle/m, and tyres roll over them as if they were not
/// there: a road that was taken for white up to the sensors' rate would make another plant likely.
constexpr double kShortest = 2.83;

constexpr double kUsualTrack = 1.5;  // m, where the search for what tracks share begins

/// Two-sided density of the law's error, N^2*s.
double error_density(const ObserverNoise& noise, double w) {
  double density = 0;
  for (const ForceError& error : noise.force)
    density +=
        2 * error.deviation * error.deviation * error.memory / (1 + std::pow(w * error.memory, 2));
  return density;
}

/// Likewise of a road's height, m^2*s.
double road_density_over_time(double roughness, double speed, double w) {
  const double white = 0.5 * roughness * std::pow(kTurn * kReferenceWaveNumber, 2) * speed;
  return white / (w * w + std::pow(kTurn * kLongest * speed, 2));
}

/// The columns of the states at both ends, two per coordinate, and of what each sensor makes of its
/// own, of `ends` columns in all.
void put_end_columns(PlantAtLine& plant, std::size_t coordinates, std::size_t ends,
                     std::vector<Complex>& shows, Complex* column) {
  const std::size_t m = shows.size();
  for (std::size_t j = 0; j < coordinates; ++j) {
    plant.of_push(j, shows);
    for (std::size_t s = 0; s < m; ++s) {
      column[s * ends + 2 * j] = shows[s];
      column[s * ends + 2 * j + 1] = plant.iw() * shows[s];
    }
  }
  for (std::size_t s = 0; s < m; ++s) {
    column[s * ends + 2 * coordinates + 2 * s] = 1;
    column[s * ends + 2 * coordinates + 2 * s + 1] = plant.iw();
  }
}

/// The largest of a quantity of all motions, by its size.
double largest_of(const std::vector<RiddenRecording>& rides, double DamperInput::* quantity) {
  double largest = 0;
  for (const RiddenRecording& ridden : rides)
    for (const std::vector<DamperInput>& motion : ridden.motions)
      for (const DamperInput& input : motion)
        largest = std::max(largest, std::abs(input.*quantity));
  return largest;
}

/// Least squares of real coefficients over whitened lines, and the lines without what they explain.
class EndTerms {
 public:
  EndTerms(std::size_t count) : count_(count), normal_(count * count), right_(count) {}

  /// columns: count numbers per whitened sensor, row by row.
  void add(const Complex* columns, const Complex* shown, std::size_t sensors) {
    for (std::size_t s = 0; s < sensors; ++s) {
      const Complex* row = columns + s * count_;
      for (std::size_t i = 0; i < count_; ++i) {
        right_[i] += (std::conj(row[i]) * shown[s]).real();
        for (std::size_t k = 0; k <= i; ++k)
          normal_[i * count_ + k] += (std::conj(row[i]) * row[k]).real();
      }
    }
  }
  std::vector<double> solved() {
    std::vector<double> size(count_), found(count_);
    for (std::size_t i = 0; i < count_; ++i)
      size[i] = normal_[i * count_ + i] > 0 ? std::sqrt(normal_[i * count_ + i]) : 1;
    for (std::size_t i = 0; i < count_; ++i) {
      right_[i] /= size[i];
      for (std::size_t k = 0; k <= i; ++k) {
        normal_[i * count_ + k] /= size[i] * size[k];
        normal_[k * count_ + i] = normal_[i * count_ + k];
      }
      normal_[i * count_ + i] += 1e-10;
    }
    if (!solve_positive_definite(normal_, right_, found)) return std::vector<double>(count_);
    for (std::size_t i = 0; i < count_; ++i) found[i] /= size[i];
    return found;
  }

 private:
  std::size_t count_;
  std::vector<double> normal_, right_;
};

}  // namespace

SpectralLikelihood::SpectralLikelihood(const InPlantSetup& setup,
                                       const std::vector<RiddenRecording>& rides,
                                       const DamperUnknowns& law, const std::vector<double>& plant,
                                       const ObserverNoise& first, double force, bool has_more)
    : setup_(&setup), rides_(&rides), law_(&law), first_(first) {
  constexpr double kOfSampleRate = 0.4, kOfWaves = 0.9, kMostBeside = 10;
  sample_time_ = rides.front().recording->sample_time;
  pairs_ = road_pairs(setup);
  if (!pairs_.empty() && first_.track_width == 0) first_.track_width = kUsualTrack;

  // Up to where road and plant are what they are taken for, and the damper's force changes no
  // faster than its spring and dashpot can stand for.
  constexpr double kOfModes = 2;
  NamedValues numbers = setup.known;
  for (std::size_t k = 0; k < plant.size(); ++k)
    numbers.emplace_back(setup.unknown[k].name, plant[k]);
  highest_ = std::min(
      kOfSampleRate / sample_time_,
      kOfModes * natural_frequencies(linear_plant(make_plant(*setup.model, numbers))).back());
  for (const PlantInputChannel& input : setup.inputs) {
    inputs_.push_back(input.place);
    if (input.road) highest_ = std::min(highest_, kOfWaves * kShortest * input.road->speed);
  }

  // The plant's numbers, then the law's.
  for (std::size_t k = 0; k < setup.unknown.size(); ++k) {
    plant_.push_back(plant[k] != 0 ? std::abs(plant[k]) : 1);
    lower_.push_back(setup.unknown[k].lower / plant_[k]);
    upper_.push_back(setup.unknown[k].upper / plant_[k]);
  }
  lower_.insert(lower_.end(), law.lower().begin(), law.lower().end());
  upper_.insert(upper_.end(), law.upper().begin(), law.upper().end());

  // What is of the sensors, in samples, then what is uncertain.
  first_of_sensors_ = lower_.size();
  of_sensors_ = sensor_unknowns(setup, sample_time_);
  for (const SensorUnknown& one : of_sensors_) {
    lower_.push_back(one.lower / sample_time_);
    upper_.push_back(one.upper / sample_time_);
  }
  first_noise_ = lower_.size();
  seek_noise(force);
  first_more_ = lower_.size();
  if (has_more) {
    more_ = {.stiffness = force / largest_of(rides, &DamperInput::displacement),
             .damping = force / largest_of(rides, &DamperInput::velocity)};
    for (std::size_t k = 0; k < 2; ++k) {
      lower_.push_back(-kMostBeside);
      upper_.push_back(kMostBeside);
    }
  }
  for (const RiddenRecording& ridden : rides) prepared_.push_back(ride_of(ridden));
}

void SpectralLikelihood::seek(std::string name, std::string unit,
                              std::function<double*(ObserverNoise&)> place, double low,
                              double high) {
  sought_.push_back({std::move(name), std::move(unit), std::move(place)});
  lower_.push_back(std::log(low));
  upper_.push_back(std::log(high));
}

void SpectralLikelihood::seek_noise(double force) {
  constexpr double kLeast = 1e-4, kParted = 0.1, kSlowest = 5, kWidestBand = 1e3;
  for (std::size_t e = 0; e < first_.force.size(); ++e) {
    const std::string name = e == 0 ? "quick error of the force" : "slow error of the force";
    const auto deviation = [e](ObserverNoise& n) { return &n.force[e].deviation; };
    const auto memory = [e](ObserverNoise& n) { return &n.force[e].memory; };
    seek(name, "N", deviation, kLeast * force, 2 * force);
    seek(name + ", memory", "s", memory, e == 0 ? sample_time_ : kParted,
         e == 0 ? kParted : kSlowest);
  }

  // Sensors that state none, and the road's class.
  const Plant plant = make_plant(*setup_->model, setup_->known);
  for (std::size_t s = 0; s < setup_->sensors.size(); ++s) {
    const PlantSensor& sensor = setup_->sensors[s];
    const auto place = [s](ObserverNoise& n) { return &n.sensors[s]; };
    if (sensor.noise == 0)
      seek("noise of " + sensor.channel, unit_of(sensor.place, plant), place,
           first_.sensors[s] / kWidestBand, first_.sensors[s] * kWidestBand);
  }
  if (unmeasured_road(*setup_)->roughness == 0)
    seek(
        "roughness of the road", "m^3", [](ObserverNoise& n) { return &n.roughness; },
        road_roughness('A') / 4, road_roughness('H'));

  // From tracks that differ by less than any sensor shows to those that share nothing.
  constexpr double kSame = 1e-4, kApart = 100;  // m
  if (!pairs_.empty())
    seek(
        "track width of the road", "m", [](ObserverNoise& n) { return &n.track_width; }, kSame,
        kApart);
}

SpectralLikelihood::Ride SpectralLikelihood::ride_of(const RiddenRecording& ridden) const {
  constexpr double kLowest = 0.3, kFewestWaves = 3;  // Hz; of a recording
  Ride ride{.samples = quick_length(ridden.samples), .shown = {}, .inputs = {}};
  ride.duration = static_cast<double>(ride.samples) * sample_time_;
  ride.first = static_cast<std::size_t>(std::ceil(std::max(kLowest * ride.duration, kFewestWaves)));
  ride.end = static_cast<std::size_t>(highest_ * ride.duration);
  ride.levels = held_levels(with_held_drives(*setup_, {ridden.recording, 1}));
  for (const PlantSensor& sensor : setup_->sensors)
    ride.shown.push_back(half_spectrum(
        std::span(ridden.recording->channel(sensor.channel).samples).first(ride.samples)));
  for (const PlantInputChannel& input : setup_->inputs)
    ride.inputs.push_back(
        input.road
            ? Lines{}
            : half_spectrum(
                  std::span(ridden.recording->channel(input.channel).samples).first(ride.samples)));
  return ride;
}

std::vector<double> SpectralLikelihood::start(const std::vector<double>& plant,
                                              const std::vector<double>& law) const {
  std::vector<double> x;
  for (std::size_t k = 0; k < plant.size(); ++k) x.push_back(plant[k] / plant_[k]);
  x.insert(x.end(), law.begin(), law.end());
  for (const SensorUnknown& one : of_sensors_) x.push_back(start_of(one, *setup_) / sample_time_);
  ObserverNoise noise = first_;
  for (const Sought& one : sought_) x.push_back(std::log(*one.place(noise)));
  x.resize(size());  // nothing beside the law
  return x;
}

std::vector<LawModel> SpectralLikelihood::laws(std::span<const double> x) const {
  return law_->models(x.subspan(plant_unknowns(), law_->size()));
}

ObserverNoise SpectralLikelihood::noise(std::span<const double> x) const {
  ObserverNoise noise = first_;
  for (std::size_t k = 0; k < sought_.size(); ++k)
    *sought_[k].place(noise) = std::exp(x[first_noise_ + k]);
  return noise;
}

InPlantSetup SpectralLikelihood::setup_at(std::span<const double> x) const {
  InPlantSetup setup = *setup_;
  for (std::size_t k = 0; k < plant_unknowns(); ++k)
    setup.known.emplace_back(
        setup.unknown[k].name,
        std::clamp(plant_[k] * x[k], setup.unknown[k].lower, setup.unknown[k].upper));
  setup.unknown.clear();
  for (std::size_t k = 0; k < of_sensors_.size(); ++k)
    put(of_sensors_[k], x[first_of_sensors_ + k] * sample_time_, setup.sensors);
  const ObserverNoise uncertain = noise(x);
  for (std::size_t s = 0; s < setup.sensors.size(); ++s)
    setup.sensors[s].noise = uncertain.sensors[s];
  for (PlantInputChannel& input : setup.inputs)
    if (input.road) input.road->roughness = uncertain.roughness;
  return setup;
}

SpectralLikelihood::Force SpectralLikelihood::force_of(std::span<const double> x,
                                                       std::size_t ride) const {
  const auto& motions = (*rides_)[ride].motions;
  const std::vector<LawModel> models = at_held_levels(laws(x), prepared_[ride].levels);
  Force found;
  for (std::size_t d = 0; d < motions.size(); ++d)
    if (!add_force(models[setup_->kinds.at(d)],
                   std::span(motions[d]).first(prepared_[ride].samples), found))
      return {};
  return found;
}

bool SpectralLikelihood::add_force(const LawModel& model, std::span<const DamperInput> motion,
                                   Force& force) const {
  std::vector<double> state(model.state_size()), newton(motion.size());
  model.rest(motion.front(), state);
  if (model.run(motion, {.step = sample_time_}, state, {.force = newton.data()}) < newton.size())
    return false;
  const auto stand_in = stand_in_of(motion, newton);
  if (!stand_in) return false;
  for (std::size_t k = 0; k < newton.size(); ++k)
    newton[k] -=
        stand_in->stiffness * motion[k].displacement + stand_in->damping * motion[k].velocity;
  force.stand_ins.push_back(*stand_in);
  force.rests.push_back(half_spectrum(newton));
  return true;
}

bool SpectralLikelihood::evaluate(std::span<const double> x, std::size_t which, const Force& force,
                                  Spectra& spectra) const {
  const Ride& ride = prepared_[which];
  const InPlantSetup setup = setup_at(x);
  const ObserverNoise uncertain = noise(x);
  const DrivenPlant plant(make_plant(*setup.model, setup.known), inputs_);
  const auto roads = static_cast<std::size_t>(std::ranges::count_if(
      setup.inputs, [](const PlantInputChannel& one) { return one.road.has_value(); }));
  std::vector<std::vector<Complex>> by_inputs(setup.inputs.size(), std::vector<Complex>(sensors()));
  const std::size_t n = plant.size(), m = sensors(), lines = ride.end - ride.first,
                    ends = 2 * n + 2 * m + roads;
  spectra.beyond.assign(lines * m, 0);
  spectra.covariance.assign(lines * m * m, 0);
  std::vector<Complex> columns(lines * m * ends), whitened(m * ends), shows(m), factor, shown;
  EndTerms terms(ends);
  std::vector<StandIn> stand_ins = force.stand_ins;
  for (StandIn& one : stand_ins)
    if (first_more_ < size()) {
      one.stiffness += more_.stiffness * x[first_more_];
      one.damping += more_.damping * x[first_more_ + 1];
    }
  PlantAtLine at(plant, setup, stand_ins);
  const double scale = sample_time_ / std::sqrt(ride.duration);
  for (std::size_t l = 0; l < lines; ++l) {
    const std::size_t line = ride.first + l;
    Complex* beyond = &spectra.beyond[l * m];
    Complex* covariance = &spectra.covariance[l * m * m];
    Complex* column = &columns[l * m * ends];
    at.move_to(kTurn * static_cast<double>(line) / ride.duration);

    // What the sensors show without the law's forces, whose errors are left, and their own noise.
    for (std::size_t s = 0; s < m; ++s) beyond[s] = ride.shown[s][line];
    for (std::size_t d = 0; d < force.rests.size(); ++d) {
      at.of_force(d, shows);
      add_noise(shows, error_density(uncertain, at.w()), covariance);
      for (std::size_t s = 0; s < m; ++s) beyond[s] -= shows[s] * force.rests[d][line];
    }
    for (std::size_t s = 0; s < m; ++s) {
      beyond[s] *= scale;
      covariance[s * m + s] += sample_time_ * uncertain.sensors[s] * uncertain.sensors[s];
    }

    // Inputs: those measured, and roads by their prior and the step between their ends; then what
    // roads side by side share.
    std::size_t end = 2 * n + 2 * m;
    for (std::size_t u = 0; u < setup.inputs.size(); ++u) {
      const PlantInputChannel& input = setup.inputs[u];
      std::vector<Complex>& by_input = by_inputs[u];
      at.of_input(u, by_input);
      add_noise(by_input,
                input.road ? road_density_over_time(uncertain.roughness, input.road->speed, at.w())
                           : sample_time_ * input.noise * input.noise,
                covariance);
      for (std::size_t s = 0; s < m; ++s)
        if (input.road)
          column[s * ends + end] = by_input[s] / at.iw();
        else
          beyond[s] -= scale * by_input[s] * ride.inputs[u][line];
      end += input.road.has_value();
    }
    for (const auto& [left, right] : pairs_) {
      const double speed = setup.inputs[left].road->speed;
      add_shared_noise(by_inputs[left], by_inputs[right],
                       road_density_over_time(uncertain.roughness, speed, at.w()) *
                           shared_part(at.w() / kTurn / speed, uncertain.track_width),
                       covariance);
    }
    put_end_columns(at, n, ends, shows, column);

    // Whitened, for the least squares over all lines.
    factor.assign(covariance, covariance + m * m);
    if (!factorise(factor.data(), m)) return false;
    shown.assign(beyond, beyond + m);
    solve_lower(factor.data(), m, shown.data());
    std::copy_n(column, m * ends, whitened.data());
    for (std::size_t e = 0; e < ends; ++e) solve_lower(factor.data(), m, &whitened[e], ends);
    terms.add(whitened.data(), shown.data(), m);
  }

  // Without the end terms.
  const std::vector<double> coefficients = terms.solved();
  for (std::size_t i = 0; i < lines * m; ++i) {
    for (std::size_t e = 0; e < ends; ++e)
      spectra.beyond[i] -= coefficients[e] * columns[i * ends + e];
    if (!std::isfinite(std::norm(spectra.beyond[i]))) return false;
  }
  return true;
}

bool SpectralLikelihood::is_of_law(std::size_t k) const {
  return k >= plant_unknowns() && k < first_of_sensors_;
}

const SensorUnknown* SpectralLikelihood::of_sensor(std::size_t k) const {
  return k >= first_of_sensors_ && k < first_noise_ ? &of_sensors_[k - first_of_sensors_] : nullptr;
}

std::vector<LawUnknowns::Coefficient> SpectralLikelihood::law_coefficients(
    std::span<const double> x) const {
  return law_->coefficients(x.subspan(plant_unknowns(), law_->size()));
}

std::string SpectralLikelihood::name(std::size_t k) const {
  if (k < plant_unknowns()) return setup_->unknown[k].name;
  if (k >= first_more_) return k == first_more_ ? "spring" : "dashpot";
  if (k >= first_noise_) return sought_[k - first_noise_].name;
  if (const SensorUnknown* one = of_sensor(k)) return name_of(*one, *setup_);
  return name_in_law(*this, plant_unknowns(), k, size());
}

double SpectralLikelihood::size_at(std::size_t k, std::span<const double> x) const {
  if (k < plant_unknowns()) return plant_[k];
  if (k >= first_more_) return k == first_more_ ? more_.stiffness : more_.damping;
  return k >= first_noise_ ? std::exp(x[k]) : sample_time_;
}

FittedParameter SpectralLikelihood::described(std::size_t k, std::span<const double> x) const {
  FittedParameter p{.name = name(k), .unit = "s", .meaning = {}, .value = size_at(k, x)};
  if (!is_noise(k)) p.value *= x[k];
  const double margin = kAtBound * std::max(1.0, std::abs(x[k]));
  p.at_bound = x[k] <= lower_[k] + margin || x[k] >= upper_[k] - margin;
  if (is_noise(k)) p.unit = sought_[k - first_noise_].unit;
  if (k >= first_more_) p.unit = k == first_more_ ? "N/m" : "N*s/m";
  if (k >= plant_unknowns()) return p;
  const auto& rows = setup_->model->parameters;
  const ParameterRow& row = rows[row_named(rows, p.name, setup_->model->name, "plant")];
  p.unit = row.unit;
  p.meaning = row.meaning;
  return p;
}

namespace {

/// A ride at one point: its spectra whitened, and the factors that whiten them.
struct Whitened {
  SpectralLikelihood::Force force;
  SpectralLikelihood::Spectra spectra;
  std::vector<Complex> factors, residual;
  double value = INFINITY;  ///< -log L
};

void whiten(const SpectralLikelihood& likelihood, std::span<const double> x, std::size_t ride,
            Whitened& at) {
  const std::size_t m = likelihood.sensors();
  at.value = INFINITY;
  at.force = likelihood.force_of(x, ride);
  if (at.force.rests.empty() || !likelihood.evaluate(x, ride, at.force, at.spectra)) return;
  at.factors = at.spectra.covariance;
  at.residual = at.spectra.beyond;
  double sum = 0;
  for (std::size_t l = 0; l * m < at.residual.size(); ++l) {
    Complex* factor = &at.factors[l * m * m];
    if (!factorise(factor, m)) return;
    solve_lower(factor, m, &at.residual[l * m]);
    for (std::size_t s = 0; s < m; ++s)
      sum += 2 * std::log(factor[s * m + s].real()) + std::norm(at.residual[l * m + s]);
  }
  at.value = sum;
}

/// Rows of r and J per line: of the residuals 2 per sensor, of their covariance m^2.
std::size_t rows_per_line(std::size_t m) { return 2 * m + m * m; }

/// A Hermitian matrix as real rows whose products are traces.
void put_hermitian(const Complex* a, std::size_t m, double* rows) {
  for (std::size_t i = 0; i < m; ++i) {
    *rows++ = a[i * m + i].real();
    for (std::size_t k = 0; k < i; ++k) {
      *rows++ = std::numbers::sqrt2 * a[i * m + k].real();
      *rows++ = std::numbers::sqrt2 * a[i * m + k].imag();
    }
  }
}

std::vector<double> residual_rows(const Whitened& at, std::size_t m) {
  const std::size_t lines = at.residual.size() / m;
  std::vector<double> rows(lines * rows_per_line(m));
  std::vector<Complex> left(m * m);
  for (std::size_t l = 0; l < lines; ++l) {
    double* row = &rows[l * rows_per_line(m)];
    const Complex* e = &at.residual[l * m];
    for (std::size_t s = 0; s < m; ++s) {
      row[2 * s] = std::numbers::sqrt2 * e[s].real();
      row[2 * s + 1] = std::numbers::sqrt2 * e[s].imag();
      for (std::size_t k = 0; k <= s; ++k)
        left[s * m + k] = (s == k ? 1.0 : 0.0) - e[s] * std::conj(e[k]);
    }
    put_hermitian(left.data(), m, row + 2 * m);
  }
  return rows;
}

/// The rows of one unknown in one ride, by a difference; the other way where the bounds or the law
/// leave no room. Empty: neither way; of one that is held, nothing changes.
std::vector<double> column_rows(const SpectralLikelihood& likelihood, std::span<const double> x,
                                std::size_t k, std::size_t ride, const Whitened& at) {
  constexpr double kStep = 1e-5;
  const std::size_t m = likelihood.sensors(), lines = at.residual.size() / m;
  const double length = kStep * std::max(1.0, std::abs(x[k]));
  const bool upward = x[k] + length <= likelihood.upper()[k];
  std::vector<double> moved(x.begin(), x.end()), rows(lines * rows_per_line(m));
  if (likelihood.is_held(k)) return rows;
  std::vector<Complex> change(m * m);
  SpectralLikelihood::Spectra beside;
  for (const double step : {upward ? length : -length, upward ? -length : length}) {
    moved[k] = x[k] + step;
    if (moved[k] < likelihood.lower()[k] || moved[k] > likelihood.upper()[k]) continue;
    SpectralLikelihood::Force force;
    if (likelihood.is_of_law(k)) force = likelihood.force_of(moved, ride);
    if (likelihood.is_of_law(k) && force.rests.empty()) continue;
    if (!likelihood.evaluate(moved, ride, likelihood.is_of_law(k) ? force : at.force, beside))
      continue;
    for (std::size_t l = 0; l < lines; ++l) {
      double* row = &rows[l * rows_per_line(m)];
      const Complex* factor = &at.factors[l * m * m];
      for (std::size_t s = 0; s < m; ++s)
        change[s] = (beside.beyond[l * m + s] - at.spectra.beyond[l * m + s]) / step;
      solve_lower(factor, m, change.data());
      for (std::size_t s = 0; s < m; ++s) {
        row[2 * s] = std::numbers::sqrt2 * change[s].real();
        row[2 * s + 1] = std::numbers::sqrt2 * change[s].imag();
      }

      // L^-1 dS L^-H: the columns, then the rows.
      for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j < m; ++j) {
          const std::size_t place = l * m * m + std::max(i, j) * m + std::min(i, j);
          const Complex d = (beside.covariance[place] - at.spectra.covariance[place]) / step;
          change[i * m + j] = i >= j ? d : std::conj(d);
        }
      for (std::size_t j = 0; j < m; ++j) solve_lower(factor, m, &change[j], m);
      for (Complex& one : change) one = std::conj(one);
      for (std::size_t i = 0; i < m; ++i) solve_lower(factor, m, &change[i * m]);
      for (Complex& one : change) one = std::conj(one);
      put_hermitian(change.data(), m, row + 2 * m);
    }
    return rows;
  }
  return {};
}

/// Adds one ride's gradient, information and scores by blocks of lines.
void add_ride(const std::vector<double>& residual, const std::vector<std::vector<double>>& columns,
              std::size_t block, LikelihoodSlopes& slopes) {
  const std::size_t n = columns.size();
  for (std::size_t begin = 0; begin < residual.size(); begin += block) {
    const std::size_t end = std::min(begin + block, residual.size());
    std::vector<double> score(n);
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t i = begin; i < end; ++i) score[k] += columns[k][i] * residual[i];
      slopes.gradient[k] += score[k];
      for (std::size_t m = 0; m <= k; ++m) {
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i) sum += columns[k][i] * columns[m][i];
        slopes.information[k * n + m] += sum;
      }
    }
    slopes.block_scores.push_back(std::move(score));
  }
}

double value_at(const SpectralLikelihood& likelihood, std::span<const double> x, int threads,
                std::vector<Whitened>& at) {
  at.resize(likelihood.rides());
  parallel_for(at.size(), threads, [&](std::size_t r) { whiten(likelihood, x, r, at[r]); });
  double sum = 0;
  for (const Whitened& one : at) sum += one.value;
  return std::isfinite(sum) ? sum : static_cast<double>(INFINITY);
}

LikelihoodSlopes slopes_of(const SpectralLikelihood& likelihood, std::span<const double> x,
                           const std::vector<Whitened>& at, double value, int threads) {
  const std::size_t n = likelihood.size(), rides = likelihood.rides(), m = likelihood.sensors();
  LikelihoodSlopes slopes{.finite = std::isfinite(value), .value = value};
  if (!slopes.finite) return slopes;
  std::vector<std::vector<std::vector<double>>> columns(rides, std::vector<std::vector<double>>(n));
  parallel_for(n * rides, threads, [&](std::size_t task) {
    const std::size_t k = task / rides, r = task % rides;
    columns[r][k] = column_rows(likelihood, x, k, r, at[r]);
  });
  slopes.gradient.resize(n);
  slopes.information.resize(n * n);
  for (const auto& ride : columns)
    for (const std::vector<double>& column : ride) slopes.finite &= !column.empty();
  if (!slopes.finite) return slopes;

  // Blocks of lines as long as leave enough of them.
  constexpr std::size_t kMostLines = 20;
  std::size_t lines = 0;
  for (const Whitened& one : at) lines += one.residual.size() / m;
  const std::size_t block =
      std::clamp<std::size_t>(lines / ((kBlocksPerUnknown + 1) * n), 1, kMostLines);
  for (std::size_t r = 0; r < rides; ++r)
    add_ride(residual_rows(at[r], m), columns[r], block * rows_per_line(m), slopes);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < k; ++i)
      slopes.information[i * n + k] = slopes.information[k * n + i];
  return slopes;
}

/// The step of those unknowns that no bound holds, and what it would win.
std::pair<std::vector<double>, double> scoring_step(const SpectralLikelihood& likelihood,
                                                    std::span<const double> x,
                                                    const LikelihoodSlopes& slopes,
                                                    double damping) {
  const std::size_t n = x.size();
  std::vector<std::size_t> free;
  for (std::size_t k = 0; k < n; ++k) {
    const bool held = (x[k] <= likelihood.lower()[k] && slopes.gradient[k] > 0) ||
                      (x[k] >= likelihood.upper()[k] && slopes.gradient[k] < 0);
    if (!held && slopes.information[k * n + k] > 0) free.push_back(k);
  }
  const std::size_t m = free.size();

  // Scaled to a curvature of 1 each.
  std::vector<double> size(m), matrix(m * m), right(m), solution(m), step(n);
  for (std::size_t i = 0; i < m; ++i)
    size[i] = 1 / std::sqrt(slopes.information[free[i] * n + free[i]]);
  for (std::size_t i = 0; i < m; ++i) {
    right[i] = -slopes.gradient[free[i]] * size[i];
    for (std::size_t k = 0; k < m; ++k)
      matrix[i * m + k] = slopes.information[free[i] * n + free[k]] * size[i] * size[k];
    matrix[i * m + i] += damping;
  }
  if (m == 0 || !solve_positive_definite(matrix, right, solution)) return {step, 0};
  double won = 0;
  for (std::size_t i = 0; i < m; ++i) {
    step[free[i]] = size[i] * solution[i];
    won += 0.5 * right[i] * solution[i];
  }
  return {step, won};
}

}  // namespace

MostLikely most_likely(const SpectralLikelihood& likelihood, std::vector<double> x, int iterations,
                       int threads, const Monitor& monitor) {
  constexpr double kFirstDamping = 1e-2, kLeastDamping = 1e-9, kMostDamping = 1e6;
  constexpr double kFurthest = 1.5, kCloseEnough = 0.02;  // of -log L, what a step would win
  MostLikely found;
  for (std::size_t k = 0; k < x.size(); ++k)
    x[k] = std::clamp(x[k], likelihood.lower()[k], likelihood.upper()[k]);
  std::vector<Whitened> at;
  double value = value_at(likelihood, x, threads, at);
  found.slopes = slopes_of(likelihood, x, at, value, threads);
  double damping = kFirstDamping;
  while (found.slopes.finite && found.iterations < iterations && damping < kMostDamping) {
    monitor.check();
    const auto [step, won] = scoring_step(likelihood, x, found.slopes, damping);
    if (won < kCloseEnough) {
      found.converged = true;
      break;
    }

    // No unknown goes further than its size, or by a factor of e^1.5, at a time.
    std::vector<double> next = x;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double most =
          kFurthest * (likelihood.is_of_law(k) ? std::max(1.0, std::abs(x[k])) : 1.0);
      next[k] = std::clamp(x[k] + std::clamp(step[k], -most, most), likelihood.lower()[k],
                           likelihood.upper()[k]);
    }
    std::vector<Whitened> there;
    value = value_at(likelihood, next, threads, there);
    if (!(value < found.slopes.value)) {
      damping *= 5;
      continue;
    }
    LikelihoodSlopes slopes = slopes_of(likelihood, next, there, value, threads);
    if (!slopes.finite) {
      damping *= 5;
      continue;
    }
    x = std::move(next);
    found.slopes = std::move(slopes);
    damping = std::max(damping / 5, kLeastDamping);
    ++found.iterations;
  }
  found.x = std::move(x);
  return found;
}

}  // namespace dashpot
