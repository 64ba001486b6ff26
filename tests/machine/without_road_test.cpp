#include "dashpot/machine/without_road.h"

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/observe.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/machine/worn_damper.h"
#include "support.h"

using namespace dashpot;

namespace {

const std::string kUnmeasuredCar =
    "plant: quarter_car\n"
    "parameters:\n"
    "  unsprung_mass: 139.5 kg\n"
    "  spring_stiffness: 37300 N/m\n"
    "  sprung_mass: {about: 300 kg, from: 100 kg, to: 1000 kg}\n"
    "  tyre_stiffness: {about: 200 kN/m, from: 100 kN/m, to: 1000 kN/m}\n"
    "inputs:\n"
    "  - {kind: ground, class: C, speed: 20 m/s}\n"
    "sensors:\n"
    "  - {channel: body, quantity: acceleration, at: body, noise: 0.05}\n"
    "  - {channel: wheel, quantity: acceleration, at: wheel, noise: 0.05}\n"
    "  - {channel: level, quantity: deflection, noise: 0.2 mm, delay: 2 ms}\n"
    "voltage: coil\n";

InPlantSetup unmeasured_car(const std::string& old = "", const std::string& now = "") {
  std::string text = kUnmeasuredCar;
  if (!old.empty()) text.replace(text.find(old), old.size(), now);
  return parse_in_plant_setup(text, "car.yaml");
}

std::vector<PlantRecording> recordings_of(const std::vector<VirtualRide>& rides) {
  std::vector<PlantRecording> recordings;
  for (const VirtualRide& ride : rides)
    recordings.push_back({.name = ride.recorded.name,
                          .sample_time = ride.recorded.sample_time,
                          .samples = ride.recorded.size(),
                          .channels = ride.recorded.channels});
  return recordings;
}

/// A filter at this sensor of a plant's file.
std::string with_filter(std::string text, const std::string& channel, const std::string& filter) {
  const std::size_t place = text.find('}', text.find("channel: " + channel));
  return text.insert(place, ", filter: " + filter);
}

/// The plant with these numbers in the place of those that are unknown.
InPlantSetup truly(InPlantSetup plant, const NamedValues& truth) {
  plant.unknown.clear();
  plant.known.insert(plant.known.end(), truth.begin(), truth.end());
  return plant;
}

/// Two rides of a plant, which has these numbers in truth, with spencer1997 in each strut; the last
/// of them weaker by this share.
std::vector<PlantRecording> rides_of(const InPlantSetup& plant, const NamedValues& truth,
                                     double seconds, std::uint64_t seed = 31, double weaker = 0) {
  const auto as_new = std::make_shared<LawModel>(load_parameters("spencer1997"));
  const WornDamper weak(mounted(as_new, 0), {{&find_wear("force", "test"), -weaker}});
  std::vector<const DamperModel*> dampers(plant.dampers(), as_new.get());
  if (weaker > 0) dampers.back() = &weak;
  return recordings_of(virtual_campaign(truly(plant, truth), dampers,
                                        {.duration = seconds,
                                         .levels = {0, 1},
                                         .road = "iso8608,class=C,speed=20m/s",
                                         .seed = seed}));
}
std::vector<PlantRecording> spencer_rides(double seconds) {
  return rides_of(unmeasured_car(), {{"sprung_mass", 387}, {"tyre_stiffness", 295200}}, seconds);
}

/// A half car, each of whose tyres has a road of its own.
InPlantSetup unmeasured_half_car() {
  return parse_in_plant_setup(
      "plant: half_car\n"
      "parameters: {mass: {about: 600 kg, from: 400 kg, to: 1000 kg},\n"
      "  inertia: {about: 1000 kg*m^2, from: 500 kg*m^2, to: 2500 kg*m^2},\n"
      "  front_wheel_mass: 40 kg, rear_wheel_mass: 45 kg, front_stiffness: 17 N/mm,\n"
      "  rear_stiffness: 22 N/mm, front_tyre_stiffness: {about: 150 N/mm},\n"
      "  rear_tyre_stiffness: {about: 150 N/mm}, front_distance: 1.3 m, rear_distance: 1.5 m}\n"
      "inputs:\n"
      "  - {kind: ground, at: front, class: C, speed: 20 m/s}\n"
      "  - {kind: ground, at: rear, class: C, speed: 20 m/s}\n"
      "sensors:\n"
      "  - {channel: body, quantity: acceleration, at: body, noise: 0.05}\n"
      "  - {channel: pitch, quantity: velocity, at: pitch}\n"
      "  - {channel: front, quantity: acceleration, at: front_wheel, noise: 0.05}\n"
      "  - {channel: rear, quantity: acceleration, at: rear_wheel, noise: 0.05}\n"
      "  - {channel: level_front, quantity: deflection, at: front, noise: 0.2 mm}\n"
      "  - {channel: level_rear, quantity: deflection, at: rear, noise: 0.2 mm}\n"
      "voltage: coil\n",
      "half.yaml");
}

}  // namespace

TEST_CASE("without a road: masses, tyre and force of a damper of another structure are recovered" *
          doctest::test_suite("long")) {
  const InPlantReport report =
      identify_in_plant(find_law("tanh_kwok"), unmeasured_car(), spencer_rides(12), {});
  CAPTURE(report.message);
  REQUIRE(report.has_models());
  CHECK(report.status == FitReport::Status::Converged);
  CHECK_FALSE(report.road_measured);
  CHECK(report.knowable.confounded.empty());
  REQUIRE(report.plant.size() == 2);
  CHECK_CLOSE(report.plant[0].value, 387, 0.15, 0);
  CHECK_CLOSE(report.plant[1].value, 295200, 0.1, 0);
  for (const FittedParameter& p : report.plant) {
    CHECK(p.low < p.value);
    CHECK(p.value < p.high);
  }

  // The force over speed at both levels, against the truth's own along one motion.
  const LawModel truth = load_parameters("spencer1997");
  for (const double volt : {0.0, 1.0}) {
    std::vector<DamperInput> motion;
    for (int k = 0; k < 1000; ++k)
      motion.push_back({0.015 * std::sin(0.03 * k), 0.015 * 15 * std::cos(0.03 * k), volt});
    std::vector<double> z(truth.state_size()), own(report.kinds.front().model->state_size());
    truth.rest(motion[0], z);
    report.kinds.front().model->rest(motion[0], own);
    double square = 0, greatest = 0;
    for (std::size_t k = 1; k < motion.size(); ++k) {
      truth.advance(motion[k - 1], motion[k], 0.002, z);
      report.kinds.front().model->advance(motion[k - 1], motion[k], 0.002, own);
      const double force = truth.force(motion[k], z);
      square += std::pow(force - report.kinds.front().model->force(motion[k], own), 2);
      greatest = std::max(greatest, std::abs(force));
    }
    CHECK(std::sqrt(square / 1000) < 0.1 * 2 * greatest);
  }
}

TEST_CASE("without a road: a law that has no spring is told of the damper's" *
          doctest::test_suite("long")) {
  // spencer1997 is a spring of some 4 N/mm too, for which tanh_guo can take the car's alone.
  const InPlantSetup light = parse_in_plant_setup(
      "plant: quarter_car\n"
      "parameters: {sprung_mass: {about: 300 kg, from: 100 kg, to: 1000 kg},\n"
      "  unsprung_mass: 40 kg, spring_stiffness: 17 N/mm, tyre_stiffness: {about: 150 N/mm}}\n"
      "inputs: [{kind: ground, class: C, speed: 20 m/s}]\n"
      "sensors:\n"
      "  - {channel: body, quantity: acceleration, at: body, noise: 0.05}\n"
      "  - {channel: wheel, quantity: acceleration, at: wheel, noise: 0.05}\n"
      "  - {channel: level, quantity: deflection, noise: 0.2 mm}\n"
      "voltage: coil\n",
      "light.yaml");
  const InPlantReport report = identify_in_plant(
      find_law("tanh_guo"), light,
      rides_of(light, {{"sprung_mass", 345}, {"tyre_stiffness", 200e3}}, 20, 1), {});
  REQUIRE(report.has_models());
  CHECK(report.lacks == "spring");
  CHECK(std::ranges::any_of(report.warnings, [](const std::string& warning) {
    return contains(warning, "spring") &&
           contains(warning, "intervals of the plant reach to where its numbers go with it");
  }));
  CHECK(report.plant[0].value < 310);
  CHECK(report.plant[0].high > 345);
}

TEST_CASE("without a road: the law that is the damper's leaves less of the force than another" *
          doctest::test_suite("long")) {
  // A force over the speed alone, and one with a sharper knee than any; the truth is the first.
  InPlantSetup car = unmeasured_car();
  car.unknown.clear();
  car.known.insert(car.known.end(), {{"sprung_mass", 387}, {"tyre_stiffness", 295200}});
  const LawModel truth =
      LawModel::constant(find_law("tanh_guo"), std::vector<double>{400, 1000, 20, 0.05, 0.02, 0});
  const auto recordings = recordings_of(virtual_campaign(
      car, truth, {.duration = 12, .levels = {1}, .road = "iso8608,class=C,speed=20m/s"}));
  const auto fit = [&](const char* law) {
    return identify_in_plant(find_law(law), unmeasured_car(), recordings, {});
  };
  const InPlantReport right = fit("tanh_guo"), wrong = fit("bingham");
  REQUIRE((right.has_models() && wrong.has_models()));
  CHECK(right.force_error < 0.2 * wrong.force_error);
  CHECK(right.force_error > 0);
}

TEST_CASE("without a road: sensors behind filters, which the plant states or does not" *
          doctest::test_suite("long")) {
  std::string text = with_filter(kUnmeasuredCar, "body", "{cutoff: 50 Hz, order: 4}");
  text = with_filter(with_filter(text, "wheel", "50 Hz"), "level", "30 Hz");
  const InPlantSetup stated = parse_in_plant_setup(text, "car.yaml");
  const auto recordings = rides_of(stated, {{"sprung_mass", 387}, {"tyre_stiffness", 295200}}, 12);
  const auto fit = [&](const InPlantSetup& setup) {
    InPlantReport report =
        identify_in_plant(find_law("tanh_kwok"), setup, recordings, {.starts = 2, .grade = ""});
    REQUIRE(report.has_models());
    CHECK_CLOSE(report.plant[0].value, 387, 0.15, 0);
    CHECK_CLOSE(report.plant[1].value, 295200, 0.05, 0);
    return report;
  };
  const InPlantReport known = fit(stated), found = fit(unmeasured_car());
  CHECK(known.force_error < 60);
  CAPTURE(join(known.warnings, " | "));
  CHECK(known.warnings.empty());

  // Nearly delays: sqrt(2) over 2 pi 50 Hz for the wheel.
  CHECK(found.force_error < 60);
  CHECK(contains(found.warnings.back(), "not at one time: delay of body "));
  const auto delay_of_channel = [&](const std::string& channel) {
    return std::ranges::find(found.nuisances, "delay of " + channel, &FittedParameter::name)->value;
  };
  CHECK_CLOSE(delay_of_channel("body") - delay_of_channel("wheel"),
              delay_of({50, 4}) - delay_of({50, 2}), 0, 5e-4);
}

TEST_CASE("without a road: a half car, each of whose tyres has a road of its own" *
          doctest::test_suite("long")) {
  const InPlantSetup setup = unmeasured_half_car();
  const NamedValues truth = {{"mass", 690},
                             {"inertia", 1222},
                             {"front_tyre_stiffness", 200e3},
                             {"rear_tyre_stiffness", 200e3}};
  InPlantSetup noisy = setup;
  noisy.sensors[1].noise = 5e-3;
  const InPlantReport report = identify_in_plant(
      find_law("tanh_kwok"), setup, rides_of(noisy, truth, 12), {.starts = 2, .grade = ""});
  CAPTURE(report.message);
  REQUIRE(report.has_models());
  CHECK(report.kinds.size() == 1);  // they are alike
  CHECK(report.knowable.confounded.empty());
  REQUIRE(report.plant.size() == truth.size());
  for (std::size_t k = 0; k < truth.size(); ++k) {
    CHECK(report.plant[k].name == truth[k].first);
    CHECK_CLOSE(report.plant[k].value, truth[k].second, 0.06, 0);
    CHECK(report.plant[k].high - report.plant[k].low < 0.15 * truth[k].second);
  }

  // What was not stated of a sensor is found in the unit of its coordinate; no interval goes beyond
  // where it was looked for.
  const auto noise = std::ranges::find(report.nuisances, "noise of pitch", &FittedParameter::name);
  REQUIRE(noise != report.nuisances.end());
  CHECK(noise->unit == "rad/s");
  CHECK_CLOSE(noise->value, 5e-3, 0.1, 0);
  for (const FittedParameter& p : report.nuisances)
    if (p.name.ends_with("memory")) CHECK(p.high <= 5);
  REQUIRE(report.traces.front().dampers.size() == 2);
  CHECK(report.traces.front().dampers[1].strut == "rear");
}

TEST_CASE("without a road: a full car, whose left and right roads share what nobody knows" *
          doctest::test_suite("long")) {
  std::string text =
      "plant: full_car\n"
      "parameters: {mass: {about: 1300 kg}, pitch_inertia: {about: 1900 kg*m^2},\n"
      "  roll_inertia: {about: 600 kg*m^2}, wheel_mass: 59 kg, front_stiffness: 35 kN/m,\n"
      "  rear_stiffness: 38 kN/m, tyre_stiffness: {about: 150 kN/m}, front_distance: 1.4 m,\n"
      "  rear_distance: 1.7 m, front_track: 1.5 m, rear_track: 1.5 m}\n"
      "voltage: 1 V\nheld_back: 0\nsensors:\n"
      "  - {channel: body, quantity: acceleration, at: body, noise: 0.05}\n"
      "  - {channel: pitch, quantity: velocity, at: pitch, noise: 5e-3}\n"
      "  - {channel: roll, quantity: velocity, at: roll, noise: 5e-3}\n";
  std::string inputs = "inputs:\n";
  for (const std::string corner : {"front_left", "front_right", "rear_left", "rear_right"}) {
    inputs += "  - {kind: ground, class: C, speed: 20 m/s, at: " + corner + "}\n";
    text += "  - {channel: wheel_" + corner + ", quantity: acceleration, at: " + corner +
            "_wheel, noise: 0.05}\n  - {channel: level_" + corner +
            ", quantity: deflection, at: " + corner + ", noise: 0.2 mm}\n";
  }
  const InPlantSetup setup = parse_in_plant_setup(text + inputs, "full.yaml");
  const NamedValues truth = {
      {"mass", 1500}, {"pitch_inertia", 2160}, {"roll_inertia", 460}, {"tyre_stiffness", 190e3}};
  const LawModel damper =
      LawModel::constant(find_law("tanh_guo"), std::vector<double>{400, 1500, 20, 0.05, 0.02, 0});
  const auto found_in = [&](double seconds, const std::string& tracks) {
    const auto rides = virtual_campaign(
        truly(setup, truth), damper,
        {.duration = seconds, .levels = {1}, .road = "iso8608,class=C,speed=20m/s" + tracks});
    return identify_in_plant(find_law("tanh_guo"), setup, recordings_of(rides),
                             {.starts = 2, .grade = ""});
  };
  const InPlantReport report = found_in(6, ",track_width=1.5");
  CAPTURE(report.message);
  REQUIRE(report.has_models());
  CHECK(report.kinds.size() == 1);
  CHECK(report.knowable.confounded.empty());
  for (std::size_t k = 0; k < truth.size(); ++k) {
    CAPTURE(truth[k].first);
    CHECK_CLOSE(report.plant[k].value, truth[k].second, 0.05, 0);
    CHECK(report.plant[k].low < truth[k].second);
    CHECK(report.plant[k].high > truth[k].second);
  }
  const auto width =
      std::ranges::find(report.nuisances, "track width of the road", &FittedParameter::name);
  REQUIRE(width != report.nuisances.end());
  CHECK(width->low < 1.5);
  CHECK(width->high > 1.5);
  CHECK(width->high < 3 * width->low);

  // Where left and right meet one road.
  const InPlantReport none = found_in(3, "");
  CHECK_FALSE(none.has_models());
  CHECK(none.status == FitReport::Status::Failed);
  CHECK(contains(none.message, "left and right meet one and the same road"));
}

TEST_CASE("without a road: dampers that are not alike are told apart unasked" *
          doctest::test_suite("long")) {
  const NamedValues truth = {{"mass", 690},
                             {"inertia", 1222},
                             {"front_tyre_stiffness", 200e3},
                             {"rear_tyre_stiffness", 200e3}};
  InPlantSetup setup = unmeasured_half_car();
  setup.sensors[1].noise = 5e-3;
  const InPlantReport report =
      identify_in_plant(find_law("tanh_kwok"), setup, rides_of(setup, truth, 6, 31, 1.0 / 3),
                        {.starts = 2, .grade = ""});
  REQUIRE(report.kinds.size() == 2);
  CHECK(contains(report.warnings.back(), "not alike: those of front, rear"));
  CHECK_CLOSE(report.plant.front().value, 690, 0.08, 0);
  const auto number = [&](const std::string& name) {
    return std::ranges::find(report.damper, name, &FittedParameter::name)->value;
  };
  CHECK_CLOSE(number("rear.alpha_b"), number("front.alpha_b") * 2 / 3, 0.1, 0);
}

TEST_CASE("without a road: what cannot be told is refused, with the reason") {
  const std::vector<PlantRecording> recordings = spencer_rides(2);
  const Law& law = find_law("tanh_kwok");
  const auto refusal = [&](const InPlantSetup& setup, const std::vector<PlantRecording>& from,
                           const InPlantOptions& options = {}) {
    return message_of([&] { identify_in_plant(law, setup, from, options); });
  };

  // One sensor, no scale of force, no time to count delays from.
  InPlantSetup one = unmeasured_car();
  one.sensors.resize(1);
  CHECK(
      contains(refusal(one, recordings), "may come of the road or of the damper; a second sensor"));
  InPlantSetup scaleless = unmeasured_car();
  scaleless.known.clear();
  CHECK(contains(refusal(scaleless, recordings), "motions alone tell only their ratios"));
  InPlantSetup late = unmeasured_car();
  for (PlantSensor& sensor : late.sensors) sensor.finds_delay = true;
  CHECK(contains(refusal(late, recordings), "state the delay of one sensor"));
  InPlantSetup filtered = unmeasured_car();
  filtered.sensors[1].finds_cutoff = CutoffRange{};
  CHECK(contains(refusal(filtered, recordings), "wheel: the cut-off of its filter is unknown"));

  // Signals that tell nothing.
  std::vector<PlantRecording> still = recordings;
  std::ranges::fill(still[1].channels[0].samples, 0.3);
  CHECK(contains(refusal(unmeasured_car(), still), "ride_2, body: is constant"));
  CHECK(contains(refusal(unmeasured_car(), {recordings[0]},
                         {.choices = {{.law = {}, .parameter = "c", .form = Form::Linear}}}),
                 "form of c: cannot be told: the drive is 0 V all along"));
  std::vector<PlantRecording> brief = recordings;
  brief[0].samples = 300;
  CHECK(contains(refusal(unmeasured_car(), brief), "leaves 225 samples to fit"));
}
