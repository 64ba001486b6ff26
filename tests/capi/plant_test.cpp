#include <algorithm>
#include <cmath>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/observe.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/machine/worn_damper.h"
#include "dashpot/value.h"
#include "handles.h"

namespace {

using Rides = Held<dashpot_rides, dashpot_rides_free>;

const char* const kPushedMass =
    "plant: oscillator\n"
    "parameters: {mass: unknown, damping: 0, stiffness: 4000 N/m}\n"
    "inputs: [{channel: push, kind: force, at: mass}]\n"
    "sensors:\n"
    "  - {channel: x, quantity: displacement, at: mass, noise: 0.01 mm}\n"
    "  - {channel: a, quantity: acceleration, at: mass, noise: 0.01}\n";

const char* const kTwoDampers =
    "plant: matrices\ncoordinates: [floor, table]\n"
    "mass: [[100 kg, 0], [0, 60 kg]]\n"
    "stiffness: [[60 kN/m, -20 kN/m], [-20 kN/m, 20 kN/m]]\n"
    "dampers: [{name: low, from: ground, to: floor}, {name: high, from: floor, to: table}]\n"
    "inputs: [{channel: push, kind: force, at: floor, noise: 1}]\n"
    "sensors:\n"
    "  - {channel: x, quantity: displacement, at: table, noise: 0.01 mm}\n"
    "  - {channel: a, quantity: acceleration, at: floor, noise: 0.01}\n"
    "voltage: 1 V\n";

/// A mass of 10 kg with c = 40 N*s/m and a Coulomb force of 8 N, pushed at random.
dashpot::Record pushed_mass() {
  const dashpot::Law& law = dashpot::find_law("bingham");
  std::vector<double> p(law.params.size());
  p[law.index_of("c0")] = 40;
  p[law.index_of("f_c")] = 8;
  dashpot::InPlantSetup setup = dashpot::parse_in_plant_setup(kPushedMass, "plant");
  setup.unknown.clear();
  setup.known.emplace_back("mass", 10);
  return dashpot::virtual_campaign(setup, dashpot::LawModel::constant(law, p),
                                   {.duration = 4, .sample_rate = 200, .levels = {0}, .push = 30})
      .front()
      .recorded;
}

dashpot_status add(dashpot_rides* rides, const dashpot::Record& record,
                   const char* name = "pushed") {
  const dashpot_named_column columns[] = {{"push [N]", {record.channel("push").samples.data(), 1}},
                                          {"x [m]", {record.channel("x").samples.data(), 1}},
                                          {"a", {record.channel("a").samples.data(), 1}}};
  const dashpot_table table = {name, record.size(), record.sample_time, columns, 3, nullptr};
  return dashpot_rides_add(rides, &table);
}

}  // namespace

TEST_CASE("a damper inside a plant: identified from arrays, then observed") {
  Rides rides;
  REQUIRE(dashpot_rides_new(&rides) == DASHPOT_OK);
  const dashpot::Record record = pushed_mass();
  REQUIRE(add(rides, record) == DASHPOT_OK);
  CHECK(dashpot_rides_count(rides) == 1);

  // What was found: the mass, the damper, the plant for the observer, what would help.
  Model model;
  Text report;
  REQUIRE(dashpot_identify_in_plant(
              rides, kPushedMass,
              R"({"models": ["tanh_kwok"], "fix": ["k=0"], "starts": 4, "command": "a test"})",
              nullptr, &model, &report) == DASHPOT_OK);
  const dashpot::Value told = dashpot::parse_json(report.handle, "report");
  const dashpot::Value& mass = told.find("plant")->items().front();
  CHECK(mass.find("name")->as_string() == "mass");
  CHECK_CLOSE(mass.find("value")->as_number(), 10, 0.01, 0);
  CHECK(!told.find("advice")->find("sensors")->items().empty());
  Text text;
  REQUIRE(dashpot_model_text(model, &text) == DASHPOT_OK);
  CHECK(contains(text.handle, "identified in a plant: oscillator"));
  CHECK(contains(text.handle, "a test"));

  const std::string found = dashpot::format_json(*told.find("found"));
  Recordings estimates;
  Text observed;
  REQUIRE(dashpot_observe(model, rides, found.c_str(),
                          R"({"force_error": [[1, 0.02]], "velocity_shift": [0.004, 0.015]})",
                          nullptr, &estimates, &observed) == DASHPOT_OK);
  dashpot_record_info info;
  REQUIRE(dashpot_recordings_get_info(estimates, 0, &info) == DASHPOT_OK);
  CHECK(info.samples == record.size());
  dashpot_channel force, half;
  REQUIRE(dashpot_recordings_channel(estimates, 0, 0, &force) == DASHPOT_OK);
  REQUIRE(dashpot_recordings_channel(estimates, 0, 1, &half) == DASHPOT_OK);
  CHECK(std::string(force.name) == "damper_force");
  CHECK(std::string(half.name) == "damper_force_half_band");
  CHECK(std::all_of(half.data, half.data + info.samples, [](double h) { return h > 0; }));
  CHECK(contains(observed.handle, "force_errors"));
  CHECK(contains(observed.handle, "\"deviation_m_s\": 0.004"));
}

TEST_CASE("dampers inside a plant: the force of each is observed by its strut's name") {
  const Model model = published("spencer1997");
  const dashpot::VirtualRide ride =
      dashpot::virtual_campaign(dashpot::parse_in_plant_setup(kTwoDampers, "plant"),
                                dashpot::load_parameters("spencer1997"),
                                {.duration = 2, .sample_rate = 200, .levels = {1}, .push = 300})
          .front();
  Rides rides;
  REQUIRE(dashpot_rides_new(&rides) == DASHPOT_OK);
  REQUIRE(add(rides, ride.recorded) == DASHPOT_OK);
  Recordings estimates;
  REQUIRE(dashpot_observe(model, rides, kTwoDampers, R"({"force_error": [[5, 0.02]], "steps": 4})",
                          nullptr, &estimates, nullptr) == DASHPOT_OK);
  for (const std::size_t damper : {0u, 1u}) {
    dashpot_channel force;
    REQUIRE(dashpot_recordings_channel(estimates, 0, 2 * damper, &force) == DASHPOT_OK);
    CHECK(std::string(force.name) == (damper == 0 ? "low_damper_force" : "high_damper_force"));
    const std::vector<double>& truth = ride.truth.channel(force.name).samples;
    double error = 0, size = 0;
    for (std::size_t k = 100; k < truth.size(); ++k) {
      error += (force.data[k] - truth[k]) * (force.data[k] - truth[k]);
      size += truth[k] * truth[k];
    }
    CHECK(error < 0.01 * size);
  }

  // In free run, with one model for both: the noise of the sensors is left, and forces are there.
  const dashpot_placed_model both = {nullptr, model};
  Recordings runs;
  Text judged;
  REQUIRE(dashpot_evaluate_in_plant(&both, 1, rides, kTwoDampers, R"({"steps": 8})", nullptr, &runs,
                                    &judged) == DASHPOT_OK);
  const dashpot::Value told = dashpot::parse_json(judged.handle, "report");
  CHECK(told.find("steps_per_sample")->as_number() == 8);
  for (const dashpot::Value& sensor : told.find("sensors")->items())
    CHECK(sensor.find("error")->as_number() < 0.2 * sensor.find("rms")->as_number());
  dashpot_channel measured, modelled;
  REQUIRE(dashpot_recordings_channel(runs, 0, 0, &measured) == DASHPOT_OK);
  REQUIRE(dashpot_recordings_channel(runs, 0, 1, &modelled) == DASHPOT_OK);
  CHECK(std::string(modelled.name) == std::string(measured.name) + "_modelled");
  Text none;
  CHECK(contains(message_of(DASHPOT_BAD_INPUT,
                            dashpot_evaluate_in_plant(&both, 1, rides, kTwoDampers,
                                                      R"({"steps": -1})", nullptr, nullptr, &none)),
                 "options, steps"));

  // A model for each, in any order, tells the same.
  const dashpot_placed_model each[] = {{"high", model}, {"low", model}};
  Recordings placed;
  REQUIRE(dashpot_observe_dampers(each, 2, rides, kTwoDampers,
                                  R"({"force_error": [[5, 0.02]], "steps": 4})", nullptr, &placed,
                                  nullptr) == DASHPOT_OK);
  dashpot_channel once, twice;
  REQUIRE(dashpot_recordings_channel(estimates, 0, 2, &once) == DASHPOT_OK);
  REQUIRE(dashpot_recordings_channel(placed, 0, 2, &twice) == DASHPOT_OK);
  CHECK(std::equal(once.data, once.data + 400, twice.data));
}

TEST_CASE("dampers inside a plant: a model of each kind, and none for all") {
  const dashpot::Law& law = dashpot::find_law("tanh_guo");
  const auto damper = [&](double damping, double friction) {
    std::vector<double> p(law.params.size());
    p[law.index_of("A1")] = friction;
    p[law.index_of("A2")] = damping;
    p[law.index_of("A3")] = 20;
    p[law.index_of("X0")] = 1;
    return dashpot::LawModel::constant(law, p);
  };
  const dashpot::LawModel weak = damper(300, 40), strong = damper(900, 160);
  const dashpot::VirtualRide ride =
      dashpot::virtual_campaign(dashpot::parse_in_plant_setup(kTwoDampers, "plant"),
                                std::vector<const dashpot::DamperModel*>{&weak, &strong},
                                {.duration = 4, .sample_rate = 200, .levels = {1}, .push = 900})
          .front();
  Rides rides;
  REQUIRE(dashpot_rides_new(&rides) == DASHPOT_OK);
  REQUIRE(add(rides, ride.recorded) == DASHPOT_OK);
  const std::string plant = std::string(kTwoDampers) + "damper_kinds: {b: high, a: low}\n";
  const char* const options = R"({"models": ["tanh_guo"], "starts": 2})";

  dashpot_model* found[2];
  size_t count = 0;
  Text report;
  REQUIRE(dashpot_identify_dampers_in_plant(rides, plant.c_str(), options, nullptr, found, 2,
                                            &count, &report) == DASHPOT_OK);
  REQUIRE(count == 2);
  Model high, low;
  *&high = found[0];
  *&low = found[1];
  const dashpot::Value told = dashpot::parse_json(report.handle, "report");
  CHECK(told.find("found")->find("damper_kinds")->members()[0].first == "b");
  for (const auto& [model, truth] : {std::pair(&high, &strong), {&low, &weak}}) {
    double force = 0;
    const dashpot_input input = {0.01, 0.2, 1};
    REQUIRE(dashpot_force(*model, &input, nullptr, 0, &force) == DASHPOT_OK);
    CHECK_CLOSE(force, truth->force({0.01, 0.2, 1}, {}), 0.1, 0);
  }

  // By the names of their kinds they observe the plant that was found.
  const dashpot_placed_model each[] = {{"a", low}, {"b", high}};
  Recordings estimates;
  const std::string as_found = dashpot::format_json(*told.find("found"));
  CHECK(dashpot_observe_dampers(each, 2, rides, as_found.c_str(), nullptr, nullptr, &estimates,
                                nullptr) == DASHPOT_OK);

  // No room, and a call that hands over one.
  CHECK(contains(message_of(DASHPOT_BAD_INPUT,
                            dashpot_identify_dampers_in_plant(rides, plant.c_str(), options,
                                                              nullptr, found, 1, &count, nullptr)),
                 "room: is 1; one for each of the plant's 2 dampers"));
  Model none;
  CHECK(contains(
      message_of(DASHPOT_BAD_INPUT,
                 dashpot_identify_in_plant(rides, plant.c_str(), options, nullptr, &none, nullptr)),
      "are 2 (b, a), and dashpot_identify_in_plant knows one"));
}

TEST_CASE("dampers inside a plant, watched: which of them fades, and what is said of the days" *
          doctest::test_suite("long")) {
  const Model model = published("kwok2006");
  std::string plant = kTwoDampers;
  plant.replace(plant.find("voltage: 1 V"), 12, "current: 0 A");
  const auto truth = dashpot::mounted(
      std::make_shared<dashpot::LawModel>(dashpot::load_parameters("kwok2006")), 0);
  Rides rides;
  REQUIRE(dashpot_rides_new(&rides) == DASHPOT_OK);
  for (int day = 1; day <= 10; ++day) {
    const dashpot::WornDamper low(truth,
                                  {{&dashpot::find_wear("force", "test"), day > 8 ? -0.3 : 0.0}});
    const auto ride =
        dashpot::virtual_campaign(dashpot::parse_in_plant_setup(plant, "plant"),
                                  std::vector<const dashpot::DamperModel*>{&low, truth.get()},
                                  {.duration = 4,
                                   .sample_rate = 200,
                                   .levels = {0},
                                   .push = 800,
                                   .seed = static_cast<std::uint64_t>(day)});

    // The last comes under the name of an earlier one.
    const std::string name = "day_" + std::to_string(day < 10 ? day + 1 : 1) + ".csv";
    REQUIRE(add(rides, ride.front().recorded, name.c_str()) == DASHPOT_OK);
  }
  const char* const options = R"({"reference": 6, "false_alarms": 0.01})";
  const dashpot_placed_model each[] = {{"high", model}, {"low", model}};
  Text report;
  REQUIRE(dashpot_watch_dampers(each, 2, rides, plant.c_str(), options, nullptr, &report) ==
          DASHPOT_OK);
  const dashpot::Value told = dashpot::parse_json(report.handle, "report");
  CHECK(told.find("first_alarm")->as_string() == "low_force");
  REQUIRE(told.find("charts")->items().size() == 2);
  CHECK(!told.find("charts")->items()[1].find("alarm"));
  REQUIRE(told.find("warnings")->items().size() == 1);
  CHECK(contains(told.find("warnings")->items()[0].as_string(),
                 "day_1.csv comes behind day_10.csv, and its name says before"));

  // One model stands in each strut.
  Text alike;
  REQUIRE(dashpot_watch(model, rides, plant.c_str(), options, nullptr, &alike) == DASHPOT_OK);
  CHECK(std::string(alike.handle) == report.handle);

  // What cannot be.
  char* none = nullptr;
  const auto refusal = [&](const std::vector<dashpot_placed_model>& dampers) {
    return message_of(DASHPOT_BAD_INPUT,
                      dashpot_watch_dampers(dampers.data(), dampers.size(), rides, plant.c_str(),
                                            options, nullptr, &none));
  };
  CHECK(contains(refusal({{"low", model}}), "the damper 'high' has no model"));
  CHECK(contains(refusal({{"low", model}, {"hihg", model}}), "the plant has no damper 'hihg'"));
  CHECK(contains(refusal({{"low", model}, {"low", model}}), "the damper 'low' has two models"));
  CHECK(contains(refusal({{"low", model}, {nullptr, model}}), "strut"));
}

TEST_CASE("a damper inside a plant, watched: a state stands for the days before" *
          doctest::test_suite("long")) {
  const char* const plant =
      "plant: oscillator\n"
      "parameters: {mass: 100 kg, damping: 0, stiffness: 40 kN/m}\n"
      "inputs: [{channel: push, kind: force, at: mass}]\n"
      "sensors:\n"
      "  - {channel: x, quantity: displacement, at: mass, noise: 0.1 mm}\n"
      "  - {channel: a, quantity: acceleration, at: mass, noise: 0.05}\n"
      "current: 0 A\n";
  const auto truth = std::make_shared<dashpot::LawModel>(dashpot::load_parameters("kwok2006"));
  const auto record = [&](dashpot_rides* rides, std::uint64_t seed, double wear) {
    const dashpot::WornDamper damper(dashpot::mounted(truth, 0),
                                     {{&dashpot::find_wear("force", "test"), wear}});
    const auto ride = dashpot::virtual_campaign(
        dashpot::parse_in_plant_setup(plant, "plant"), damper,
        {.duration = 4, .sample_rate = 200, .levels = {0}, .push = 800, .seed = seed});
    REQUIRE(add(rides, ride.front().recorded) == DASHPOT_OK);
  };
  const Model model = published("kwok2006");
  const auto watch = [&](dashpot_rides* rides, const std::string& more) {
    Text report;
    const std::string options = R"({"reference": 6, "false_alarms": 0.01)" + more + "}";
    REQUIRE(dashpot_watch(model, rides, plant, options.c_str(), nullptr, &report) == DASHPOT_OK);
    return dashpot::parse_json(report.handle, "report");
  };

  // Healthy days teach; days without a third of the force raise the alarm.
  Rides healthy, weak;
  REQUIRE(dashpot_rides_new(&healthy) == DASHPOT_OK);
  REQUIRE(dashpot_rides_new(&weak) == DASHPOT_OK);
  for (std::uint64_t day = 1; day <= 7; ++day) record(healthy, day, 0);
  for (std::uint64_t day = 20; day <= 21; ++day) record(weak, day, -0.3);
  const dashpot::Value taught = watch(healthy, "");
  CHECK(!taught.find("alarm")->as_bool());
  const std::string state = ", \"state\": " + dashpot::format_json(*taught.find("state"));
  const dashpot::Value faded = watch(weak, state);
  CHECK(faded.find("days")->items().size() == 9);
  CHECK(faded.find("alarm")->as_bool());
  CHECK(std::abs(faded.find("charts")->items()[0].find("fall")->as_number() - 0.3) < 0.06);

  // What cannot be.
  char* report = nullptr;
  const auto refusal = [&](const std::string& options) {
    const dashpot_status status =
        dashpot_watch(model, weak, plant, options.c_str(), nullptr, &report);
    CHECK(report == nullptr);
    return message_of(DASHPOT_BAD_INPUT, status);
  };
  CHECK(contains(refusal(R"({"tracked": ["viscous"])" + state + "}"), "is of another tracked"));
  CHECK(contains(refusal(R"({"tracked": ["farce"]})"), "farce"));
  CHECK(contains(refusal(R"({"known": ["temperature"]})"), "has no column 'temperature'"));
  CHECK(contains(refusal(R"({"false_alarms": 1})"), "must lie between 0 and 0.1"));
  CHECK(contains(refusal(R"({"reference": 1})"), "or more, from which the healthy scatter"));
}

TEST_CASE("inside a plant: what cannot be is refused with what would be right") {
  Rides rides;
  REQUIRE(dashpot_rides_new(&rides) == DASHPOT_OK);
  dashpot_model* model = nullptr;
  const auto refusal = [&](const char* plant, const char* options) {
    const dashpot_status status =
        dashpot_identify_in_plant(rides, plant, options, nullptr, &model, nullptr);
    CHECK(model == nullptr);
    return message_of(DASHPOT_BAD_INPUT, status);
  };
  const char* const one = R"({"models": ["tanh_kwok"]})";
  CHECK(contains(refusal(kPushedMass, one), "rides: there are none"));
  REQUIRE(add(rides, pushed_mass()) == DASHPOT_OK);
  CHECK(contains(refusal(kPushedMass, "{}"), "models: are 0 laws"));
  CHECK(contains(refusal(kPushedMass, R"({"models": ["tanh_quok"]})"), "tanh_quok"));
  CHECK(contains(refusal(kPushedMass, R"({"models": ["tanh_kwok"], "grade": "lab"})"),
                 "unknown grade 'lab'"));
  CHECK(contains(refusal(kPushedMass, R"({"models": ["tanh_kwok"], "speed": 1})"),
                 "unknown key 'speed'"));
  CHECK(contains(refusal("plant: bicycle\n", one), "bicycle"));
  CHECK(contains(refusal("no_such.yaml", one), "no_such.yaml"));
  std::string other = kPushedMass;
  other.replace(other.find("channel: a"), 10, "channel: b");
  CHECK(contains(refusal(other.c_str(), one), "has no column 'b'"));

  const dashpot_named_column nameless[] = {{nullptr, {nullptr, 1}}};
  const dashpot_table table = {nullptr, 5, 0.01, nameless, 1, nullptr};
  CHECK(dashpot_rides_add(rides, &table) == DASHPOT_BAD_INPUT);
  CHECK(dashpot_rides_load(rides, "/no/such/folder") == DASHPOT_BAD_INPUT);
  CHECK(dashpot_rides_count(rides) == 1);
  const Model known = published();
  dashpot_recordings* estimates = nullptr;
  CHECK(contains(
      message_of(DASHPOT_BAD_INPUT, dashpot_observe(known, rides, kPushedMass, R"({"level": 2})",
                                                    nullptr, &estimates, nullptr)),
      "level: is 2"));
  std::string tenner = kPushedMass;
  tenner.replace(tenner.find("mass: unknown"), 13, "mass: 10 kg");
  CHECK(contains(message_of(DASHPOT_BAD_INPUT,
                            dashpot_observe(known, rides, tenner.c_str(),
                                            R"({"steps": 1000000, "force_error": [[5, 1]]})",
                                            nullptr, &estimates, nullptr)),
                 "steps: is 1000000 per sample; 1000 at most"));
  CHECK(contains(message_of(DASHPOT_BAD_INPUT, dashpot_observe(known, rides, tenner.c_str(),
                                                               R"({"velocity_shift": [0.004]})",
                                                               nullptr, &estimates, nullptr)),
                 "velocity_shift: is another thing than [m/s, s]"));
  CHECK(contains(message_of(DASHPOT_BAD_INPUT, dashpot_observe(known, rides, kPushedMass, nullptr,
                                                               nullptr, &estimates, nullptr)),
                 "mass"));
}
