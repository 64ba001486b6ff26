#include "dashpot/machine/plant_of_matrices.h"

#include <algorithm>
#include <cmath>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/machine/in_plant.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/observe.h"
#include "dashpot/machine/virtual_campaign.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Inputs and sensors of a quarter car; numbers that are known and unknown stand before them.
const std::string kOfTheCar =
    "inputs:\n"
    "  - {channel: road, kind: ground, noise: 0.2 mm}\n"
    "sensors:\n"
    "  - {channel: az_body, quantity: acceleration, at: body, noise: 0.05}\n"
    "  - {channel: az_wheel, quantity: acceleration, at: wheel, noise: 0.5}\n"
    "  - {channel: level, quantity: deflection, noise: 0.2 mm}\n"
    "voltage: 1 V\n";

const std::string kShippedCar =
    "plant: quarter_car\n"
    "parameters: {unsprung_mass: 139.5 kg, spring_stiffness: 37.3 N/mm, tyre_damping: 300 N*s/m,\n"
    "  sprung_mass: {about: 350 kg, from: 250 kg, to: 500 kg},\n"
    "  tyre_stiffness: {about: 250 kN/m, from: 100 kN/m, to: 600 kN/m}}\n" +
    kOfTheCar;

const std::string kCarOfMatrices =
    "plant: matrices\n"
    "coordinates: [body, wheel]\n"
    "parameters: {ms: {about: 350 kg, from: 250 kg, to: 500 kg}, ks: 37.3 N/mm,\n"
    "  kt: {about: 250 kN/m, from: 100 kN/m, to: 600 kN/m}}\n"
    "mass: [[ms, 0], [0, 139.5 kg]]\n"
    "damping: [[0, 0], [0, 0.3 kN*s/m]]\n"
    "stiffness: [[ks, -ks], [-ks, ks + kt]]\n"
    "ground: [{at: wheel, stiffness: kt, damping: 300}]\n"
    "damper: {name: suspension, from: wheel, to: body}\n" +
    kOfTheCar;

/// kCarOfMatrices with one text in place of another.
std::string car_with(const std::string& old, const std::string& other) {
  std::string text = kCarOfMatrices;
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), other);
}

std::string refusal_of(const std::string& text) {
  return message_of([&] { parse_in_plant_setup(text, "rig.yaml"); });
}

InPlantSetup with_truth(InPlantSetup setup, const NamedValues& values) {
  setup.known.insert(setup.known.end(), values.begin(), values.end());
  setup.unknown.clear();
  return setup;
}

VirtualRide ride_of(const InPlantSetup& setup) {
  return virtual_campaign(setup, load_parameters("spencer1997"),
                          {.duration = 2,
                           .sample_rate = 500,
                           .levels = {1},
                           .road = "iso8608,class=C,speed=20m/s",
                           .seed = 4})
      .front();
}

PlantRecording recording_of(const Record& record) {
  return {.name = "ride",
          .sample_time = record.sample_time,
          .samples = record.size(),
          .channels = record.channels};
}

double furthest_share(const std::vector<double>& one, const std::vector<double>& other) {
  double furthest = 0, size = 0;
  for (std::size_t k = 0; k < one.size(); ++k) {
    furthest = std::max(furthest, std::abs(one[k] - other[k]));
    size = std::max(size, std::abs(one[k]));
  }
  return furthest / size;
}

/// Three masses in a row on springs, the first on a wall, the second pushed, and a damper between
/// the first and the third: a dashpot and an arctangent. Forces spring by spring, by a method of
/// the test's own.
PlantRecording pushed_chain() {
  constexpr double kStep = 2e-5, kMasses[] = {10, 4, 6}, kSprings[] = {20e3, 8e3, 12e3};
  constexpr int kEvery = 100;  // 500 Hz
  PlantRecording recording{.name = "chain",
                           .sample_time = kEvery * kStep,
                           .samples = 2000,
                           .channels = {{"push", "N", {}, ""},
                                        {"a1", "m/s^2", {}, ""},
                                        {"a2", "m/s^2", {}, ""},
                                        {"a3", "m/s^2", {}, ""}}};
  double x[3] = {}, v[3] = {};
  for (std::size_t k = 0; k < recording.samples * kEvery; ++k) {
    const double t = kStep * static_cast<double>(k);
    double push = 0;
    for (int n = 1; n < 25; ++n) push += 6 * std::cos(6.5 * n * t + n * n);

    // Between neighbours springs with a little damping, and the damper over two of them.
    double force[4] = {};
    for (int i = 0; i < 3; ++i)
      force[i] =
          kSprings[i] * (x[i] - (i > 0 ? x[i - 1] : 0)) + 6 * (v[i] - (i > 0 ? v[i - 1] : 0));
    const double speed = v[2] - v[0];
    const double damper = 45 * speed + 9 * std::atan(speed / 0.04);
    const double a[3] = {(-force[0] + force[1] + damper) / kMasses[0],
                         (-force[1] + force[2] + push) / kMasses[1],
                         (-force[2] - damper) / kMasses[2]};
    if (k % kEvery == 0) {
      recording.channels[0].samples.push_back(push);
      for (std::size_t i = 0; i < 3; ++i) recording.channels[i + 1].samples.push_back(a[i]);
    }
    for (int i = 0; i < 3; ++i) {
      v[i] += kStep * a[i];
      x[i] += kStep * v[i];
    }
  }
  return recording;
}

}  // namespace

TEST_CASE("a plant of matrices: a quarter car written so is the shipped one, to rounding") {
  const InPlantSetup own = parse_in_plant_setup(kCarOfMatrices, "rig.yaml"),
                     shipped = parse_in_plant_setup(kShippedCar, "car.yaml");
  const NamedValues of_own = {{"ms", 387}, {"kt", 295200}},
                    of_shipped = {{"sprung_mass", 387}, {"tyre_stiffness", 295200}};

  // Its rides.
  const VirtualRide ride = ride_of(with_truth(shipped, of_shipped)),
                    same = ride_of(with_truth(own, of_own));
  REQUIRE(same.truth.channels.size() == ride.truth.channels.size());
  for (std::size_t c = 0; c < ride.truth.channels.size(); ++c) {
    if (ride.truth.channels[c].name != "road")
      CHECK(same.truth.channels[c].name == ride.truth.channels[c].name);
    CHECK(furthest_share(ride.truth.channels[c].samples, same.truth.channels[c].samples) < 1e-10);
  }

  // What is found in it, by a law that is not the damper's.
  const std::vector<PlantRecording> recordings = {recording_of(ride.recorded)};
  const InPlantOptions options{.starts = 2, .iterations = 10, .threads = 1, .grade = ""};
  const Law& law = find_law("tanh_kwok");
  const InPlantReport by_shipped = identify_in_plant(law, shipped, recordings, options),
                      by_own = identify_in_plant(law, own, recordings, options);
  REQUIRE(by_own.has_models());
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK_CLOSE(by_own.plant[k].value, by_shipped.plant[k].value, 1e-5, 0);
    CHECK_CLOSE(by_own.plant[k].high, by_shipped.plant[k].high, 1e-4, 0);
  }
  CHECK_CLOSE(by_own.plant[0].value, 387, 0.05, 0);

  // And what the observer sees in it.
  ObserveOptions watching;
  watching.force = {{28, 0.005}, {20, 0.3}};
  const auto force = [&](const InPlantSetup& setup, const InPlantReport& report) {
    return observe(by_shipped.kinds.front().model, by_shipped.kinds.front().domain,
                   as_found(setup, report), recordings, watching)
        .recordings[0]
        .quantities[0]
        .value;
  };
  CHECK(furthest_share(force(shipped, by_shipped), force(own, by_own)) < 1e-4);
}

TEST_CASE("a plant of matrices: a chain that no shipped plant is, its damper over two springs" *
          doctest::test_suite("long")) {
  const InPlantSetup setup = parse_in_plant_setup(
      "plant: matrices\n"
      "coordinates: [x1, x2, x3]\n"
      "parameters:\n"
      "  m2: {about: 6 kg}\n"
      "  k1: {about: 15 kN/m}\n"
      "  k2: {about: 10 kN/m, from: 1 kN/m, to: 100 kN/m}\n"
      "  k3: 8..18 kN/m\n"
      "  c: 6\n"
      "mass: [[10 kg, 0, 0], [0, m2, 0], [0, 0, 6000 g]]\n"
      "damping: [[2*c, -c, 0], [-c, 2*c, -c], [0, -c, c]]\n"
      "stiffness: [[k1 + k2, -k2, 0], [-k2, k2 + k3, -k3], [0, -k3, k3]]\n"
      "damper: {from: x1, to: x3}\n"
      "inputs: [{channel: push, kind: force, at: x2}]\n"
      "sensors:\n"
      "  - {channel: a1, quantity: acceleration, at: x1}\n"
      "  - {channel: a2, quantity: acceleration, at: x2}\n"
      "  - {channel: a3, quantity: acceleration, at: x3}\n",
      "chain.yaml");
  const InPlantReport report =
      identify_in_plant(find_law("tanh_kwok"), setup, {pushed_chain()}, {.starts = 2, .grade = ""});
  REQUIRE(report.has_models());
  const double truths[] = {4, 20e3, 8e3, 12e3};
  for (std::size_t k = 0; k < 4; ++k) {
    CAPTURE(report.plant[k].name);
    CHECK_CLOSE(report.plant[k].value, truths[k], 0.03, 0);
  }
  CHECK(report.plant[0].unit == "kg");
  CHECK(report.plant[1].unit == "N/m");
  CHECK(report.plant[1].meaning == "in the stiffness matrix");
}

TEST_CASE("a plant of matrices: angles, several dampers, and the same once it was written") {
  // The shipped half car, whose corners are levers of the pitch.
  const std::string text =
      "plant: matrices\n"
      "coordinates: [body, {name: pitch, unit: rad}, front_wheel, rear_wheel]\n"
      "parameters: {m: 690 kg, kf: 17 kN/m, kr: 22 kN/m, j: {about: 1222 kg*m^2}}\n"
      "mass: [[m, 0, 0, 0], [0, j, 0, 0], [0, 0, 40 kg, 0], [0, 0, 0, 45 kg]]\n"
      "stiffness:\n"
      "  - [kf + kr, -1.3*kf + 1.5 kr, -kf, -kr]\n"
      "  - [-1.3*kf + 1.5*kr, 1.69*kf + 2.25*kr, 1.3*kf, -1.5*kr]\n"
      "  - [-kf, 1.3*kf, kf + 200 kN/m, 0]\n"
      "  - [-kr, -1.5*kr, 0, kr + 200000]\n"
      "ground:\n"
      "  - {name: front, at: front_wheel, stiffness: 200 N/mm}\n"
      "  - {name: rear, at: rear_wheel, stiffness: 2e5, behind: 2.8 m}\n"
      "dampers:\n"
      "  - {name: front, from: front_wheel, to: {body: 1, pitch: -1.3 m}}\n"
      "  - {name: rear, from: rear_wheel, to: {body: 1, pitch: 1.5}}\n"
      "inputs:\n"
      "  - {channel: road_front, kind: ground, at: front}\n"
      "  - {channel: road_rear, kind: ground, at: rear}\n"
      "sensors:\n"
      "  - {channel: rate, quantity: velocity, at: pitch, noise: 0.3 deg/s}\n"
      "  - {channel: level, quantity: deflection, at: rear}\n";
  const InPlantSetup setup = parse_in_plant_setup(text, "half.yaml");
  const Plant own = make_plant(*setup.model, setup.known),
              shipped = make_plant(find_plant_model("half_car"), {});
  for (std::size_t k = 0; k < 16; ++k) {
    CHECK_CLOSE(own.mass[k], shipped.mass[k], 1e-12, 0);
    CHECK_CLOSE(own.stiffness[k], shipped.stiffness[k], 1e-12, 1e-9);
  }
  REQUIRE(own.tyres.size() == 2);
  CHECK(own.tyres[1].stiffness == 2e5);
  CHECK(own.tyres[1].behind == 2.8);
  REQUIRE(own.struts.size() == 2);
  CHECK(own.struts[0].row == shipped.struts[0].row);
  CHECK(own.struts[1].row == shipped.struts[1].row);
  CHECK(setup.inputs[1].place.tyre == 1);
  CHECK(setup.unknown[0].lower == 1.222);

  // Written and read again.
  const std::string written = format_json(to_json(setup));
  const InPlantSetup again = parse_in_plant_setup(written, "again.json");
  CHECK(format_json(to_json(again)) == written);
  CHECK(make_plant(*again.model, again.known).stiffness == own.stiffness);

  // A building that its ground shakes, with a damper under it.
  const InPlantSetup shaken = parse_in_plant_setup(
      "plant: matrices\ncoordinates: [floor, roof]\nmass: [[100, 0], [0, 80]]\n"
      "stiffness: [[3e5, -1e5], [-1e5, 1e5]]\nshaken: [floor, roof]\n"
      "damper: {from: ground, to: floor}\n"
      "inputs: [{channel: ag, kind: ground_acceleration}]\n"
      "sensors: [{channel: a, quantity: acceleration, at: roof}]\n",
      "building.yaml");
  CHECK(make_plant(*shaken.model, {}).ground == std::vector<double>{1, 1});
}

TEST_CASE("a plant of matrices: what is wrong is named with what would be right") {
  const auto wrong = [](const std::string& old, const std::string& other) {
    return refusal_of(car_with(old, other));
  };
  CHECK(refusal_of(kCarOfMatrices).empty());

  // The shape of the matrices.
  CHECK(contains(wrong("mass: [[ms, 0], [0, 139.5 kg]]", "mass: [[ms, 0]]"),
                 "has 1 rows; 2, one per coordinate"));
  CHECK(contains(wrong("[-ks, ks + kt]", "[-ks]"), "has 1 numbers; 2, one per coordinate"));
  CHECK(contains(wrong("[-ks, ks + kt]", "[-2*ks, ks + kt]"),
                 "is not symmetric: row 2, column 1 differs from row 1, column 2"));
  CHECK(contains(wrong("mass: [[ms, 0], [0, 139.5 kg]]\n", ""), "mass"));

  // What no structure is.
  CHECK(contains(wrong("[0, 139.5 kg]", "[0, 0]"), "rig.yaml, mass: is not positive definite"));
  CHECK(contains(wrong("[[ks, -ks], [-ks, ks + kt]]", "[[ks, -2*ks], [-2*ks, ks + kt]]"),
                 "rig.yaml, stiffness: is not positive semi-definite"));
  CHECK(contains(wrong("ks + kt]]", "ks]]"), "stiffness: is not positive semi-definite without"));
  CHECK(
      contains(wrong("139.5 kg", "900 kg - 2*ms"), " at ms = 500 kg; every motion has an energy"));

  // Entries.
  CHECK(contains(wrong("ks + kt]", "ks + k]"), "'k' is no parameter of this plant; did you mean"));
  CHECK(contains(wrong("139.5 kg", "139.5 mm"), "'mm' is not a unit of it; it is counted in kg"));
  CHECK(contains(wrong("139.5 kg", "139.5 + "), "cannot read '+'"));
  CHECK(contains(wrong("139.5 kg", "139.5 kg + ks"), "ks stands in the mass and in the stiffness"));
  CHECK(contains(wrong("ks: 37.3 N/mm", "ks: 37.3 N/mm, kk: 1"),
                 "rig.yaml, parameters, kk: stands in no matrix"));
  CHECK(contains(wrong("ks: 37.3 N/mm", "ks: 37.3 kg"), "it is counted in N/m"));
  CHECK(contains(wrong("{about: 250 kN/m, from: 100 kN/m, to: 600 kN/m}", "unknown"),
                 "kt: is unknown, and nothing says where it is expected; {about: ...} in N/m"));

  // Places.
  CHECK(contains(wrong("from: wheel", "from: weel"), "no coordinate 'weel'; did you mean 'wheel'"));
  CHECK(contains(wrong("from: wheel, to: body", "from: body, to: ground"),
                 "the ground is no coordinate; from: ground, to: the coordinate"));
  CHECK(contains(wrong("from: wheel, to: body", "from: body, to: body"), "at one place"));
  CHECK(contains(wrong("name: suspension", "name: body"), "'body' cannot be its name"));
  CHECK(contains(wrong("damper: {name: suspension, from: wheel, to: body}\n", ""),
                 "rig.yaml, damper: says not where the damper is"));
  CHECK(contains(wrong("[body, wheel]", "[body, ground]"), "'ground' is no name of a coordinate"));
  CHECK(contains(wrong("[body, wheel]", "[body, body]"), "'body' stands twice"));
  CHECK(contains(wrong("ground: [{at: wheel, stiffness: kt, damping: 300}]\n", ""),
                 "has no tyre on the ground"));
  CHECK(contains(wrong("stiffness: kt, damping", "stiffness: -5 N/m, damping"),
                 "rig.yaml, ground: stiffness is below 0"));
  CHECK(contains(wrong("ground: [", "shaken: [body]\nground: ["), "both a ground that moves"));
  CHECK(contains(message_of([] { read_in_plant_setup("matrices,mass=2"); }),
                 "a plant of matrices does not fit on a line; a file"));
}
