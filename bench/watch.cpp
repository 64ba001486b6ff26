// Prints the alarm rates of docs/in-plant.md: a damper that is watched over a thousand days.
//
//   bench_watch days STORE HEALTHY FADED    makes virtual days and estimates each (resumes)
//   bench_watch rates STORE                 what the charts say of them
//
// The truth is the shipped quarter car with spencer1997, whose structure the model (tanh_kwok,
// identified on three rides with the road measured) does not have. From day to day the load, the
// road, the temperature and the drive differ, all at random.

#include "dashpot/machine/watch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include <fmt/format.h>

#include "dashpot/base/parallel.h"
#include "dashpot/base/random.h"
#include "dashpot/base/store.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant.h"
#include "dashpot/machine/in_plant_result.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "dashpot/suspension/ground/road_profile.h"

using namespace dashpot;

namespace {

constexpr double kMass = 387, kSpring = 37300, kGravity = 9.81,
                 kDayLength = 20;  // kg, N/m, m/s^2, s
constexpr std::size_t kReference = 20;
constexpr StoreFormat kDaysFormat{"bench_watch", 1, "give it another name"};

/// The car as its file says it: in the workshop with its road measured, and on its days.
std::string car_text(bool in_workshop) {
  return std::string(
             "plant: quarter_car\n"
             "parameters:\n"
             "  unsprung_mass: 139.5 kg\n"
             "  spring_stiffness: 37300 N/m\n"
             "  sprung_mass: {about: 380 kg, from: 200 kg, to: 700 kg}\n") +
         (in_workshop ? "  tyre_stiffness: {about: 250 kN/m, from: 100 kN/m, to: 500 kN/m}\n"
                        "inputs: [{channel: road, kind: ground, noise: 0.2 mm}]\n"
                      : "  tyre_stiffness: 295200 N/m\n"
                        "inputs: [{kind: ground, class: unknown, speed: 20 m/s}]\n") +
         "sensors:\n"
         "  - {channel: az_body, quantity: acceleration, at: body, noise: 0.05}\n"
         "  - {channel: az_wheel, quantity: acceleration, at: wheel, noise: 0.5}\n"
         "  - {channel: level, quantity: deflection, noise: 0.2 mm}\n"
         "voltage: coil\n";
}

/// What a day is like, which nobody knows but for the temperature.
struct DayTruth {
  double mass = kMass, roughness = 0, temperature = 20;  // kg, m^3, deg C
  double force = 0;     // share by which the damper's force has become less
  bool has_gas = true;  // else its accumulator is empty
};

/// spencer1997, thinner where it is warm: its dashpots by 0.6 % per kelvin, its yield by 0.1 %.
std::shared_ptr<const DamperModel> true_damper(const DayTruth& day) {
  const LawModel as_published = load_parameters("spencer1997");
  Dependence parameters = as_published.parameters();
  const double warmer = day.temperature - 20;
  const auto scale = [&](const char* name, double factor) {
    for (double& c : parameters.coefficients[as_published.law().index_of(name)]) c *= factor;
  };
  scale("c0", 1 - 0.006 * warmer);
  scale("c1", 1 - 0.006 * warmer);
  scale("alpha", 1 - 0.001 * warmer);
  if (!day.has_gas) scale("k1", 0);
  const auto damper = std::make_shared<LawModel>(
      as_published.law(), parameters, as_published.drive_unit(), as_published.lag_rate());
  return std::make_shared<WornDamper>(
      mounted(damper, 1),
      std::vector<WornDamper::Amount>{{&find_wear("force", "bench"), -day.force}});
}

PlantRecording as_recording(const VirtualRide& ride, const std::string& name) {
  return {.name = name,
          .sample_time = ride.recorded.sample_time,
          .samples = ride.recorded.size(),
          .channels = ride.recorded.channels};
}

DayTruth day_truth(std::uint64_t seed, double force, bool has_gas) {
  Random random(seed);
  DayTruth day{.force = force, .has_gas = has_gas};
  day.mass = kMass + 25 * random.normal();
  day.roughness = road_roughness('B') * std::pow(2.0, random.uniform(-1, 3));
  day.temperature = 20 + 8 * random.normal();
  return day;
}

PlantRecording record_day(const DayTruth& truth, std::uint64_t seed, const std::string& name) {
  InPlantSetup setup = parse_in_plant_setup(car_text(false), "car");
  setup.unknown.clear();
  setup.known.emplace_back("sprung_mass", truth.mass);
  const VirtualCampaignOptions options{
      .duration = kDayLength,
      .levels = {0.5, 1, 1.5},
      .hold = 2,
      .road = "iso8608_fft,roughness=" + format_exact(truth.roughness) + ",speed=20m/s",
      .seed = seed};
  const std::shared_ptr<const DamperModel> damper = true_damper(truth);
  PlantRecording recording = as_recording(virtual_campaign(setup, *damper, options).front(), name);

  // The static level: of the load, and of the gas force where it is lost.
  const double gas = truth.has_gas ? 0 : force_at_rest(load_parameters("spencer1997"), 1);
  for (Channel& channel : recording.channels)
    if (channel.name == "level")
      for (double& value : channel.samples)
        value -= ((truth.mass - kMass) * kGravity + std::abs(gas)) / kSpring;
  Random random(seed + 700);
  const double shown = truth.temperature + random.normal();
  recording.channels.push_back({.name = "temperature",
                                .unit = "SI",
                                .samples = std::vector<double>(recording.samples, shown),
                                .origin = {}});
  return recording;
}

/// The model: identified in the car on three rides with the road measured.
InPlantReport workshop() {
  InPlantSetup setup = parse_in_plant_setup(car_text(true), "car");
  InPlantSetup truth = setup;
  truth.unknown.clear();
  truth.known.emplace_back("sprung_mass", kMass);
  truth.known.emplace_back("tyre_stiffness", 295200);
  std::vector<PlantRecording> rides;
  for (const VirtualRide& ride :
       virtual_campaign(truth, *true_damper({.roughness = 0}),
                        {.levels = {0, 1, 2}, .road = "iso8608,class=C,speed=20m/s", .seed = 77}))
    rides.push_back(as_recording(ride, ride.recorded.name));
  return identify_in_plant(find_law("tanh_kwok"), setup, rides, {});
}

WatchOptions watch_options() {
  return {.wears = {"force"},
          .level = "level",
          .known = {"temperature"},
          .chart = {.reference = kReference}};
}

/// The days of one kind: healthy, or with a fault.
struct DayKind {
  std::string name;
  double force = 0;
  bool has_gas = true;
};
const std::vector<DayKind>& day_kinds() {
  static const std::vector<DayKind> kKinds = {{"healthy"},
                                              {"force -10 %", 0.1},
                                              {"force -20 %", 0.2},
                                              {"force -30 %", 0.3},
                                              {"gas lost", 0, false}};
  return kKinds;
}

std::uint64_t day_seed(std::size_t kind, std::size_t day) {
  return 1 + 1000003 * kind + 7919 * day;
}

PlantRecording make_day(std::size_t kind, std::size_t day) {
  const DayKind& of = day_kinds()[kind];
  return record_day(day_truth(day_seed(kind, day) + 11, of.force, of.has_gas), day_seed(kind, day),
                    fmt::format("{} {}", of.name, day));
}

std::string key_of(std::size_t kind, std::size_t day) {
  return fmt::format("day {} {:06}", kind, day);
}

/// The watched plant, made on the first three healthy days; model and plant are kept in the store.
WatchedPlant prepared(Store& store) {
  if (!store.load("model")) {
    const InPlantReport report = workshop();
    const InPlantSetup setup = parse_in_plant_setup(car_text(true), "car");
    store.save("model", format_model(found_damper(report, setup, 0.002)));
  }
  ModelFile file = parse_model(*store.load("model"), "model");
  const std::shared_ptr<const DamperModel> damper = std::move(file.model);
  const WatchOptions options = watch_options();
  const InPlantSetup setup = parse_in_plant_setup(car_text(false), "car");
  if (const auto found = store.load("found"))
    return watched_again(damper, file.domain, setup, parse_json(*found, "found"), options);
  std::vector<PlantRecording> first;
  for (std::size_t d = 0; d < 3; ++d) first.push_back(make_day(0, d));
  const WatchedPlant watched = watched_plant(damper, file.domain, setup, first, options);
  store.save("found", format_json(found_of(watched)));
  return watched;
}

void run_days(const std::string& path, const std::vector<std::size_t>& counts) {
  Store store(path, kDaysFormat);
  const WatchedPlant watched = prepared(store);
  fmt::print(stderr, "{}\n", format_json(found_of(watched)));
  std::vector<std::pair<std::size_t, std::size_t>> todo;
  for (std::size_t kind = day_kinds().size(); kind-- > 0;)
    for (std::size_t day = 0; day < counts[kind == 0 ? 0 : 1]; ++day)
      if (!store.load(key_of(kind, day))) todo.emplace_back(kind, day);
  parallel_for(todo.size(), 0, [&](std::size_t k) {
    const auto [kind, day] = todo[k];
    const PlantRecording recording = make_day(kind, day);
    const double started = cpu_seconds();
    const WatchedDay watched_day = watch_day(watched, recording, watch_options());
    store.save(key_of(kind, day), format_json(to_json(watched_day)));
    if (k % 20 == 0)
      fmt::print(stderr, "{}: {:.2f} s, {} iterations\n", recording.name, cpu_seconds() - started,
                 watched_day.estimate.iterations);
  });
}

/// The days of each kind that a store holds.
std::vector<std::vector<WatchedDay>> days_of(const Store& store) {
  std::vector<std::vector<WatchedDay>> days(day_kinds().size());
  for (std::size_t kind = 0; kind < days.size(); ++kind)
    for (std::size_t day = 0; const auto text = store.load(key_of(kind, day)); ++day)
      days[kind].push_back(watched_day_from_json(parse_json(*text, key_of(kind, day))));
  return days;
}

/// What the charts need to know of the plant.
WatchedPlant charted() {
  const WatchOptions options = watch_options();
  WatchedPlant watched{.setup = parse_in_plant_setup(car_text(false), "car"),
                       .level = options.level};
  for (const std::string& name : options.wears) watched.wears.push_back(&find_wear(name, "bench"));
  return watched;
}

/// Charts of which each shares the stated rate, by thresholds that are made once.
class Charts {
 public:
  explicit Charts(double stated) : options_(watch_options()), watched_(charted()) {
    const auto charts = static_cast<double>(watched_.wears.size() + 1);
    options_.chart.threshold = cusum_threshold(0.5 * options_.chart.shift, stated * charts);
  }
  /// The first day of an alarm, and the quantity that it is of; nothing where there is none.
  std::optional<std::pair<std::size_t, std::string>> alarm(
      const std::vector<WatchedDay>& days) const {
    std::optional<std::pair<std::size_t, std::string>> first;
    for (const WatchedQuantity& q : watch_charts(watched_, days, options_))
      if (q.chart.alarm && (!first || *q.chart.alarm < first->first))
        first = {*q.chart.alarm, q.name};
    return first;
  }

 private:
  WatchOptions options_;
  WatchedPlant watched_;
};

std::vector<WatchedDay> shuffled(std::vector<WatchedDay> days, Random& random) {
  for (std::size_t k = days.size(); k-- > 1;) std::swap(days[k], days[random.index(k + 1)]);
  return days;
}

/// How much each number scatters from one healthy day to another, beside what a day says itself.
void print_scatter(const std::vector<WatchedDay>& days) {
  const std::vector<WatchedQuantity> quantities = watch_charts(charted(), days, watch_options());
  for (const WatchedQuantity& q : quantities) {
    double mean = 0, square = 0, own = 0;
    const auto count = static_cast<double>(days.size());
    for (const WatchedDay& day : days) mean += day.estimate.wear[q.place] / count;
    for (const WatchedDay& day : days) {
      square += std::pow(day.estimate.wear[q.place] - mean, 2) / (count - 1);
      own += std::pow(day.estimate.wear_deviation[q.place], 2) / count;
    }
    fmt::print(
        "{:<10} mean {:.4g}, from day to day {:.3g}, of a day by itself {:.3g}, where the day "
        "is known {:.3g} {}\n",
        q.name, mean, std::sqrt(square), std::sqrt(own), q.chart.points.back().scatter, q.unit);
  }
}

/// Alarms of healthy days in random orders, each run to its first alarm or to its end.
void print_false_alarms(const std::vector<WatchedDay>& healthy) {
  constexpr int kRuns = 1000;
  for (const double stated : {50.0, 100.0, 300.0, 1000.0}) {
    const Charts charts(stated);
    std::vector<std::optional<std::pair<std::size_t, std::string>>> first(kRuns);
    parallel_for(kRuns, 0, [&](std::size_t run) {
      Random random(run + 1);
      first[run] = charts.alarm(shuffled(healthy, random));
    });
    double alarms = 0, watched = 0;
    std::map<std::string, int> by;
    for (const auto& one : first) {
      alarms += one.has_value();
      watched += static_cast<double>((one ? one->first + 1 : healthy.size()) - kReference);
      if (one) ++by[one->second];
    }
    fmt::print("stated: one false alarm in {} days; found: one in {:.0f} ({} alarms in {} runs)",
               stated, watched / alarms, alarms, kRuns);
    for (const auto& [name, times] : by) fmt::print(", {} {}", name, times);
    fmt::print("\n");
  }
}

/// Days until the alarm where the damper is healthy for 50 days and then has the fault.
void print_delays(const std::vector<std::vector<WatchedDay>>& days, std::size_t kind,
                  double stated) {
  constexpr int kRuns = 500;
  constexpr std::size_t kHealthy = 50, kMost = 200;
  const Charts charts(stated);
  std::vector<double> delays(kRuns);
  std::vector<std::string> names(kRuns);
  parallel_for(kRuns, 0, [&](std::size_t run) {
    Random random(run + 1);
    std::vector<WatchedDay> sequence = shuffled(days[0], random);
    sequence.resize(kHealthy);
    for (std::size_t d = 0; d < kMost; ++d)
      sequence.push_back(days[kind][random.index(days[kind].size())]);
    const auto alarm = charts.alarm(sequence);
    delays[run] = alarm ? static_cast<double>(alarm->first) - kHealthy + 1 : INFINITY;
    if (alarm) names[run] = alarm->second;
  });
  std::map<std::string, int> by;
  std::vector<double> late;
  int early = 0;
  for (std::size_t k = 0; k < delays.size(); ++k) {
    early += delays[k] <= 0;
    if (delays[k] <= 0) continue;
    late.push_back(delays[k]);
    if (!names[k].empty()) ++by[names[k]];
  }
  std::ranges::sort(late);
  const auto quantile = [&](double p) {
    return late[static_cast<std::size_t>(p * static_cast<double>(late.size() - 1))];
  };
  fmt::print(
      "{:<12} one in {}: days until the alarm: median {}, 90 % within {}, latest {}; before "
      "the fault {} of {}",
      day_kinds()[kind].name, stated, quantile(0.5), quantile(0.9), late.back(), early, kRuns);
  for (const auto& [name, times] : by) fmt::print(", {} {}", name, times);
  fmt::print("\n");
}

void print_rates(const std::string& path) {
  const Store store(path, kDaysFormat);
  const std::vector<std::vector<WatchedDay>> days = days_of(store);
  if (days[0].size() <= 2 * kReference) throw Error(path, "holds too few healthy days");
  std::size_t converged = 0;
  for (const WatchedDay& day : days[0]) converged += day.estimate.converged;
  fmt::print("{} healthy days, {} converged\n", days[0].size(), converged);
  print_scatter(days[0]);
  print_false_alarms(days[0]);
  for (std::size_t kind = 1; kind < days.size(); ++kind)
    for (const double stated : {100.0, 1000.0})
      if (!days[kind].empty()) print_delays(days, kind, stated);
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  if (words.size() == 4 && words[0] == "days") {
    run_days(words[1], {std::stoul(words[2]), std::stoul(words[3])});
  } else if (words.size() == 2 && words[0] == "rates") {
    print_rates(words[1]);
  } else {
    fmt::print(stderr, "usage: bench_watch days STORE HEALTHY FADED, or bench_watch rates STORE\n");
    return 2;
  }
  return 0;
}
