#include "dashpot/machine/watch.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/day_order.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/numerics/distributions.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Days of a number that scatters by `scatter` about 5 + 2 * known, and falls from day `from` on.
std::vector<ChartDay> chart_days(std::size_t count, std::uint64_t seed, std::size_t from,
                                 double fall) {
  Random random(seed);
  std::vector<ChartDay> days;
  for (std::size_t d = 0; d < count; ++d) {
    const double known = random.normal();
    days.push_back({5 + 2 * known + 0.1 * random.normal() - (d >= from ? fall : 0), {known}});
  }
  return days;
}

const std::string kWatchedOscillator =
    "plant: oscillator\n"
    "parameters: {mass: {about: 10 kg, from: 5 kg, to: 20 kg}, damping: 0, stiffness: 4000 N/m}\n"
    "inputs: [{channel: push, kind: force, at: mass}]\n"
    "sensors:\n"
    "  - {channel: x, quantity: displacement, at: mass, noise: 0.1 mm}\n"
    "  - {channel: a, quantity: acceleration, at: mass, noise: 0.02}\n";

std::shared_ptr<const DamperModel> tanh_damper() {
  const Law& law = find_law("tanh_kwok");
  std::vector<double> p(law.params.size());
  for (const auto& [name, value] :
       {std::pair{"c", 40.0}, {"k", 200.0}, {"alpha", 8.0}, {"beta", 20.0}, {"delta", 0.02}})
    p[law.index_of(name)] = value;
  return std::make_shared<LawModel>(LawModel::constant(law, p));
}

const Domain kOscillatorDomain = {-0.05, 0.05, -0.5, 0.5, 0, 0};

/// A day of the oscillator with so much mass and wear.
PlantRecording oscillator_day(double mass, double force, std::uint64_t seed) {
  InPlantSetup setup = parse_in_plant_setup(kWatchedOscillator, "oscillator.yaml");
  setup.unknown.clear();
  setup.known.emplace_back("mass", mass);
  const WornDamper damper(tanh_damper(), {{&find_wear("force", "test"), force}});
  const VirtualRide ride =
      virtual_campaign(setup, damper,
                       {.duration = 4, .sample_rate = 200, .levels = {0}, .push = 20, .seed = seed})
          .front();
  return {.name = "day",
          .sample_time = ride.recorded.sample_time,
          .samples = ride.recorded.size(),
          .channels = ride.recorded.channels};
}

WatchedPlant watched_oscillator(const std::vector<std::string>& wears) {
  WatchedPlant watched{.dampers = {{tanh_damper(), kOscillatorDomain}},
                       .setup = parse_in_plant_setup(kWatchedOscillator, "oscillator.yaml")};
  for (const std::string& name : wears) watched.wears.push_back(&find_wear(name, "test"));
  watched.noise = {.force = {{0.5, 0.02}}, .sensors = {1e-4, 0.02}};
  return watched;
}

/// Two masses one upon the other, each on a damper; `places`: where these stand.
InPlantSetup two_dampers(const std::string& places, const std::string& sensors) {
  return parse_in_plant_setup(
      "plant: matrices\ncoordinates: [floor, table]\nmass: [[20 kg, 0], [0, 10 kg]]\n"
      "stiffness: [[12 kN/m, -4 kN/m], [-4 kN/m, 4 kN/m]]\ndampers: " +
          places + "\ninputs: [{channel: push, kind: force, at: floor}]\nsensors:\n" + sensors,
      "rig.yaml");
}
const std::string kLowAndHigh =
    "[{name: low, from: ground, to: floor}, {name: high, from: floor, to: table}]";
const std::string kBothMasses =
    "  - {channel: floor, quantity: acceleration, at: floor, noise: 0.02}\n"
    "  - {channel: table, quantity: acceleration, at: table, noise: 0.02}\n";

/// A day of such a rig on which its dampers have become so much weaker.
PlantRecording rig_day(const InPlantSetup& setup, double low, double high, std::uint64_t seed) {
  const Wear& force = find_wear("force", "test");
  const WornDamper first(tanh_damper(), {{&force, -low}}), second(tanh_damper(), {{&force, -high}});
  const VirtualRide ride =
      virtual_campaign(setup, std::vector<const DamperModel*>{&first, &second},
                       {.duration = 4, .sample_rate = 200, .levels = {0}, .push = 60, .seed = seed})
          .front();
  return {.name = "day " + std::to_string(seed),
          .sample_time = ride.recorded.sample_time,
          .samples = ride.recorded.size(),
          .channels = ride.recorded.channels};
}

WatchedPlant watched_rig(const InPlantSetup& setup) {
  return {.dampers = ObservedDampers(2, {tanh_damper(), kOscillatorDomain}),
          .setup = setup,
          .wears = {&find_wear("force", "test")},
          .noise = {.force = {{0.5, 0.02}}, .sensors = {0.02, 0.02}}};
}

/// What is told of days with these shares of force, of which six are for reference.
/// On the last one, what pushes the mass seems to be so many times what was recorded.
std::vector<std::string> odd_days_among(const std::vector<double>& wears, double last_gain = 1) {
  const WatchedPlant watched = watched_oscillator({"force"});
  std::vector<WatchedDay> days;
  for (const double wear : wears)
    days.push_back({.estimate = {.name = "day " + std::to_string(days.size()),
                                 .wear = {wear},
                                 .wear_deviation = {0.01},
                                 .plant = {10},
                                 .plant_deviation = {0.1},
                                 .excitation = 1 + 0.1 * double(days.size() % 3),
                                 .input_gains = {{"push", 1 + 0.01 * double(days.size() % 3)}},
                                 .converged = true},
                    .known = {}});
  days.back().estimate.input_gains[0].second = last_gain;
  const WatchOptions options{.wears = {"force"}, .chart = {.reference = 6, .days = 100}};
  return odd_days(watch_charts(watched, days, options), days);
}

}  // namespace

TEST_CASE("normal_score: of Student's t, and the normal distribution where days are many") {
  CHECK_CLOSE(normal_score(1e7, 1.7), 1.7, 1e-5, 0);
  CHECK_CLOSE(normal_score(5, students_t_quantile(5, 0.99)), normal_quantile(0.99), 1e-9, 0);
  CHECK(normal_score(3, -4) == -normal_score(3, 4));
  CHECK(std::isfinite(normal_score(3, -1e200)));
}

TEST_CASE("cusum_run_length: as published, and as counted") {
  // D. M. Hawkins, D. H. Olwell, Cumulative Sum Charts, 1998: k = 0.5, h = 4 and 5, one side, where
  // scores are not held; holding them within 3 moves it by little.
  CHECK_CLOSE(cusum_run_length(0.5, 4), 335.4, 0.04, 0);
  CHECK_CLOSE(cusum_run_length(0.5, 5), 930.9, 0.06, 0);
  CHECK_CLOSE(cusum_run_length(0.5, cusum_threshold(0.5, 100)), 100, 1e-6, 0);

  Random random(5);
  const double threshold = cusum_threshold(0.5, 50);
  double days = 0, sum = 0;
  int alarms = 0;
  while (alarms < 4000) {
    ++days;
    sum = std::max(0.0, sum - std::clamp(random.normal(), -kMostScore, kMostScore) - 0.5);
    if (sum <= threshold) continue;
    ++alarms;
    sum = 0;
  }
  CHECK_CLOSE(days / alarms, 50, 0.06, 0);
}

TEST_CASE("health_chart: the stated rate although mean, scatter and slope are learnt" *
          doctest::test_suite("long")) {
  // Eight reference days for three numbers: a chart of known scatter would alarm far too often.
  constexpr int kRuns = 3000;
  const ChartOptions options{.reference = 8, .days = 60, .threshold = cusum_threshold(0.5, 60)};
  double days = 0;
  int alarms = 0;
  for (int run = 0; run < kRuns; ++run) {
    const std::vector<ChartDay> healthy = chart_days(108, 100 + run, 1000, 0);
    const Chart chart = health_chart(healthy, options);
    alarms += chart.alarm.has_value();
    days += static_cast<double>(chart.alarm ? *chart.alarm - 7 : 100);
  }
  CHECK_CLOSE(days / alarms, 60, 0.1, 0);
}

TEST_CASE("health_chart: a fall is found, dated and measured, and teaches nothing") {
  const std::vector<ChartDay> days = chart_days(90, 3, 60, 0.2);
  const Chart chart = health_chart(days, {.reference = 20, .days = 1000});
  REQUIRE(chart.alarm);
  CHECK(*chart.alarm >= 60);
  CHECK(*chart.alarm < 75);
  CHECK(chart.since >= 55);
  CHECK(chart.since <= 62);
  CHECK_CLOSE(chart.fall, 0.2, 0, 0.08);
  CHECK(chart.fall_deviation < 0.1);
  CHECK_CLOSE(chart.points.back().scatter, 0.1, 0.4, 0);

  // Taught by what is known of a day: without that, the same fall drowns.
  std::vector<ChartDay> blind = days;
  for (ChartDay& day : blind) day.known.clear();
  CHECK(health_chart(blind, {.reference = 20, .days = 1000}).points.back().scatter > 1.5);
}

TEST_CASE("health_chart: what is the same on every day explains nothing, and hides no fall") {
  std::vector<ChartDay> days = chart_days(90, 3, 60, 0.2);
  const Chart chart = health_chart(days, {.reference = 20, .days = 1000});
  for (ChartDay& day : days) day.known.push_back(-8.27);
  const Chart same = health_chart(days, {.reference = 20, .days = 1000});
  REQUIRE(same.alarm);
  CHECK(*same.alarm == *chart.alarm);
  CHECK_CLOSE(same.points[59].score, chart.points[59].score, 1e-9, 1e-9);

  // Of a day on which it differs for the first time nothing is known, and the next are judged.
  days[40].known.back() = -7;
  const Chart once = health_chart(days, {.reference = 20, .days = 1000});
  CHECK_FALSE(once.points[40].is_judged);
  CHECK(once.points[41].is_judged);
}

TEST_CASE("a worn damper: what each wear adds, and its rest") {
  const auto as_new = tanh_damper();
  const DamperInput out{0.01, 0.2, 0}, in{0.01, -0.2, 0};
  std::vector<double> state(as_new->state_size());
  const auto force = [&](const std::string& wear, double amount, const DamperInput& at) {
    return WornDamper(as_new, {{&find_wear(wear, "test"), amount}}).force(at, state);
  };
  const double pulled = as_new->force(out, state), pushed = as_new->force(in, state);
  CHECK_CLOSE(force("force", -0.1, out), 0.9 * pulled, 1e-12, 0);
  CHECK_CLOSE(force("rebound", -0.1, out), 0.9 * pulled, 1e-12, 0);
  CHECK(force("rebound", -0.1, in) == pushed);
  CHECK_CLOSE(force("compression", -0.1, in), 0.9 * pushed, 1e-12, 0);
  CHECK_CLOSE(force("viscous", 10, in), pushed - 2, 1e-12, 0);
  CHECK_CLOSE(force("stiffness", 100, in), pushed + 1, 1e-12, 0);
  CHECK(contains(message_of([] { find_wear("forse", "--tracked"); }),
                 "--tracked: unknown wear 'forse'; did you mean 'force'"));
}

TEST_CASE("estimate_day: the wear and the load of a day, with deviations that hold") {
  const WatchedPlant watched = watched_oscillator({"force"});
  const DayEstimate day = [&] {
    WatchedPlant begun = watched;
    begun.setup.unknown.front().about = 10.0;
    return estimate_day(begun, oscillator_day(11, -0.2, 5));
  }();
  CHECK(day.converged);
  CHECK_CLOSE(day.wear[0], -0.2, 0, 4 * day.wear_deviation[0]);
  CHECK(day.wear_deviation[0] > 0);
  CHECK(day.wear_deviation[0] < 0.05);
  CHECK_CLOSE(day.plant[0], 11, 0.02, 0);
}

TEST_CASE("estimate_day: an input that counts otherwise is told from a damper that fades") {
  const WatchedPlant watched = watched_oscillator({"force"});
  const auto gain_of = [&](double force, double shows) {
    PlantRecording recording = oscillator_day(10, force, 5);
    for (Channel& channel : recording.channels)
      if (channel.name == "push")
        for (double& value : channel.samples) value *= shows;
    const DayEstimate day = estimate_day(watched, recording);
    REQUIRE(day.input_gains.size() == 1);
    CHECK(day.input_gains[0].first == "push");
    return day.input_gains[0].second;
  };
  CHECK_CLOSE(gain_of(0, 1), 1, 0.02, 0);
  CHECK_CLOSE(gain_of(-0.3, 1), 1, 0.02, 0);
  CHECK_CLOSE(gain_of(0, 0.9), 1 / 0.9, 0.05, 0);
}

TEST_CASE("estimate_day: a car that stands for a while is no other than one that drives on" *
          doctest::test_suite("long")) {
  const InPlantSetup setup = parse_in_plant_setup(
      "plant: quarter_car\n"
      "parameters: {sprung_mass: 345 kg, unsprung_mass: 40 kg, spring_stiffness: 17 N/mm, "
      "tyre_stiffness: 200 kN/m}\n"
      "inputs: [{kind: ground, class: C, speed: 20 m/s}]\n"
      "sensors:\n"
      "  - {channel: body, quantity: acceleration, at: body, noise: 0.05}\n"
      "  - {channel: wheel, quantity: acceleration, at: wheel, noise: 0.05}\n"
      "  - {channel: level, quantity: deflection, noise: 0.2 mm}\n",
      "car.yaml");
  WatchedPlant watched{.dampers = {{std::make_shared<LawModel>(load_parameters("spencer1997")),
                                    {-0.05, 0.05, -1, 1, 0, 0}}},
                       .setup = setup,
                       .wears = {&find_wear("force", "test")}};
  watched.noise = {.force = {{30, 0.02}}, .sensors = {0.05, 0.05, 2e-4}, .roughness = 256e-6};
  watched.setup.inputs.front().road->roughness = 0;  // found on each day

  // A drive, and the same behind 10 s at which the sensors show their noise alone.
  const VirtualRide ride = virtual_campaign(setup, *watched.dampers.front().model,
                                            {.duration = 10,
                                             .sample_rate = 500,
                                             .levels = {0},
                                             .road = "iso8608,class=C,speed=20m/s",
                                             .seed = 3})
                               .front();
  PlantRecording drives{.name = "day",
                        .sample_time = ride.recorded.sample_time,
                        .samples = ride.recorded.size(),
                        .channels = ride.recorded.channels};
  PlantRecording stands = drives;
  Random random(8);
  for (std::size_t s = 0; s < setup.sensors.size(); ++s) {
    const auto own = std::ranges::find(stands.channels, setup.sensors[s].channel, &Channel::name);
    std::vector<double> still;
    for (int k = 0; k < 5000; ++k)
      still.push_back(own->samples.front() + setup.sensors[s].noise * random.normal());
    own->samples.insert(own->samples.begin(), still.begin(), still.end());
  }
  stands.samples += 5000;
  const DayEstimate moved = estimate_day(watched, drives), stood = estimate_day(watched, stands);
  CHECK_CLOSE(stood.wear[0], moved.wear[0], 0, 0.01);
  CHECK_CLOSE(stood.excitation, moved.excitation, 0.1, 0);
}

TEST_CASE("estimate_day: what would pass for a change of the damper is refused") {
  WatchedPlant watched = watched_oscillator({"force"});
  watched.setup.unknown.front().about = 10.0;
  watched.sample_time = 0.005;
  const PlantRecording day = oscillator_day(11, 0, 5);
  const auto refused = [&](const auto& change) {
    PlantRecording other = day;
    change(other);
    return message_of([&] { estimate_day(watched, other); });
  };
  const auto still = [](const std::string& name) {
    return [name](PlantRecording& other) {
      for (Channel& channel : other.channels)
        if (channel.name == name) std::ranges::fill(channel.samples, 0.0);
    };
  };
  CHECK(contains(refused(still("push")), "day, push: is constant"));
  CHECK(contains(refused(still("x")), "day, x: is constant"));
  CHECK(contains(refused([](PlantRecording& other) { other.sample_time = 0.01; }),
                 "is sampled every 10 ms, the first days every 5 ms"));
  CHECK(contains(refused([](PlantRecording& other) {
                   other.samples = 300;
                   for (Channel& channel : other.channels) channel.samples.resize(300);
                 }),
                 "is 1.5 s long"));

  // A load beyond the range of what is expected makes the wear another's.
  watched.setup.unknown.front().upper = 10.5;
  const DayEstimate heavy = estimate_day(watched, day);
  CHECK_FALSE(heavy.converged);
  CHECK(at_an_end(watched, heavy) == "mass");
}

TEST_CASE("watch: a day without motion in a state of before spoils no other") {
  const WatchedPlant watched = watched_oscillator({"force"});
  std::vector<WatchedDay> days;
  for (int d = 0; d < 30; ++d)
    days.push_back({.estimate = {.name = "day",
                                 .wear = {0.01 * (d % 3)},
                                 .wear_deviation = {0.01},
                                 .plant = {10},
                                 .plant_deviation = {0.1},
                                 .excitation = d == 25 ? 0 : 1 + 0.1 * (d % 5),
                                 .converged = true},
                    .known = {}});
  const auto charts = watch_charts(watched, days, {.wears = {"force"}});
  CHECK(std::isfinite(charts.front().chart.points.back().sum));
}

TEST_CASE("watch: a reference day far from the others is told, and no usual one") {
  const auto told = [](double odd) {
    return odd_days_among({0.034, 0.024, 0.025, 0.019, odd, 0.02, -0.25, -0.25});
  };
  CHECK(told(0.03).empty());
  REQUIRE(told(-0.258).size() == 1);
  CHECK(contains(told(-0.258).front(),
                 "day 4 lies far from the other reference days: force is -26 %"));
}

TEST_CASE("watch: a judged day far above the days before is told, one far below is the chart's") {
  const auto told = [](double last) {
    return odd_days_among({0.034, 0.024, 0.025, 0.019, 0.03, 0.02, 0.028, 0.022, last});
  };
  CHECK(told(0.03).empty());
  CHECK(told(-0.2).empty());
  REQUIRE(told(0.2).size() == 1);
  CHECK(
      contains(told(0.2).front(),
               "day 8 lies far above what was to be expected: force is 20 %, by the days before"));
}

TEST_CASE("watch: a day on which an input seems to count otherwise is told, faded or not") {
  const auto told = [](double wear, double gain) {
    return odd_days_among({0.034, 0.024, 0.025, 0.019, 0.03, 0.02, 0.028, 0.022, wear}, gain);
  };
  CHECK(told(-0.2, 1.02).empty());
  CHECK(told(0.03, 1.04).empty());
  REQUIRE(told(-0.2, 1.25).size() == 1);
  CHECK(contains(told(-0.2, 1.25).front(),
                 "day 8: its sensors fit the plant better if push is some 1.2 times what the "
                 "recording shows (on the reference days 1.01 ± 0.0"));
  CHECK(told(0.03, 0.8).size() == 1);
}

TEST_CASE("watch: what was found and the days come back as they were kept") {
  WatchedPlant watched = watched_oscillator({"force"});
  watched.setup.unknown.front().about = 10.5;
  const WatchOptions options{.wears = {"force"}};
  const Value found = found_of(watched);
  const WatchedPlant again =
      watched_again({{tanh_damper(), kOscillatorDomain}},
                    parse_in_plant_setup(kWatchedOscillator, "oscillator.yaml"), found, options);
  CHECK(format_json(found_of(again)) == format_json(found));
  WatchedDay day{.estimate = {.name = "monday",
                              .wear = {-0.1},
                              .wear_deviation = {0.01},
                              .plant = {10},
                              .plant_deviation = {0.1},
                              .excitation = 2e-5,
                              .input_gains = {{"push", 1.02}},
                              .iterations = 3,
                              .converged = true},
                 .known = {21}};
  CHECK(format_json(to_json(watched_day_from_json(to_json(day)))) == format_json(to_json(day)));
  CHECK(contains(message_of([&] {
                   watched_plant({{tanh_damper(), kOscillatorDomain}}, watched.setup, {},
                                 {.wears = {"force"}});
                 }),
                 "there are none"));
  CHECK(contains(message_of([&] {
                   watched_again({{tanh_damper(), kOscillatorDomain}}, watched.setup, found,
                                 {.wears = {"force", "rebound", "compression"}});
                 }),
                 "force is the sum of rebound and compression"));
}

TEST_CASE("several dampers watched: each day says which of them is worn, and how far") {
  const InPlantSetup setup = two_dampers(kLowAndHigh, kBothMasses);
  const WatchedPlant watched = watched_rig(setup);
  for (const auto& [low, high] : {std::pair{0.3, 0.0}, {0.0, 0.3}}) {
    const DayEstimate day = estimate_day(watched, rig_day(setup, low, high, 7));
    CHECK(day.converged);
    REQUIRE(day.wear.size() == 2);
    CHECK_CLOSE(day.wear[0], -low, 0, std::max(4 * day.wear_deviation[0], 0.02));
    CHECK_CLOSE(day.wear[1], -high, 0, std::max(4 * day.wear_deviation[1], 0.02));
  }
}

TEST_CASE("several dampers watched: a chart each, which share the stated rate") {
  const InPlantSetup setup = two_dampers(kLowAndHigh, kBothMasses);
  const WatchedPlant watched = watched_rig(setup);
  std::vector<WatchedDay> days;
  Random random(4);
  for (int d = 0; d < 40; ++d)
    days.push_back(
        {.estimate = {.name = "day " + std::to_string(d),
                      .wear = {0.01 * random.normal(), 0.01 * random.normal() - (d < 30 ? 0 : 0.1)},
                      .wear_deviation = {0.01, 0.01},
                      .plant = {},
                      .plant_deviation = {},
                      .excitation = 1 + 0.1 * random.uniform(),
                      .converged = true},
         .known = {}});
  const WatchOptions options{.wears = {"force"}, .chart = {.reference = 20, .days = 300}};
  const std::vector<WatchedQuantity> charts = watch_charts(watched, days, options);
  REQUIRE(charts.size() == 2);
  CHECK(charts[0].name == "low_force");
  CHECK(charts[1].name == "high_force");
  CHECK(charts[1].meaning == "the high damper's whole force");
  CHECK(charts[0].chart.threshold == cusum_threshold(0.5, 600));
  CHECK(!charts[0].chart.alarm);
  REQUIRE(charts[1].chart.alarm);
  CHECK(days[charts[1].chart.since].estimate.name == "day 30");
  CHECK_CLOSE(charts[1].chart.fall, 0.1, 0, 0.02);
  CHECK(first_alarm_of(charts) == &charts[1]);

  // Both on one day: the one that went further.
  std::vector<WatchedQuantity> both = charts;
  both[0].chart = both[1].chart;
  both[0].chart.threshold *= 2;
  CHECK(first_alarm_of(both) == &both[1]);
  both[0].chart.threshold /= 4;
  CHECK(first_alarm_of(both) == &both[0]);
}

TEST_CASE("several dampers watched: any alarm of healthy days as often as is stated" *
          doctest::test_suite("long")) {
  const WatchedPlant watched = watched_rig(two_dampers(kLowAndHigh, kBothMasses));
  const WatchOptions options{
      .wears = {"force"},
      .chart = {.reference = 10, .days = 60, .threshold = cusum_threshold(0.5, 2 * 60)}};
  constexpr int kRuns = 1500;
  double judged = 0;
  int alarms = 0;
  Random random(6);
  for (int run = 0; run < kRuns; ++run) {
    // What is taken from one damper is given to the other, as where they are hard to tell apart.
    std::vector<WatchedDay> days(110);
    for (WatchedDay& day : days) {
      const double shared = random.normal();
      day.estimate = {
          .wear = {0.01 * (random.normal() + shared), 0.01 * (random.normal() - shared)},
          .excitation = std::exp(0.3 * random.normal()),
          .converged = true};
    }
    const std::vector<WatchedQuantity> charts = watch_charts(watched, days, options);
    const WatchedQuantity* first = first_alarm_of(charts);
    alarms += first != nullptr;
    judged += static_cast<double>(first ? *first->chart.alarm - 9 : 100);
  }
  CHECK_CLOSE(judged / alarms, 60, 0.1, 0);
}

TEST_CASE("several dampers watched: what the sensors cannot tell apart is refused, or said" *
          doctest::test_suite("long")) {
  const auto found = [](const InPlantSetup& setup) {
    return watched_plant(ObservedDampers(2, {tanh_damper(), kOscillatorDomain}), setup,
                         {rig_day(setup, 0, 0, 1), rig_day(setup, 0, 0, 2)}, {.wears = {"force"}});
  };

  // Side by side between the same masses nothing tells one from the other.
  const std::string refusal = message_of([&] {
    found(
        two_dampers("[{name: left, from: floor, to: table}, {name: right, from: floor, to: table}]",
                    kBothMasses));
  });
  CHECK(contains(refusal, "plant, sensors: cannot tell left_force from right_force"));

  // Two that are told apart say so, and the state keeps it.
  const InPlantSetup setup = two_dampers(kLowAndHigh, kBothMasses);
  const WatchedPlant told = found(setup);
  REQUIRE(told.outlook.size() == 2);
  CHECK(told.outlook[0].like == 1);
  CHECK(told.outlook[0].deviation < 0.05);
  CHECK(hardly_apart(told).empty());
  const Value kept = found_of(told);
  CHECK(format_json(found_of(watched_again(told.dampers, setup, kept, {.wears = {"force"}}))) ==
        format_json(kept));

  // A state that names an amount that is none is refused.
  WatchedPlant wrong = told;
  wrong.outlook[1].like = 2;
  CHECK(contains(message_of([&] {
                   watched_again(told.dampers, setup, found_of(wrong), {.wears = {"force"}});
                 }),
                 "is of no amount"));

  // Where one is known ten times as well alone, a warning names both.
  WatchedPlant doubtful = told;
  doubtful.outlook[1].deviation = 10 * doubtful.outlook[1].alone;
  REQUIRE(hardly_apart(doubtful).size() == 1);
  CHECK(contains(hardly_apart(doubtful).front(), "hardly tell high_force from low_force"));
}

TEST_CASE("day_disorder: names whose numbers tell another order") {
  CHECK(contains(day_disorder({"", "day_1.csv", "day_10.csv", "day_2.csv"}),
                 "day_2.csv comes behind day_10.csv"));
  CHECK(day_disorder({"day_1.csv", "day_2.csv", "day_10.csv"}).empty());
  CHECK(day_disorder({"30.11.2026.csv", "01.12.2026.csv"}).empty());
  CHECK(day_disorder({"day_3.csv", "", "day_2.csv"}).empty());
  CHECK(day_disorder({}).empty());
}
