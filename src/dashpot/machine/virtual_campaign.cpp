#include "dashpot/machine/virtual_campaign.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "dashpot/base/random.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/ground_motion.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "dashpot/suspension/plants/linear.h"

namespace dashpot {
namespace {

constexpr std::size_t kFiner = 8, kStepsOfFiner = 5;  // per sample, and of the integrator in each

/// A sum of sines of random phases, alike in strength over a band of frequencies.
class RandomPush {
 public:
  RandomPush(double rms, double top, std::uint64_t seed) {
    constexpr int kSines = 120;
    constexpr double kLowest = 0.3;  // Hz
    Random random(seed);
    for (int k = 0; k < kSines; ++k) {
      rates_.push_back(kTurn * (kLowest + (top - kLowest) * (k + random.uniform()) / kSines));
      phases_.push_back(kTurn * random.uniform());
    }
    amplitude_ = rms * std::sqrt(2.0 / kSines);
  }
  double value(double t) const {
    double sum = 0;
    for (std::size_t k = 0; k < rates_.size(); ++k) sum += std::sin(rates_[k] * t + phases_[k]);
    return amplitude_ * sum;
  }
  double rate(double t) const {
    double sum = 0;
    for (std::size_t k = 0; k < rates_.size(); ++k)
      sum += rates_[k] * std::cos(rates_[k] * t + phases_[k]);
    return amplitude_ * sum;
  }

 private:
  std::vector<double> rates_, phases_;
  double amplitude_ = 0;
};

/// The inputs on the fine grid of the integrator.
PlantDriving driving_of(const InPlantSetup& setup, const Plant& plant,
                        const VirtualCampaignOptions& options, double push, std::uint64_t seed) {
  PlantDriving driving{.sample_time = 1 / options.sample_rate / kFiner, .steps = kStepsOfFiner};
  driving.samples =
      static_cast<std::size_t>(std::lround(options.duration * options.sample_rate)) * kFiner + 1;
  const double step = driving.sample_time / (2 * kStepsOfFiner);
  const std::vector<double> modes = natural_frequencies(linear_plant(plant));
  for (std::size_t u = 0; u < setup.inputs.size(); ++u) {
    std::vector<double> value(driving.points()), rate(driving.points());
    const bool is_road = setup.inputs[u].place.kind == PlantInput::Ground;
    GroundPointer ground;

    // All tyres go over one road, each where it is, or one behind the other by a time.
    const std::optional<std::size_t> under = setup.inputs[u].place.tyre;
    const bool follows = !setup.inputs[u].follows.empty();
    const std::optional<std::size_t> meets =
        follows ? setup.inputs[followed_by(setup, setup.inputs[u])].place.tyre : under;
    const std::size_t track = meets ? plant.tyres[*meets].track : 0;
    const double behind = meets ? plant.tyres[*meets].behind : 0;
    if (!options.road.empty() && setup.inputs[u].place.kind != PlantInput::Force)
      ground = make_ground(options.road, under ? seed : seed + u, "--road");
    if (ground && ground->shakes() == is_road)
      throw Error("--road",
                  "'" + options.road + "' is " + (is_road ? "an acceleration" : "a height") +
                      ", not what moves the " + plant.name,
                  is_road ? "a road, a bump" : "earthquake,file=...");
    if (is_road && !ground) throw Error("--road", "is not stated", "iso8608,class=C,speed=20m/s");

    const RandomPush random(push, std::min(options.sample_rate / 5, 3 * modes.back()), seed + u);
    for (std::size_t k = 0; k < value.size(); ++k) {
      const double t = step * static_cast<double>(k) - setup.inputs[u].later;
      if (is_road) {
        const FootMotion foot = ground->foot(t, track, behind);
        value[k] = foot.height;
        rate[k] = foot.velocity;
      } else {
        value[k] = ground ? ground->acceleration(t) : random.value(t);
        rate[k] = ground ? 0 : random.rate(t);
      }
    }
    driving.value.push_back(std::move(value));
    driving.rate.push_back(std::move(rate));
  }
  return driving;
}

/// The levels in one ride: each held for so long, none twice in a row; channel after channel by
/// its own chance.
std::vector<double> switched_levels(const VirtualCampaignOptions& options,
                                    const PlantDriving& driving, std::size_t channel) {
  Random random(options.seed + 250 + channel);
  const double step = driving.sample_time / (2 * kStepsOfFiner);
  const auto held = std::max<std::size_t>(1, static_cast<std::size_t>(options.hold / step));
  std::size_t level = channel % options.levels.size();
  std::vector<double> current(driving.points());
  for (std::size_t k = 0; k < current.size(); ++k) {
    if (k > 0 && k % held == 0 && options.levels.size() > 1)
      level = (level + 1 + random.index(options.levels.size() - 1)) % options.levels.size();
    current[k] = options.levels[level];
  }
  return current;
}

/// What drives each damper in a ride: a level of the campaign, but for dampers that have one of
/// their own. A channel is one level ahead of the one before it, so that the dampers differ.
std::vector<std::vector<double>> currents_of(const InPlantSetup& setup,
                                             const VirtualCampaignOptions& options,
                                             std::size_t ride, const PlantDriving& driving) {
  const std::vector<std::string> channels = setup.drive_channels();
  std::vector<std::vector<double>> currents;
  for (std::size_t d = 0; d < setup.dampers(); ++d) {
    const DamperDrive& drive = setup.drive_of(d);
    const auto channel =
        static_cast<std::size_t>(std::ranges::find(channels, drive.channel) - channels.begin());
    if (drive.channel.empty() && setup.drives.size() > 1)
      currents.emplace_back(driving.points(), drive.level);
    else if (options.hold > 0)
      currents.push_back(switched_levels(options, driving, channel));
    else
      currents.emplace_back(driving.points(),
                            options.levels[(ride + channel) % options.levels.size()]);
  }
  return currents;
}

/// A fine signal at each sample, `delay` seconds earlier; before the first one it stood still.
std::vector<double> sampled(const std::vector<double>& fine, std::size_t samples, double late) {
  std::vector<double> values(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    const double place = std::clamp(static_cast<double>(k * kFiner) - late, 0.0,
                                    static_cast<double>(fine.size() - 1));
    const std::size_t below = std::min(static_cast<std::size_t>(place), fine.size() - 2);
    values[k] =
        fine[below] + (place - static_cast<double>(below)) * (fine[below + 1] - fine[below]);
  }
  return values;
}

void add_channel(Record& record, const std::string& name, const std::string& unit,
                 std::vector<double> samples) {
  record.channels.push_back(
      {.name = name, .unit = unit, .samples = std::move(samples), .origin = "simulated"});
}

std::vector<double> with_noise(std::vector<double> samples, double noise, Random& random) {
  for (double& sample : samples) sample += noise * random.normal();
  return samples;
}

}  // namespace

const std::vector<SensorGrade>& sensor_grades() {
  static const std::vector<SensorGrade> kGrades = {
      {"exact", {0, 0, 0, 0, 0, 0}, {0, 0, 0}},
      {"laboratory", {2e-5, 5e-4, 0.01, 2e-5, 5e-4, 2}, {0.5, 2e-5, 0.005}},
      {"car", {5e-4, 5e-3, 0.05, 2e-4, 5e-3, 20}, {5, 2e-4, 0.05}}};
  return kGrades;
}

const SensorGrade& find_sensor_grade(const std::string& name, const std::string& where) {
  std::vector<std::string> known;
  for (const SensorGrade& grade : sensor_grades()) {
    if (grade.name == name) return grade;
    known.push_back(grade.name);
  }
  throw Error(where, "unknown grade '" + name + "'", suggest(name, known));
}

InPlantSetup with_grade(InPlantSetup setup, const SensorGrade& grade) {
  for (PlantSensor& sensor : setup.sensors)
    if (sensor.noise == 0)
      sensor.noise = grade.sensors[static_cast<std::size_t>(sensor.place.quantity)];
  for (PlantInputChannel& input : setup.inputs)
    if (input.noise == 0 && !input.road && input.follows.empty())
      input.noise = grade.inputs[static_cast<std::size_t>(input.place.kind)];
  return setup;
}

std::vector<VirtualRide> virtual_campaign(const InPlantSetup& setup, const DamperModel& damper,
                                          const VirtualCampaignOptions& options) {
  require_setup(setup);
  return virtual_campaign(setup, std::vector<const DamperModel*>(setup.dampers(), &damper),
                          options);
}

std::vector<VirtualRide> virtual_campaign(const InPlantSetup& setup,
                                          std::span<const DamperModel* const> dampers,
                                          const VirtualCampaignOptions& options) {
  require_setup(setup);
  assert(dampers.size() == setup.dampers());
  if (!setup.unknown.empty())
    throw Error("plant, " + setup.unknown.front().name, "is unknown", "its true value");
  for (const DamperModel* damper : dampers)
    if (!damper->flows())
      throw Error(damper->name(), "its states have no rates", "a published parameter set");
  constexpr double kMostSamples = 1e7;
  if (const double samples = options.duration * options.sample_rate; !(samples <= kMostSamples))
    throw Error("virtual rides", "a ride would have " + format_number(samples) + " samples",
                "at most " + format_number(kMostSamples) + ": a shorter one or a lower rate");
  if (options.hold > 0 && options.hold * options.sample_rate < 1)
    throw Error("--hold", format_number(options.hold) + " s is less than a sample",
                format_number(1 / options.sample_rate) + " s or more");
  const double held = options.hold * static_cast<double>(options.levels.size());
  if (options.levels.size() > 1 && held > options.duration)
    throw Error("--hold",
                std::to_string(options.levels.size()) + " levels of " +
                    format_number(options.hold) + " s each do not fit into a ride of " +
                    format_number(options.duration) + " s",
                "--duration " + format_number(held) + " or more");
  const Plant plant = make_plant(*setup.model, setup.known);
  std::vector<PlantInputPlace> inputs;
  for (const PlantInputChannel& input : setup.inputs) inputs.push_back(input.place);
  const DrivenPlant equations(plant, inputs);

  // The sensors, then what is true.
  std::vector<PlantSensorPlace> places;
  for (const PlantSensor& sensor : setup.sensors) places.push_back(sensor.place);
  std::vector<std::pair<std::string, PlantSensorPlace>> true_places;
  for (std::size_t d = 0; d < plant.struts.size(); ++d) {
    const std::string& strut = plant.struts[d].name;
    const std::string whose = plant.struts.size() > 1 ? strut + "_" : "";
    true_places.push_back({whose + "damper_force", {PlantQuantity::DamperForce, 0, d}});
    true_places.push_back({strut + "_deflection", {PlantQuantity::Deflection, 0, d}});
    true_places.push_back({strut + "_velocity", {PlantQuantity::DeflectionVelocity, 0, d}});
  }
  for (std::size_t q = 0; q < plant.size(); ++q) {
    true_places.push_back({plant.coordinates[q].name, {PlantQuantity::Displacement, q}});
    true_places.push_back({plant.coordinates[q].name + "_velocity", {PlantQuantity::Velocity, q}});
  }
  for (const auto& [name, place] : true_places) places.push_back(place);

  std::vector<VirtualRide> rides;
  for (std::size_t r = 0; r < (options.hold > 0 ? 1 : options.levels.size()); ++r) {
    options.monitor.check();
    const std::uint64_t seed = options.seed + 1000 * r;

    // What moves it.
    const bool is_pushed = setup.inputs.front().place.kind == PlantInput::Force;
    const double usual = is_pushed ? 0.3 * plant.mass.front() : 1;  // N by kg, m/s^2
    PlantDriving driving =
        driving_of(setup, plant, options, options.push > 0 ? options.push : usual, seed);
    driving.current = currents_of(setup, options, r, driving);

    // The run, from rest, in which the springs bear what each damper has at rest.
    std::vector<std::unique_ptr<DamperModel>> mounted;
    std::vector<const DamperModel*> models;
    for (std::size_t d = 0; d < dampers.size(); ++d) {
      const double rest = force_at_rest(*dampers[d], driving.current[d].front());
      mounted.push_back(dampers[d]->with_offset(-rest));
      models.push_back(mounted.back().get());
    }
    std::vector<double> state = equations.at_rest(models, driving);
    std::vector<std::vector<double>> shown;
    bool goes = equations.run(models, driving, driving.samples, places, state, shown);

    // Dampers too stiff for that step go by their own, at the same points.
    if (!goes) {
      driving.method = PlantMethod::StraightForce;
      driving.steps *= 2;
      state = equations.at_rest(models, driving);
      goes = equations.run(models, driving, driving.samples, places, state, shown);
    }
    if (!goes)
      throw Error(
          "the ride at " + format_number(options.levels[r]) + " " + to_string(setup.drive_unit),
          "diverges", "another damper, a lower level");

    // As the sensors have it.
    VirtualRide ride;
    const std::size_t samples = (driving.samples - 1) / kFiner;
    for (Record* record : {&ride.recorded, &ride.truth}) {
      record->name = "ride_" + std::to_string(r + 1);
      record->sample_time = 1 / options.sample_rate;
      for (std::size_t k = 0; k < samples; ++k)
        record->time.push_back(static_cast<double>(k) / options.sample_rate);
    }
    Random noise(seed + 500);
    for (std::size_t u = 0; u < setup.inputs.size(); ++u) {
      std::vector<double> fine(driving.samples);
      for (std::size_t k = 0; k < fine.size(); ++k)
        fine[k] = driving.value[u][2 * kStepsOfFiner * k];
      const std::vector<double> values = sampled(fine, samples, 0);
      const PlantInputChannel& input = setup.inputs[u];
      const std::string unit = unit_of(input.place.kind);
      if (input.place.kind == PlantInput::Ground)
        add_channel(ride.truth,
                    input.place.tyre ? plant.tyres[*input.place.tyre].name + "_road" : "road", unit,
                    values);
      if (!input.road && input.follows.empty())
        add_channel(ride.recorded, input.channel, unit, with_noise(values, input.noise, noise));
    }
    for (std::size_t s = 0; s < setup.sensors.size(); ++s) {
      const PlantSensor& sensor = setup.sensors[s];
      const double zero = (sensor.zero > 0 ? sensor.zero : sensor.noise) * noise.normal();
      std::vector<double> values = sampled(behind(sensor.filter, shown[s], driving.sample_time),
                                           samples, sensor.delay / driving.sample_time);
      for (double& value : values) value += zero;
      add_channel(ride.recorded, sensor.channel, unit_of(sensor.place, plant),
                  with_noise(std::move(values), sensor.noise, noise));
    }
    for (const std::string& channel : setup.drive_channels()) {
      std::size_t driven = 0;
      while (setup.drive_of(driven).channel != channel) ++driven;
      std::vector<double> drive(samples);
      for (std::size_t k = 0; k < samples; ++k)
        drive[k] = driving.current[driven][2 * kStepsOfFiner * kFiner * k];
      add_channel(ride.recorded, channel, to_string(setup.drive_unit), std::move(drive));
    }
    for (std::size_t k = 0; k < true_places.size(); ++k)
      add_channel(ride.truth, true_places[k].first, unit_of(true_places[k].second, plant),
                  sampled(shown[setup.sensors.size() + k], samples, 0));
    rides.push_back(std::move(ride));
  }
  return rides;
}

}  // namespace dashpot
