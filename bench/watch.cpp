// Prints the alarm rates of docs/watch.md: dampers that are watched over hundreds of days.
//
//   bench_watch days STORE HEALTHY FADED [CAR]  makes virtual days and estimates each (resumes)
//   bench_watch rates STORE [CAR]               what the charts say of them
//
// CAR: quarter (unless it is said), half: a half car with its roads measured and four sensors, of
// which two are the dampers' own, body: one with an accelerometer on its body alone.
//
// The truth is spencer1997, whose structure the model (tanh_kwok, identified on three rides of a
// quarter car with the road measured) does not have. From day to day the load, the road, the
// temperature and the drive differ, all at random.

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

constexpr double kMass = 387, kSpring = 37300, kGravity = 9.81;  // kg, N/m, m/s^2
constexpr double kHalfMass = 690;                                // kg
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

/// The half car on its days, both roads measured; its load is unknown.
std::string half_car_text(bool has_own_sensors) {
  return std::string(
             "plant: half_car\n"
             "parameters:\n"
             "  mass: {about: 700 kg, from: 500 kg, to: 1000 kg}\n"
             "  inertia: 1222 kg*m^2\n"
             "  front_wheel_mass: 40 kg\n"
             "  rear_wheel_mass: 45 kg\n"
             "  front_stiffness: 17 kN/m\n"
             "  rear_stiffness: 22 kN/m\n"
             "  front_tyre_stiffness: 200 kN/m\n"
             "  rear_tyre_stiffness: 200 kN/m\n"
             "  front_distance: 1.3 m\n"
             "  rear_distance: 1.5 m\n"
             "inputs:\n"
             "  - {channel: road_front, kind: ground, at: front, noise: 0.2 mm}\n"
             "  - {channel: road_rear, kind: ground, at: rear, noise: 0.2 mm}\n"
             "sensors:\n"
             "  - {channel: az_body, quantity: acceleration, at: body, noise: 0.05}\n") +
         (has_own_sensors
              ? "  - {channel: pitch, quantity: velocity, at: pitch, noise: 0.3 deg/s}\n"
                "  - {channel: level_front, quantity: deflection, at: front, noise: 0.2 mm}\n"
                "  - {channel: level_rear, quantity: deflection, at: rear, noise: 0.2 mm}\n"
              : "") +
         "voltage: coil\n";
}

/// The days of one kind: healthy, or with a fault.
struct DayKind {
  std::string name;
  double force = 0, rear_force = 0;  // shares by which the forces have become less
  bool has_gas = true;               // else its accumulator is empty
  std::string faded = {};            // of several dampers: the strut of the one that did
};

/// A car that is watched.
struct WatchedCar {
  std::string text;       // on its days
  double length;          // s, of a day
  std::size_t every = 1;  // sample of 500 Hz that is recorded
  bool is_half = false;
  WatchOptions options;
  std::vector<DayKind> kinds;
};

WatchedCar watched_car(const std::string& name) {
  WatchedCar car{
      .text = car_text(false),
      .length = 20,
      .options = {.level = "level", .known = {"temperature"}, .chart = {.reference = kReference}},
      .kinds = {{"healthy"},
                {"force -10 %", 0.1},
                {"force -20 %", 0.2},
                {"force -30 %", 0.3},
                {"gas lost", 0, 0, false}}};
  if (name == "quarter") return car;
  if (name != "half" && name != "body")
    throw Error("car", "'" + name + "' is none of them", "half");
  car.text = half_car_text(name == "half");
  car.length = 6;
  car.every = 2;
  car.is_half = true;
  car.options.level = "";
  car.kinds = {{"healthy"},
               {.name = "front -10 %", .force = 0.1, .faded = "front"},
               {.name = "front -20 %", .force = 0.2, .faded = "front"},
               {.name = "front -30 %", .force = 0.3, .faded = "front"},
               {.name = "rear -10 %", .rear_force = 0.1, .faded = "rear"},
               {.name = "rear -20 %", .rear_force = 0.2, .faded = "rear"},
               {.name = "rear -30 %", .rear_force = 0.3, .faded = "rear"}};
  return car;
}

/// What a day is like, which nobody knows but for the temperature.
struct DayTruth {
  double load = 0, roughness = 0, temperature = 20;  // kg, m^3, deg C
};

/// spencer1997, thinner where it is warm: its dashpots by 0.6 % per kelvin, its yield by 0.1 %.
std::shared_ptr<const DamperModel> true_damper(const DayTruth& day, double less = 0,
                                               bool has_gas = true) {
  const LawModel as_published = load_parameters("spencer1997");
  Dependence parameters = as_published.parameters();
  const double warmer = day.temperature - 20;
  const auto scale = [&](const char* name, double factor) {
    for (double& c : parameters.coefficients[as_published.law().index_of(name)]) c *= factor;
  };
  scale("c0", 1 - 0.006 * warmer);
  scale("c1", 1 - 0.006 * warmer);
  scale("alpha", 1 - 0.001 * warmer);
  if (!has_gas) scale("k1", 0);
  const auto damper = std::make_shared<LawModel>(
      as_published.law(), parameters, as_published.drive_unit(), as_published.lag_rate());
  return std::make_shared<WornDamper>(
      mounted(damper, 1), std::vector<WornDamper::Amount>{{&find_wear("force", "bench"), -less}});
}

PlantRecording as_recording(const VirtualRide& ride, const std::string& name) {
  return {.name = name,
          .sample_time = ride.recorded.sample_time,
          .samples = ride.recorded.size(),
          .channels = ride.recorded.channels};
}

DayTruth day_truth(std::uint64_t seed) {
  Random random(seed);
  DayTruth day;
  day.load = 25 * random.normal();
  day.roughness = road_roughness('B') * std::pow(2.0, random.uniform(-1, 3));
  day.temperature = 20 + 8 * random.normal();
  return day;
}

PlantRecording record_day(const WatchedCar& car, const DayTruth& truth, const DayKind& kind,
                          std::uint64_t seed, const std::string& name) {
  InPlantSetup setup = parse_in_plant_setup(car.text, "car");
  setup.unknown.clear();
  if (car.is_half)
    setup.known.emplace_back("mass", kHalfMass + 2 * truth.load);
  else
    setup.known.emplace_back("sprung_mass", kMass + truth.load);
  const VirtualCampaignOptions options{
      .duration = car.length,
      .levels = {0.5, 1, 1.5},
      .hold = 2,
      .road = "iso8608_fft,roughness=" + format_exact(truth.roughness) + ",speed=20m/s",
      .seed = seed};
  const auto front = true_damper(truth, kind.force, kind.has_gas),
             rear = true_damper(truth, kind.rear_force);
  std::vector<const DamperModel*> dampers = {front.get()};
  if (car.is_half) dampers.push_back(rear.get());
  PlantRecording recording = as_recording(virtual_campaign(setup, dampers, options).front(), name);

  for (Channel& channel : recording.channels) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < recording.samples; k += car.every)
      channel.samples[kept++] = channel.samples[k];
    channel.samples.resize(kept);
  }
  recording.samples = recording.channels.front().samples.size();
  recording.sample_time *= static_cast<double>(car.every);

  // The static level: of the load, and of the gas force where it is lost.
  const double gas = kind.has_gas ? 0 : force_at_rest(load_parameters("spencer1997"), 1);
  for (Channel& channel : recording.channels)
    if (channel.name == "level")
      for (double& value : channel.samples)
        value -= (truth.load * kGravity + std::abs(gas)) / kSpring;
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
       virtual_campaign(truth, *true_damper({}),
                        {.levels = {0, 1, 2}, .road = "iso8608,class=C,speed=20m/s", .seed = 77}))
    rides.push_back(as_recording(ride, ride.recorded.name));
  return identify_in_plant(find_law("tanh_kwok"), setup, rides, {});
}

std::uint64_t day_seed(std::size_t kind, std::size_t day) {
  return 1 + 1000003 * kind + 7919 * day;
}

PlantRecording make_day(const WatchedCar& car, std::size_t kind, std::size_t day) {
  const DayKind& of = car.kinds[kind];
  return record_day(car, day_truth(day_seed(kind, day) + 11), of, day_seed(kind, day),
                    fmt::format("{} {}", of.name, day));
}

std::string key_of(std::size_t kind, std::size_t day) {
  return fmt::format("day {} {:06}", kind, day);
}

/// The watched plant, made on the first three healthy days; model and plant are kept in the store.
WatchedPlant prepared(const WatchedCar& car, Store& store) {
  if (!store.load("model")) {
    const InPlantReport report = workshop();
    const InPlantSetup setup = parse_in_plant_setup(car_text(true), "car");
    store.save("model", format_model(found_damper(report.kinds.front(), report, setup, 0.002)));
  }
  ModelFile file = parse_model(*store.load("model"), "model");
  const InPlantSetup setup = parse_in_plant_setup(car.text, "car");
  const std::shared_ptr<const DamperModel> damper = std::move(file.model);
  const ObservedDampers dampers(setup.dampers(), {damper, file.domain});
  if (const auto found = store.load("found"))
    return watched_again(dampers, setup, parse_json(*found, "found"), car.options);
  std::vector<PlantRecording> first;
  for (std::size_t d = 0; d < 3; ++d) first.push_back(make_day(car, 0, d));
  const WatchedPlant watched = watched_plant(dampers, setup, first, car.options);
  store.save("found", format_json(found_of(watched)));
  return watched;
}

void run_days(const WatchedCar& car, const std::string& path,
              const std::vector<std::size_t>& counts) {
  Store store(path, kDaysFormat);
  const WatchedPlant watched = prepared(car, store);
  fmt::print(stderr, "{}\n", format_json(found_of(watched)));
  std::vector<std::pair<std::size_t, std::size_t>> todo;
  for (std::size_t kind = car.kinds.size(); kind-- > 0;)
    for (std::size_t day = 0; day < counts[kind == 0 ? 0 : 1]; ++day)
      if (!store.load(key_of(kind, day))) todo.emplace_back(kind, day);
  parallel_for(todo.size(), 0, [&](std::size_t k) {
    const auto [kind, day] = todo[k];
    const PlantRecording recording = make_day(car, kind, day);
    const double started = cpu_seconds();
    const WatchedDay watched_day = watch_day(watched, recording, car.options);
    store.save(key_of(kind, day), format_json(to_json(watched_day)));
    if (k % 20 == 0)
      fmt::print(stderr, "{}: {:.2f} s, {} iterations\n", recording.name, cpu_seconds() - started,
                 watched_day.estimate.iterations);
  });
}

/// The days of each kind that a store holds.
std::vector<std::vector<WatchedDay>> days_of(const WatchedCar& car, const Store& store) {
  std::vector<std::vector<WatchedDay>> days(car.kinds.size());
  for (std::size_t kind = 0; kind < days.size(); ++kind)
    for (std::size_t day = 0; const auto text = store.load(key_of(kind, day)); ++day)
      days[kind].push_back(watched_day_from_json(parse_json(*text, key_of(kind, day))));
  return days;
}

/// What the charts need to know of the plant.
WatchedPlant charted(const WatchedCar& car) {
  WatchedPlant watched{.setup = parse_in_plant_setup(car.text, "car"), .level = car.options.level};
  for (const std::string& name : car.options.wears)
    watched.wears.push_back(&find_wear(name, "bench"));
  return watched;
}

/// Charts of which each shares the stated rate, by thresholds that are made once.
class Charts {
 public:
  Charts(const WatchedCar& car, double stated) : options_(car.options), watched_(charted(car)) {
    const auto charts = static_cast<double>(watched_quantities(watched_).size());
    options_.chart.threshold = cusum_threshold(0.5 * options_.chart.shift, stated * charts);
  }
  std::vector<WatchedQuantity> of(const std::vector<WatchedDay>& days) const {
    return watch_charts(watched_, days, options_);
  }
  /// The first day of an alarm, and the quantity that it is of; nothing where there is none.
  std::optional<std::pair<std::size_t, std::string>> alarm(
      const std::vector<WatchedDay>& days) const {
    const std::vector<WatchedQuantity> quantities = of(days);
    const WatchedQuantity* first = first_alarm_of(quantities);
    if (!first) return std::nullopt;
    return std::pair(*first->chart.alarm, first->name);
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
void print_scatter(const WatchedCar& car, const std::vector<WatchedDay>& days) {
  const std::vector<WatchedQuantity> quantities = watch_charts(charted(car), days, car.options);
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
void print_false_alarms(const WatchedCar& car, const std::vector<WatchedDay>& healthy) {
  constexpr int kRuns = 1000;
  for (const double stated : {50.0, 100.0, 300.0, 1000.0}) {
    const Charts charts(car, stated);
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

/// What the days of each kind say of each quantity: means, and scatter from day to day.
void print_amounts(const WatchedCar& car, const std::vector<std::vector<WatchedDay>>& days) {
  const std::vector<WatchedQuantity> quantities = watched_quantities(charted(car));
  for (std::size_t kind = 0; kind < days.size(); ++kind) {
    fmt::print("{:<12}", car.kinds[kind].name);
    for (const WatchedQuantity& q : quantities) {
      double mean = 0, square = 0, count = 0;
      for (const WatchedDay& day : days[kind]) {
        if (!day.estimate.converged) continue;
        mean += day.estimate.wear[q.place];
        square += std::pow(day.estimate.wear[q.place], 2);
        ++count;
      }
      mean /= count;
      fmt::print(" {} {:.4f} +- {:.4f}", q.name, mean, std::sqrt(square / count - mean * mean));
    }
    fmt::print(" ({} days)\n", days[kind].size());
  }
}

/// Days until the alarm where the damper is healthy for 50 days and then has the fault; of several
/// dampers, whether it is the one whose alarm comes, and whether another's follows.
void print_delays(const WatchedCar& car, const std::vector<std::vector<WatchedDay>>& days,
                  std::size_t kind, double stated) {
  constexpr int kRuns = 500;
  constexpr std::size_t kHealthy = 50, kMost = 200, kFollows = 20;
  const Charts charts(car, stated);
  std::vector<double> delays(kRuns), falls(kRuns);
  std::vector<std::string> names(kRuns);
  std::vector<int> follows(kRuns);
  parallel_for(kRuns, 0, [&](std::size_t run) {
    Random random(run + 1);
    std::vector<WatchedDay> sequence = shuffled(days[0], random);
    sequence.resize(kHealthy);
    for (std::size_t d = 0; d < kMost; ++d)
      sequence.push_back(days[kind][random.index(days[kind].size())]);
    const std::vector<WatchedQuantity> quantities = charts.of(sequence);
    const WatchedQuantity* alarm = first_alarm_of(quantities);
    delays[run] = alarm ? static_cast<double>(*alarm->chart.alarm) - kHealthy + 1 : INFINITY;
    if (!alarm) return;
    names[run] = alarm->name;
    falls[run] = alarm->chart.fall;
    for (const WatchedQuantity& q : quantities)
      follows[run] |= q.strut != alarm->strut && q.chart.alarm &&
                      *q.chart.alarm <= *alarm->chart.alarm + kFollows;
  });
  std::map<std::string, int> by;
  std::vector<double> late;
  int early = 0, right = 0, followed = 0, found = 0;
  double fall = 0;
  for (std::size_t k = 0; k < delays.size(); ++k) {
    early += delays[k] <= 0;
    if (delays[k] <= 0) continue;
    late.push_back(delays[k]);
    if (names[k].empty()) continue;
    ++by[names[k]];
    ++found;
    right += names[k].starts_with(car.kinds[kind].faded);
    followed += follows[k];
    fall += falls[k];
  }
  std::ranges::sort(late);
  const auto quantile = [&](double p) {
    return late[static_cast<std::size_t>(p * static_cast<double>(late.size() - 1))];
  };
  fmt::print(
      "{:<12} one in {}: days until the alarm: median {}, 90 % within {}, latest {}; before "
      "the fault {} of {}",
      car.kinds[kind].name, stated, quantile(0.5), quantile(0.9), late.back(), early, kRuns);
  for (const auto& [name, times] : by) fmt::print(", {} {}", name, times);
  if (car.is_half)
    fmt::print("; right damper {} of {}, another's alarm within {} days {}, fall told {:.3f}",
               right, found, kFollows, followed, fall / found);
  fmt::print("\n");
}

void print_rates(const WatchedCar& car, const std::string& path) {
  const Store store(path, kDaysFormat);
  const std::vector<std::vector<WatchedDay>> days = days_of(car, store);
  if (car.is_half) print_amounts(car, days);
  if (days[0].size() <= 2 * kReference) throw Error(path, "holds too few healthy days");
  std::size_t converged = 0;
  for (const WatchedDay& day : days[0]) converged += day.estimate.converged;
  fmt::print("{} healthy days, {} converged\n", days[0].size(), converged);
  print_scatter(car, days[0]);
  print_false_alarms(car, days[0]);
  for (std::size_t kind = 1; kind < days.size(); ++kind)
    for (const double stated : {100.0, 1000.0})
      if (!days[kind].empty()) print_delays(car, days, kind, stated);
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  if ((words.size() == 4 || words.size() == 5) && words[0] == "days") {
    run_days(watched_car(words.size() == 5 ? words[4] : "quarter"), words[1],
             {std::stoul(words[2]), std::stoul(words[3])});
  } else if ((words.size() == 2 || words.size() == 3) && words[0] == "rates") {
    print_rates(watched_car(words.size() == 3 ? words[2] : "quarter"), words[1]);
  } else {
    fmt::print(stderr,
               "usage: bench_watch days STORE HEALTHY FADED [CAR], or bench_watch rates STORE "
               "[CAR]; CAR: quarter, half, body\n");
    return 2;
  }
  return 0;
}
