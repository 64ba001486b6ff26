#include "dashpot/machine/observe.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/machine/between_samples.h"
#include "dashpot/machine/beyond_models.h"
#include "dashpot/machine/damper_drive.h"
#include "dashpot/machine/recording_parts.h"
#include "dashpot/machine/sensor_faults.h"
#include "dashpot/numerics/distributions.h"
#include "dashpot/numerics/minimise.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "dashpot/suspension/ground/road_profile.h"

namespace dashpot {
namespace {

constexpr std::size_t kFewestObserved = 100;
constexpr double kOffsetShare = 0.3;   // of a sensor's span, where nothing else is known
constexpr std::size_t kOfStart = 500;  // samples that tell where a recording begins
constexpr double kParted = 0.1;        // s: a quick error of the force is forgotten sooner

double rms_of(const std::vector<double>& samples) {
  double sum = 0, square = 0;
  const auto count = static_cast<double>(samples.size());
  for (const double sample : samples) sum += sample / count;
  for (const double sample : samples) square += (sample - sum) * (sample - sum) / count;
  return std::sqrt(square);
}

/// Throws Error where so many steps per sample would never end.
void require_steps(int steps) {
  constexpr int kMost = 1000;
  if (steps > kMost)
    throw Error("steps", "is " + std::to_string(steps) + " per sample",
                std::to_string(kMost) + " at most; 0: as many as the filter's error asks for");
}

/// Throws Error where a sensor shows nothing but one number.
void require_signals(const InPlantSetup& setup, const std::vector<PlantRecording>& recordings) {
  for (const PlantRecording& recording : recordings)
    for (const PlantSensor& sensor : setup.sensors) {
      const auto [low, high] = std::ranges::minmax(recording.channel(sensor.channel).samples);
      if (low == high)
        throw Error(recording.name + ", " + sensor.channel, "is constant",
                    "a sensor that shows the motion; leave it out of the plant where it is dead");
    }
}

/// Whether the force leaps at some drive where the stroke crosses 0, while nothing moves.
bool leaps_at_zero(const ObservedDamper& damper, const ObserverScale& scale) {
  constexpr double kHardly = 1e-9, kLeap = 0.01;  // of stroke and force
  const auto& [model, domain] = damper;
  std::vector<double> z(model->state_size());
  for (const double drive :
       {domain.current_min, (domain.current_min + domain.current_max) / 2, domain.current_max}) {
    model->rest({0, 0, drive}, z);
    const auto force = [&](double x) { return model->force({x * scale.stroke, 0, drive}, z); };
    if (std::abs(force(kHardly) - force(-kHardly)) > kLeap * scale.force) return true;
  }
  return false;
}

/// What is uncertain as logarithms of those that were not stated, which are searched for.
class NoiseSearch {
 public:
  /// At a first guess. leaps: whether a damper's force does where the stroke crosses 0.
  NoiseSearch(const InPlantSetup& setup, const std::vector<PlantRecording>& recordings,
              const ObserverScale& scale, bool leaps, const ObserveOptions& options);

  const ObserverNoise& first() const { return noise_; }
  /// The same from `found` on, beside a shift of the velocity which that has.
  NoiseSearch beside_shift(const ObserverNoise& found, const ObserverScale& scale,
                           double sample_time) const;
  std::size_t size() const { return sought_.size(); }
  std::vector<double> start() const {
    std::vector<double> x;
    ObserverNoise noise = noise_;
    for (const Sought& one : sought_) x.push_back(std::log(*one.place(noise)));
    return x;
  }
  /// The uncertainties at x, held between their limits, and what x lies beyond these, squared.
  std::pair<ObserverNoise, double> at(std::span<const double> x) const {
    ObserverNoise noise = noise_;
    double beyond = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double inside = std::clamp(x[k], sought_[k].low, sought_[k].high);
      beyond += (x[k] - inside) * (x[k] - inside);
      *sought_[k].place(noise) = std::exp(inside);
    }
    if (least_staying_ > 0) size_staying_error(noise);
    return {std::move(noise), beyond};
  }

 private:
  struct Sought {
    std::function<double*(ObserverNoise&)> place;
    double low, high;  ///< of the logarithm
  };
  void seek(std::function<double*(ObserverNoise&)> place, double low, double high) {
    sought_.push_back({std::move(place), std::log(low), std::log(high)});
  }

  /// What stays of the force's error, of which a recording tells a single number: three times as
  /// large as the quick one.
  void size_staying_error(ObserverNoise& noise) const {
    noise.force.back().deviation = std::max(3 * noise.force.front().deviation, least_staying_);
  }

  ObserverNoise noise_;
  double least_staying_ = 0;  ///< N; 0: no error that stays is looked for
  std::vector<Sought> sought_;
};

NoiseSearch::NoiseSearch(const InPlantSetup& setup, const std::vector<PlantRecording>& recordings,
                         const ObserverScale& scale, bool leaps, const ObserveOptions& options) {
  constexpr double kFirstForce = 0.02, kFirstNoise = 0.02, kWidest = 1e4, kSlowest = 5;
  constexpr double kLeastStaying = 1e-3;
  constexpr double kFirstQuick = 5;                       // memory of the quick error, samples
  const double quickest = options.is_straight ? 2 : 0.5;  // where it goes straight it has one
  const double sample_time = recordings.front().sample_time;

  // A quick error of the model and a slow one, which no single one can stand for; and one that
  // stays, without which a sensor's zero would be taken for off. Beside a leap that draws the zero
  // it would only leave that free to go.
  noise_.is_straight = options.is_straight;
  noise_.force = options.force;
  noise_.shift = options.shift;
  if (noise_.force.empty()) {
    noise_.force = {{kFirstForce * scale.force, kFirstQuick * sample_time},
                    {kFirstForce * scale.force, 0.5}};
    for (std::size_t e = 0; e < noise_.force.size(); ++e) {
      seek([e](ObserverNoise& n) { return &n.force[e].deviation; }, 1e-5 * scale.force,
           2 * scale.force);
      seek([e](ObserverNoise& n) { return &n.force[e].memory; },
           e == 0 ? quickest * sample_time : kParted, e == 0 ? kParted : kSlowest);
    }
    if (!options.is_straight && !leaps) {
      least_staying_ = kLeastStaying * scale.force;
      noise_.force.push_back({0, kStayingError});
      size_staying_error(noise_);
    }
  }

  // A sensor's noise, from a first guess by its signal.
  for (std::size_t s = 0; s < setup.sensors.size(); ++s) {
    const PlantSensor& sensor = setup.sensors[s];
    const double rms = rms_of(recordings.front().channel(sensor.channel).samples);
    noise_.sensors.push_back(sensor.noise > 0 ? sensor.noise : kFirstNoise * rms);
    if (sensor.noise == 0)
      seek([s](ObserverNoise& n) { return &n.sensors[s]; }, rms / kWidest, rms);
  }
  const RoadPrior* road = unmeasured_road(setup);
  if (!road) return;
  noise_.roughness = road->roughness > 0 ? road->roughness : road_roughness('C');
  if (road->roughness == 0)
    seek([](ObserverNoise& n) { return &n.roughness; }, road_roughness('A') / 4,
         road_roughness('H'));
}

NoiseSearch NoiseSearch::beside_shift(const ObserverNoise& found, const ObserverScale& scale,
                                      double sample_time) const {
  NoiseSearch more = *this;
  more.noise_ = found;
  more.seek([](ObserverNoise& n) { return &n.shift.deviation; }, 1e-6 * scale.speed,
            0.3 * scale.speed);
  more.seek([](ObserverNoise& n) { return &n.shift.memory; }, std::min(2 * sample_time, kParted),
            kParted);
  return more;
}

using DamperModels = std::vector<std::shared_ptr<const DamperModel>>;

std::vector<PlantObserver> observers_of(const DamperModels& dampers, const InPlantSetup& setup,
                                        const std::vector<PlantRecording>& recordings,
                                        const ObserverNoise& noise, const ObserverScale& scale,
                                        int steps) {
  std::vector<PlantObserver> observers;
  for (const PlantRecording& recording : recordings)
    observers.emplace_back(
        observer_tables(setup, dampers, noise, scale, recording.sample_time, steps), dampers);
  return observers;
}

/// So many steps per sample, `steps` or more, that twice as many change the forces of the recording
/// by less than 0.3 % of their scale.
int enough_steps(const DamperModels& dampers, const InPlantSetup& setup, const ObserverNoise& noise,
                 const ObserverScale& scale, const PlantRecording& recording,
                 const ObservedSamples& samples, int steps) {
  constexpr int kFinestSteps = 32;
  constexpr std::size_t kTried = 1500;
  constexpr double kEnough = 0.003;

  // The forces along the first samples, by so many steps.
  const auto forces = [&](int tried) {
    ObservedSamples some = samples;
    some.count = std::min(samples.count, kTried);
    const PlantObserver observer(
        observer_tables(setup, dampers, noise, scale, recording.sample_time, tried), dampers);
    const ObservedRun run = filtered(observer, some);
    std::vector<double> force;
    for (std::size_t k = 1; k < some.count; ++k)
      for (std::size_t d = 0; d < dampers.size(); ++d)
        force.push_back(observer
                            .damper_at(d, some.driven_at(k - 1), some.driven_at(k),
                                       run.at(k, observer.tables()))
                            .force);
    return force;
  };

  // Twice as many, until that changes little.
  for (std::vector<double> coarse = forces(steps); steps < kFinestSteps; steps *= 2) {
    std::vector<double> fine = forces(2 * steps), change(fine.size());
    for (std::size_t k = 0; k < fine.size(); ++k) change[k] = fine[k] - coarse[k];
    if (rms_of(change) < kEnough * scale.force) break;
    coarse = std::move(fine);
  }
  return steps;
}

/// Where each recording begins, twice over: the second time from where the first one came to.
void find_starts(const DamperModels& dampers, const InPlantSetup& setup,
                 const std::vector<PlantRecording>& recordings, const ObserverNoise& noise,
                 const ObserverScale& scale, int steps, std::vector<ObservedSamples>& samples) {
  const std::vector<PlantObserver> observers =
      observers_of(dampers, setup, recordings, noise, scale, steps);
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t r = 0; r < recordings.size(); ++r) {
      std::vector<double> about = smoothed_start(observers[r], samples[r], kOfStart);
      if (std::ranges::all_of(about, [](double x) { return std::isfinite(x); }))
        samples[r].about = std::move(about);
    }
}

constexpr std::size_t kTelling = 6000;  // samples, of all recordings, that tell the uncertainties

/// The recordings from where each moves as it usually does.
std::vector<PlantRecording> usual_parts(const InPlantSetup& setup,
                                        const std::vector<PlantRecording>& recordings) {
  std::vector<PlantRecording> moving = moving_parts(setup, recordings);
  const std::size_t horizon = std::max(kTelling / moving.size(), kFewestObserved);
  std::vector<PlantRecording> lively = lively_parts(setup, moving, horizon);
  return lively.empty() ? moving : lively;
}

std::vector<ObservedSamples> samples_of(const InPlantSetup& setup,
                                        const std::vector<PlantRecording>& recordings) {
  std::vector<ObservedSamples> samples;
  for (const PlantRecording& recording : recordings)
    samples.push_back(observed_samples(setup, recording));
  return samples;
}

/// What uncertainties are found from.
struct Telling {
  const DamperModels& dampers;
  const InPlantSetup& setup;
  const std::vector<PlantRecording>& recordings;
  const std::vector<ObservedSamples>& samples;
  const ObserverScale& scale;
  int steps;

  /// How unlikely the first samples of the recordings are: -2 log likelihood, less a constant.
  double misfit_under(const ObserverNoise& noise) const {
    constexpr std::size_t kSettled = 50;  // samples
    const std::size_t used = std::max(kTelling / recordings.size(), 4 * kSettled);
    const std::vector<PlantObserver> observers =
        observers_of(dampers, setup, recordings, noise, scale, steps);
    double sum = 0;
    for (std::size_t r = 0; r < recordings.size(); ++r)
      sum += misfit(observers[r], samples[r], kSettled, std::min(samples[r].count, used));
    return sum;
  }
};

/// Uncertainties, and how unlikely the recordings are under them.
struct LikelyNoise {
  ObserverNoise noise;
  double misfit = INFINITY;
};

/// The uncertainties under which the recordings are most likely. begun: progress so far.
LikelyNoise most_likely(const NoiseSearch& search, const Telling& telling,
                        const ObserveOptions& options, double begun) {
  constexpr double kStep = 0.01, kWall = 100;

  // Beyond the limits the misfit rises steeply.
  const auto misfit_at = [&](std::span<const double> x) {
    const auto [noise, beyond] = search.at(x);
    return kWall * beyond + telling.misfit_under(noise);
  };

  // Differences in every direction, a core each.
  MinimiseOptions solver{.max_iterations = 40, .function_tolerance = 1e-5};
  solver.on_iteration = [&](int iteration, double, std::span<const double>) {
    options.monitor.check();
    options.monitor.report("uncertainties", begun + 0.0075 * iteration);
    return true;
  };
  const MinimiseReport found = minimise(
      [&](std::span<const double> x, double& value, std::span<double> gradient) {
        std::vector<double> values(x.size() + 1);
        parallel_for(values.size(), options.threads, [&](std::size_t k) {
          std::vector<double> beside(x.begin(), x.end());
          if (k > 0) beside[k - 1] += kStep;
          values[k] = misfit_at(beside);
        });
        value = values[0];
        for (std::size_t k = 0; k < x.size(); ++k) gradient[k] = (values[k + 1] - value) / kStep;
        return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
      },
      search.start(), solver);
  if (found.x.empty() || !std::isfinite(found.value)) return {search.first()};
  return {search.at(found.x).first, found.value};
}

/// The same beside a shift of the velocities by which the models' forces go, where the recordings
/// are likelier with one by more than two numbers more are worth; else what was found without it.
/// Source: G. Schwarz, Estimating the dimension of a model, Annals of Statistics 6, 1978.
LikelyNoise with_shift(const NoiseSearch& search, const LikelyNoise& without,
                       const Telling& telling, const ObserveOptions& options) {
  constexpr std::array kFirstShares = {3e-4, 1e-3, 3e-3, 1e-2};  // of the speed
  constexpr double kFirstMemory = 0.02;                          // s

  // How large it may be, beside all else as it was found.
  std::array<LikelyNoise, kFirstShares.size()> tried;
  parallel_for(tried.size(), options.threads, [&](std::size_t k) {
    tried[k].noise = without.noise;
    tried[k].noise.shift = {kFirstShares[k] * telling.scale.speed, kFirstMemory};
    tried[k].misfit = telling.misfit_under(tried[k].noise);
  });
  const LikelyNoise& first = *std::ranges::min_element(tried, {}, &LikelyNoise::misfit);
  if (!(first.misfit < without.misfit)) return without;

  // From there on together.
  const LikelyNoise with = most_likely(
      search.beside_shift(first.noise, telling.scale, telling.recordings.front().sample_time),
      telling, options, 0.4);
  const double worth = 2 * std::log(static_cast<double>(kTelling * telling.setup.sensors.size()));
  return with.misfit < without.misfit - worth ? with : without;
}

/// How the dampers were observed to move, once the filter had settled.
DamperMotions motions_of(const std::vector<ObservedSamples>& samples, const ObserveReport& report) {
  constexpr double kSettled = 1;  // s, in which the filter settles
  const std::size_t count = report.struts.size();
  DamperMotions motions(count);
  for (std::size_t d = 0; d < count; ++d)
    for (std::size_t r = 0; r < samples.size(); ++r) {
      const ObservedRecording& told = report.recordings[r];
      const DamperQuantities places = damper_quantities(d, count);
      const std::vector<double>&deflection = told.quantities[places.deflection].value,
            &velocity = told.quantities[places.velocity].value;
      const std::size_t first =
          std::min(samples[r].count / 2, static_cast<std::size_t>(kSettled / told.sample_time));
      std::vector<DamperInput>& motion = motions[d].emplace_back();
      for (std::size_t k = first; k < samples[r].count; ++k)
        motion.push_back({deflection[k], velocity[k], samples[r].drive_at(k, d)});
    }
  return motions;
}

/// Sensors whose zeros came out far from where they were looked for: the filter gives up a part of
/// the motion and of the force in their stead. A law that leaps at 0 says where that is by its
/// leap, which the damper need not have there.
std::vector<std::string> far_zeros(const InPlantSetup& setup, const ObserverScale& scale,
                                   bool leaps, const ObserveReport& report) {
  const double far = leaps ? 2 : 5;  // standard deviations
  std::vector<std::string> told;
  for (std::size_t s = 0; s < setup.sensors.size(); ++s) {
    // The recording in which it is furthest off.
    const ObservedRecording* worst = &report.recordings.front();
    for (const ObservedRecording& one : report.recordings)
      if (std::abs(one.sensors[s].offset) > std::abs(worst->sensors[s].offset)) worst = &one;
    const ObservedSensor& sensor = worst->sensors[s];
    if (!(std::abs(sensor.offset) > far * scale.offset[s])) continue;

    // What that does, and what to do.
    told.push_back(worst->name + ", " + sensor.channel + ": its zero came out at " +
                   format_number(sensor.offset, 3) + ' ' + sensor.unit +
                   ", and was looked for within " + format_number(scale.offset[s], 3) +
                   ": motion and force lean by it, beyond their bands; take it off (an "
                   "accelerometer may show gravity), or state 'zero' at the sensor");
    if (leaps)
      told.back() +=
          "; or the leap of this model where the stroke crosses 0 was taken for where "
          "that is: try one without, as bouc_wen";
  }
  return told;
}

/// Filters of a recording with the uncertainties as they are, and where slow errors of the force
/// were found, with less and less of these: they may have been found in the place of a drift.
std::vector<PlantObserver> with_less_slow_errors(
    const DamperModels& models, const InPlantSetup& setup, const PlantRecording& recording,
    const ObserverNoise& noise, const ObserverScale& scale, int steps, bool were_found) {
  std::vector<PlantObserver> tried;
  for (const double share : {1.0, 0.3, 0.1, 0.03}) {
    ObserverNoise less = noise;
    for (ForceError& error : less.force)
      if (error.memory > kParted) error.deviation *= share;
    tried.emplace_back(observer_tables(setup, models, less, scale, recording.sample_time, steps),
                       models);
    if (!were_found) break;
  }
  return tried;
}

/// How well forces are known as a whole, where the plant's mass was found: half the 95 % interval
/// of the greatest such mass, over it. The accelerations being what they are, a plant that counts
/// as too heavy has all forces too large by as much.
double scale_known_within(const InPlantSetup& setup) {
  double greatest = 0, within = 0;
  for (const FoundNumber& one : setup.found) {
    const auto& rows = setup.model->parameters;
    if (rows[row_named(rows, one.name, setup.model->name, "plant")].unit != "kg") continue;
    const double value =
        std::ranges::find(setup.known, one.name, &NamedValues::value_type::first)->second;
    if (!(value > greatest)) continue;
    greatest = value;
    within = std::max(one.high - value, value - one.low) / value;
  }
  return within;
}

/// The estimates of a run as quantities with bands.
ObservedRecording quantities_of(const PlantObserver& observer, const InPlantSetup& setup,
                                const PlantRecording& recording, const ObservedSamples& samples,
                                const ObservedRun& run, double width, double scale_deviation) {
  const ObserverTables& t = observer.tables();
  const ObserverNames names = observer_names(setup);
  const std::size_t all = t.all(), count = samples.count, dampers = names.struts.size(),
                    coordinates = static_cast<std::size_t>(t.plant) / 2;
  ObservedRecording told{.name = recording.name, .sample_time = recording.sample_time};
  for (const std::string& strut : names.struts)
    told.quantities.push_back({force_name(strut, dampers), "N", {}, {}});
  for (const std::string& strut : names.struts) {
    told.quantities.push_back({strut + "_deflection", "m", {}, {}});
    told.quantities.push_back({strut + "_velocity", "m/s", {}, {}});
  }
  for (std::size_t k = 0; k < names.states.size(); ++k)
    told.quantities.push_back({names.states[k], names.state_units[k], {}, {}});

  for (std::size_t k = 0; k < count; ++k) {
    const auto [estimate, covariance] = run.at(k, t);
    const auto add = [&](std::size_t which, double value, double variance) {
      told.quantities[which].value.push_back(value);
      told.quantities[which].half.push_back(width * std::sqrt(std::max(variance, 0.0)));
    };
    for (std::size_t d = 0; d < dampers; ++d) {
      const PlantObserver::Damper damper = observer.damper_at(
          d, samples.driven_at(k > 0 ? k - 1 : 0), samples.driven_at(k), {estimate, covariance});
      const DamperQuantities places = damper_quantities(d, dampers);
      add(places.force, damper.force,
          damper.deviation * damper.deviation + std::pow(scale_deviation * damper.force, 2));

      // A damper's motion: a row over the plant's coordinates, or over their velocities.
      const double* way = &t.deflection[d * coordinates];
      for (const std::size_t first : {std::size_t{0}, coordinates}) {
        double variance = 0;
        for (std::size_t i = 0; i < coordinates; ++i)
          for (std::size_t j = 0; j < coordinates; ++j)
            variance += way[i] * way[j] * covariance[(first + i) * all + first + j];
        add(first == 0 ? places.deflection : places.velocity,
            first == 0 ? damper.deflection : damper.velocity, variance);
      }
    }
    for (std::size_t s = 0; s < names.states.size(); ++s)
      add(3 * dampers + s, estimate[s], covariance[s * all + s]);
  }
  return told;
}

/// How each sensor fits what the filter expected of it, all but its zero.
std::vector<ObservedSensor> one_ahead(const InPlantSetup& setup, const PlantRecording& recording,
                                      const ObservedRun& run, double width) {
  std::vector<ObservedSensor> sensors;
  const std::size_t settled = std::min<std::size_t>(50, run.samples.size() / 2);
  const Plant plant = make_plant(*setup.model, setup.known);
  for (std::size_t s = 0; s < setup.sensors.size(); ++s) {
    ObservedSensor figure{.channel = setup.sensors[s].channel,
                          .unit = unit_of(setup.sensors[s].place, plant),
                          .rms = rms_of(recording.channel(setup.sensors[s].channel).samples)};

    // What it showed beyond what was expected, once the filter has settled.
    double square = 0, inside = 0, count = 0;
    for (std::size_t k = settled; k < run.samples.size(); ++k) {
      const double beyond = run.samples[k].innovation[s], variance = run.samples[k].variance[s];
      if (!(variance > 0)) continue;
      square += beyond * beyond;
      inside += std::abs(beyond) <= width * std::sqrt(variance);
      count += 1;
    }
    figure.surprise = std::sqrt(square / count);
    figure.inside = inside / count;
    sensors.push_back(std::move(figure));
  }
  return sensors;
}

}  // namespace

ObservedSamples observed_samples(const InPlantSetup& setup, const PlantRecording& recording) {
  require_units(setup, recording);
  const std::vector<std::string> inputs = measured_inputs(setup);
  ObservedSamples samples{.count = recording.samples,
                          .inputs = inputs.size(),
                          .drives = setup.drives.size(),
                          .sensors = setup.sensors.size(),
                          .driven = {},
                          .measured = {}};
  if (samples.count < kFewestObserved)
    throw Error(recording.name, "has " + std::to_string(samples.count) + " samples",
                std::to_string(kFewestObserved) + " or more");
  std::vector<std::vector<double>> driven;
  for (const std::string& channel : inputs) driven.push_back(recording.channel(channel).samples);
  for (const DamperDrive& drive : setup.drives) driven.push_back(drive_samples(drive, recording));

  // A late sensor is brought forward, and from behind its filter.
  std::vector<std::vector<double>> measured;
  for (const PlantSensor& sensor : setup.sensors) {
    const std::vector<double>& shown = recording.channel(sensor.channel).samples;
    measured.push_back(in_front_of(sensor.filter, shown, recording.sample_time));
    if (sensor.delay != 0)
      measured.back() = delayed(measured.back(), recording.sample_time, -sensor.delay);
  }
  for (std::size_t k = 0; k < samples.count; ++k) {
    for (const std::vector<double>& channel : driven) samples.driven.push_back(channel[k]);
    for (const std::vector<double>& channel : measured) samples.measured.push_back(channel[k]);
  }
  return samples;
}

std::shared_ptr<const DamperModel> mounted(std::shared_ptr<const DamperModel> damper,
                                           double drive) {
  constexpr double kNothing = 1e-6;  // N
  const double rest = force_at_rest(*damper, drive);
  if (!(std::abs(rest) > kNothing)) return damper;
  return damper->with_offset(-rest);
}

void require_plant_drive(const InPlantSetup& setup, const ModelFile& file,
                         const std::string& model) {
  if (setup.drive_unit != DriveUnit::None && file.drive_unit != DriveUnit::None &&
      setup.drive_unit != file.drive_unit)
    throw Error(model,
                "takes " + to_string(file.drive_unit) + ", and the plant states " +
                    to_string(setup.drive_unit),
                "'voltage' or 'current' of the plant as the damper has it");
}

double resting_drive(const DamperDrive& drive, const Domain& domain) {
  return drive.channel.empty() ? drive.level : domain.current_min;
}

std::string force_name(const std::string& strut, std::size_t dampers) {
  return (dampers > 1 ? strut + "_" : "") + "damper_force";
}

ObserveReport observe(std::shared_ptr<const DamperModel> damper, const Domain& domain,
                      const InPlantSetup& setup, const std::vector<PlantRecording>& recordings,
                      const ObserveOptions& options) {
  require_setup(setup);
  return observe(ObservedDampers(setup.dampers(), {std::move(damper), domain}), setup, recordings,
                 options);
}

ObserveReport observe(ObservedDampers dampers, const InPlantSetup& setup,
                      const std::vector<PlantRecording>& recordings,
                      const ObserveOptions& options) {
  const double started = cpu_seconds();
  require_setup(setup);
  require_no_follower(setup, "the observer");
  require_steps(options.steps);
  if (recordings.empty()) throw Error("recordings", "there are none", "name at least one");
  ObserveReport report{.struts = observer_names(setup).struts};
  assert(dampers.size() == report.struts.size());
  DamperModels models;
  for (std::size_t d = 0; d < dampers.size(); ++d) {
    const std::vector<double> drive = drive_samples(setup.drive_of(d), recordings.front());
    dampers[d].model = mounted(std::move(dampers[d].model), drive.front());
    models.push_back(dampers[d].model);
  }

  // How large things are, and what is uncertain.
  ObserverScale scale = observer_scale(dampers);
  for (const PlantSensor& sensor : setup.sensors)
    scale.offset.push_back(sensor.zero > 0 ? sensor.zero
                           : sensor.noise > 0
                               ? sensor.noise
                               : kOffsetShare *
                                     rms_of(recordings.front().channel(sensor.channel).samples));
  require_signals(setup, recordings);
  std::vector<ObservedSamples> samples = samples_of(setup, recordings);
  const std::vector<PlantRecording> usual = usual_parts(setup, recordings);
  std::vector<ObservedSamples> of_usual = samples_of(setup, usual);
  const bool leaps = std::ranges::any_of(
      dampers, [&](const ObservedDamper& one) { return leaps_at_zero(one, scale); });
  const NoiseSearch search(setup, recordings, scale, leaps, options);

  // The filter's step, by the recording that asks for the finest; then what was not stated.
  report.steps = std::max(options.steps, 1);
  for (std::size_t r = 0; options.steps == 0 && r < usual.size(); ++r)
    report.steps =
        enough_steps(models, setup, search.first(), scale, usual[r], of_usual[r], report.steps);
  options.monitor.report("uncertainties", 0.1);
  if (!options.causal) {
    find_starts(models, setup, recordings, search.first(), scale, report.steps, samples);
    find_starts(models, setup, usual, search.first(), scale, report.steps, of_usual);
  }
  report.noise_was_found = search.size() > 0;
  report.noise = search.first();
  if (report.noise_was_found) {
    const Telling telling{models, setup, usual, of_usual, scale, report.steps};
    LikelyNoise found = most_likely(search, telling, options, 0.1);

    // Noise that is not known would pass for a shift; several dampers trade theirs.
    const bool is_stated = !options.force.empty() || options.shift.deviation > 0;
    const bool noise_is_known = std::ranges::all_of(
        setup.sensors, [](const PlantSensor& sensor) { return sensor.noise > 0; });
    if (models.size() == 1 && noise_is_known && !is_stated && !options.is_straight)
      found = with_shift(search, found, telling, options);
    report.noise = std::move(found.noise);
  }

  // Each recording in turn.
  report.forces_known_within = scale_known_within(setup);
  const double width = normal_quantile(0.5 + 0.5 * options.level);
  const std::vector<PlantObserver> observers =
      observers_of(models, setup, recordings, report.noise, scale, report.steps);
  if (!options.causal)
    find_starts(models, setup, recordings, report.noise, scale, report.steps, samples);
  const auto add_sensor_faults = [&](std::size_t r, const ObservedRun& run) {
    std::vector<std::string> faults = held_sensors(setup, recordings[r], run);
    if (faults.empty())
      faults.push_back(
          drifting_sensor(setup, recordings[r], samples[r],
                          with_less_slow_errors(models, setup, recordings[r], report.noise, scale,
                                                report.steps, options.force.empty()),
                          scale.offset, recordings.size(), options.threads));
    std::ranges::copy_if(faults, std::back_inserter(report.warnings),
                         [](const std::string& fault) { return !fault.empty(); });
  };
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    options.monitor.check();
    options.monitor.report(
        "observing " + recordings[r].name,
        0.7 + 0.3 * static_cast<double>(r) / static_cast<double>(recordings.size()));
    ObservedRun run = filtered(observers[r], samples[r]);
    if (!std::ranges::all_of(run.estimates, [](double x) { return std::isfinite(x); }))
      throw Error(recordings[r].name, "the filter diverges",
                  "more of its steps, or a damper and a plant that fit the recording");
    if (options.seeks_faults) add_sensor_faults(r, run);
    std::vector<ObservedSensor> sensors = one_ahead(setup, recordings[r], run, width);
    if (!options.causal) {
      smooth(observers[r], samples[r], run);
      smooth_again(observers[r], samples[r], run);
    }
    report.recordings.push_back(quantities_of(observers[r], setup, recordings[r], samples[r], run,
                                              width, report.forces_known_within / kNormal95));
    const ObserverTables& t = observers[r].tables();
    for (std::size_t s = 0; s < sensors.size(); ++s)
      sensors[s].offset = run.at(samples[r].count - 1, t).estimate[t.moving() + s];
    report.recordings.back().sensors = std::move(sensors);
  }

  // What speaks against the bands.
  constexpr double kFewInside = 0.8, kFarOff = 3;
  for (const ObservedRecording& told : report.recordings)
    for (const ObservedSensor& sensor : told.sensors)
      if (sensor.surprise > kFarOff * sensor.rms)
        report.warnings.push_back(
            told.name + ", " + sensor.channel + ": what was expected of it is " +
            format_number(sensor.surprise / sensor.rms, 2) +
            " times its rms away, so that nothing told of this recording can be used: are damper "
            "and plant those of it, and is each column the sensor that the plant says?");
      else if (sensor.inside < kFewInside * options.level)
        report.warnings.push_back(
            told.name + ", " + sensor.channel + ": only " + format_number(100 * sensor.inside, 2) +
            " % of what it shows lies within its " + format_number(100 * options.level, 2) +
            " % band: the bands are too narrow, or damper, plant and noise are not this plant's");
  std::ranges::move(far_zeros(setup, scale, leaps, report), std::back_inserter(report.warnings));
  std::ranges::move(beyond_models(dampers, setup, motions_of(samples, report)),
                    std::back_inserter(report.warnings));
  if (std::ranges::none_of(setup.sensors, [](const PlantSensor& one) { return one.noise > 0; }))
    report.warnings.push_back(
        "neither plant nor model says what any sensor's noise is: it was found beside the error of "
        "the law, each may pass for the other, and bands of the force may hold far less than they "
        "say; state it, as 'noise: 0.05' at a sensor, or take the files of an 'identify --in'");
  report.seconds = cpu_seconds() - started;
  return report;
}

PlantObserver make_observer(std::shared_ptr<const DamperModel> damper, const Domain& domain,
                            InPlantSetup setup, double sample_time, const ObserveOptions& options) {
  constexpr double kLate = 0.1;  // of a sample
  require_setup(setup);
  require_no_follower(setup, "the observer");
  require_alike(setup, "an observer that runs alone");
  require_steps(options.steps);
  setup.from_rest = true;
  damper = mounted(std::move(damper), resting_drive(setup.drives.front(), domain));
  const DamperModels models(setup.dampers(), damper);
  ObserverScale scale = observer_scale(ObservedDampers(models.size(), {damper, domain}));

  // All that is uncertain must be stated: nothing is searched for where it runs.
  ObserverNoise noise;
  if (options.force.empty())
    throw Error("--force-error", "is not stated", "what 'dashpot observe' prints of this plant");
  noise.force = options.force;
  noise.shift = options.shift;
  for (const PlantSensor& sensor : setup.sensors) {
    if (!(sensor.noise > 0))
      throw Error("plant, " + sensor.channel, "says nothing of its noise",
                  "noise: what 'dashpot observe' prints of this sensor, or a model whose "
                  "'identify --in' found it");
    const double late = sensor.delay + delay_of(sensor.filter);
    if (std::abs(late) > kLate * sample_time)
      throw Error("plant, " + sensor.channel,
                  "is " + format_number(1000 * late, 3) +
                      " ms late: a filter that runs with the plant cannot bring it forward",
                  "delay the other sensors as much before the filter, and leave 'delay' out");
    noise.sensors.push_back(sensor.noise);
    scale.offset.push_back(sensor.zero > 0 ? sensor.zero : sensor.noise);
  }
  if (const RoadPrior* road = unmeasured_road(setup)) {
    if (road->roughness == 0) throw Error("plant, road", "its class is unknown", "class: A to H");
    noise.roughness = road->roughness;
  }
  return {observer_tables(setup, models, noise, scale, sample_time, std::max(options.steps, 1)),
          models};
}

}  // namespace dashpot
