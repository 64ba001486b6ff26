#include <set>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "dashpot/model_file.h"
#include "dashpot/suspension/sweep/draw.h"
#include "dashpot/suspension/sweep/request_file.h"
#include "support.h"

using namespace dashpot;

namespace {

const std::string kBase =
    "plant: savaresi_spelta\n"
    "dampers: \"ideal,damping_min=300,damping_max=3900\"\n"
    "controllers:\n"
    "  passive: {dampers: \"viscous,damping=1500\"}\n"
    "  mix1: {controller: \"mix1,crossover=1.9Hz\"}\n"
    "road: \"iso8608_fft,class=C\"\n";

SweepRequest parsed(const std::string& more, const std::string& base = kBase) {
  return parse_sweep(base + more, "test.yaml");
}

/// Places of values between 0 and 1, in `cells` equal cells.
std::set<int> cells_of(const std::vector<double>& shares, int cells) {
  std::set<int> found;
  for (const double share : shares) found.insert(static_cast<int>(share * cells));
  return found;
}

}  // namespace

TEST_CASE("the requests that come with Dashpot can be read, and their first vehicles made") {
  REQUIRE(!sweep_names().empty());
  for (const std::string& name : sweep_names()) {
    CAPTURE(name);
    const SweepRequest request = named_sweep(name);
    const SweepDraw draw = draw_vehicle(request, 0);
    CHECK(draw.values.size() == request.inputs.size());
    for (std::size_t c = 0; c < request.controllers.size(); ++c)
      CHECK(!make_vehicle(vehicle_words(request, c, draw)).dampers.empty());
  }
  CHECK(message_of([] { named_sweep("comfrt"); }).find("did you mean 'comfort'") !=
        std::string::npos);
}

TEST_CASE("a request's words become vehicles and roads") {
  const SweepRequest request = parsed(
      "samples: 10\nseed: 7\nsensors: {delay: 2 ms}\n"
      "vary:\n  sprung_mass: [350 kg]\n  damper.damping: [1200]\n  mix1.crossover: [2.5 Hz]\n"
      "grid:\n  road.class: [A, B]\n  road.speed: [36 km/h, 72 km/h]\n");
  CHECK(request.grid_size() == 4);
  CHECK(request.vehicles() == 40);
  CHECK(request.controllers[request.baseline].name == "passive");
  const SweepDraw draw = draw_vehicle(request, 3);
  const VehicleWords passive = vehicle_words(request, 0, draw),
                     mix1 = vehicle_words(request, 1, draw);
  CHECK(passive.values == std::vector<std::string>{"sprung_mass=350"});
  CHECK(passive.dampers.front() == "viscous,damping=1200");
  CHECK(mix1.dampers.front() == "ideal,damping_min=300,damping_max=3900");
  CHECK(mix1.controller == "mix1,crossover=2.5");
  CHECK(mix1.sensors.in_car);
  CHECK(mix1.sensors.delay == 0.002);
  CHECK(road_words(request, draw) == "iso8608_fft,class=B,speed=20,length=630");
  CHECK(make_vehicle(mix1).set.plant.mass[0] == 350);
}

TEST_CASE(
    "a class that is drawn takes the place of the road's roughness, and the other way round") {
  const auto road = [](const std::string& stated, const std::string& varied) {
    SweepRequest request = parsed("vary:\n  " + varied + "\n");
    request.road = stated;
    return road_words(request, draw_vehicle(request, 0));
  };
  CHECK(road("iso8608_fft,roughness=1e-5,length=50", "road.class: [B]") ==
        "iso8608_fft,length=50,class=B");
  CHECK(road("iso8608_fft,class=C,length=50", "road.roughness: [1e-5]") ==
        "iso8608_fft,length=50,roughness=1e-05");
}

TEST_CASE("the force of a model file scatters as it is built, and so does the lag of its coil") {
  const TemporaryFolder folder;
  const LawModel model = LawModel::constant(find_law("tanh_kwok"), {2000, 1000, 500, 20, 0, 0});
  save_model({.model = model.with_offset(0), .domain = {-0.1, 0.1, -1, 1, 0, 1}},
             folder.path() / "damper.json");
  const SweepRequest request = parse_sweep(
      "plant: savaresi_spelta\ndampers: \"./damper.json,motion_ratio=0.8\"\nroad: "
      "iso8608_fft\nsamples: 50\n"
      "vary:\n  damper.force_factor: {lognormal: 1, sd: 8 %}\n  lag_rate: {normal: 200, sd: 10 "
      "%}\n",
      "test.yaml", folder.path());
  std::set<double> factors;
  for (std::size_t k = 0; k < 50; ++k) {
    const Vehicle vehicle = make_vehicle(vehicle_words(request, 0, draw_vehicle(request, k)));
    factors.insert(vehicle.dampers[0].force_factor);
    CHECK(vehicle.dampers[0].motion_ratio == 0.8);
    CHECK_CLOSE(vehicle.dampers[0].driver.lag_rate, 200, 0.4, 0);
  }
  CHECK(factors.size() == 50);
  CHECK_CLOSE(*std::next(factors.begin(), 25), 1, 0.03, 0);  // the median
  CHECK_CLOSE(*factors.begin(), 1 / *factors.rbegin(), 0.1, 0);
}

TEST_CASE("a vehicle depends on the seed and its number alone") {
  const std::string vary = "vary:\n  sprung_mass: {uniform: [300, 500]}\n";
  for (const std::string drawing : {"sobol", "plain"}) {
    CAPTURE(drawing);
    const std::string how = "drawing: " + drawing + "\n";
    const SweepRequest few = parsed(how + "samples: 5\n" + vary),
                       many = parsed(how + "samples: 500\n" + vary);
    const SweepRequest other = parsed(how + "seed: 2\n" + vary);
    CHECK(draw_vehicle(few, 4).values == draw_vehicle(many, 4).values);
    CHECK(draw_vehicle(few, 4).road_seed == draw_vehicle(many, 4).road_seed);
    CHECK(draw_vehicle(few, 4).values != draw_vehicle(other, 4).values);
    CHECK(draw_vehicle(few, 4).road_seed != draw_vehicle(other, 4).road_seed);
    // One more input does not move those before it.
    const SweepRequest more = parsed(how + vary + "  tyre_stiffness: {uniform: [1e5, 3e5]}\n");
    CHECK(draw_vehicle(more, 9).values[0] == draw_vehicle(many, 9).values[0]);
  }
}

TEST_CASE("Sobol's points fill every cell once, whatever the seed") {
  const SweepRequest request = parsed(
      "seed: 42\nvary:\n  sprung_mass: {uniform: [300, 500]}\n  tyre_stiffness: {uniform: [1e5, "
      "2e5]}\n");
  std::vector<double> mass, tyre;
  for (std::size_t k = 0; k < 64; ++k) {
    const SweepDraw draw = draw_vehicle(request, k);
    mass.push_back((draw.values[0] - 300) / 200);
    tyre.push_back((draw.values[1] - 1e5) / 1e5);
  }
  // 64 points less the origin, which the sequence leaves out and the next one takes the place of.
  CHECK(cells_of(mass, 64).size() >= 63);
  CHECK(cells_of(tyre, 64).size() >= 63);
}

TEST_CASE("every place of a grid has the same samples, on the same roads") {
  const SweepRequest request = parsed(
      "samples: 3\nvary:\n  sprung_mass: {uniform: [300, 500]}\ngrid:\n  road.class: [A, C, E]\n");
  for (std::size_t sample = 0; sample < 3; ++sample) {
    const SweepDraw first = draw_vehicle(request, 3 * sample);
    for (std::size_t place = 0; place < 3; ++place) {
      const SweepDraw draw = draw_vehicle(request, 3 * sample + place);
      CHECK(draw.values[0] == first.values[0]);
      CHECK(draw.road_seed == first.road_seed);
      CHECK(draw.values[1] == static_cast<double>(place));
    }
  }
  const SweepRequest one_road = parsed("road_seed: 12\nsamples: 3\n");
  CHECK(draw_vehicle(one_road, 2).road_seed == 12);
  const SweepRequest listed = parsed("grid:\n  road.seed: [5, 6]\n");
  CHECK(draw_vehicle(listed, 1).road_seed == 6);
}

TEST_CASE(
    "a request that cannot be understood is refused with file, line and what would be right") {
  const std::pair<std::string, std::string> cases[] = {
      {"sampels: 5\n", "test.yaml:7: a sweep has an unknown key 'sampels'"},
      {"samples: 0\n", "samples is 0; between 1 and"},
      {"samples: 1.5\n", "samples is 1.5; a whole number"},
      {"drawing: halton\n", "unknown drawing 'halton'"},
      {"baseline: pasive\n", "no controller is called 'pasive'; did you mean 'passive'"},
      {"duration: 3 s\n",
       "nothing is left of 3 s when 5 s are discarded; a longer 'duration', or a"},
      {"duration: 3 kg\n", "'kg' is not a unit of it; it is counted in s"},
      {"sensors: perfect\n", "unknown sensors 'perfect'"},
      {"vary:\n  sprung_mas: [350 kg]\n",
       "test.yaml:8: nothing of a vehicle is known as 'sprung_mas'; did you mean 'sprung_mass'"},
      {"vary:\n  sprung_mass: [-350 kg]\n", "sprung_mass is -350 kg; between 1 and 1e+06 kg"},
      {"vary:\n  road.sped: [10]\n", "iso8608_fft has no parameter 'sped'; did you mean 'speed'"},
      {"vary:\n  road.class: [I]\n", "unknown class 'I' of roads; A (smooth) to H"},
      {"vary:\n  damper.dampign: [10]\n", "did you mean 'damper.damping'"},
      {"vary:\n  mix1.corner: [10]\n", "mix1 has no parameter 'corner'"},
      {"vary:\n  passive.crossover: [10]\n",
       "'passive' has no controller whose 'crossover' could vary"},
      {"vary:\n  mix2.crossover: [10]\n", "nothing here is called 'mix2'; did you mean 'mix1'"},
      {"vary:\n  current: [1 A]\ngrid:\n  current: [1 A]\n", "current varies twice"},
      {"vary:\n  road.class: [A]\n  road.roughness: [1e-6]\n",
       "both road.class and road.roughness vary"}};
  for (const auto& [more, part] : cases) {
    const std::string message = message_of([&] { parsed(more); });
    CAPTURE(message);
    CHECK_MESSAGE(message.find(part) != std::string::npos, part);
  }
  CHECK(message_of([] { parsed("", "road: sine\n"); }).find("'plant'") != std::string::npos);
  CHECK(message_of([] {
          parsed("controllers: {road: {}}\n", "plant: savaresi_spelta\nroad: sine\n");
        }).find("'road' cannot be the name of a controller") != std::string::npos);

  // What a controller states for itself and does not use; above them all it is for the others.
  const std::string car = "plant: savaresi_spelta\nroad: sine\ndampers: kwok2006\n";
  const std::pair<std::string, std::string> idle[] = {
      {"{controller: skyhook, current: 1}", "current is where there is no controller"},
      {"{sensors: in_car}", "sensors serves a controller"},
      {"{inverse: numeric}", "inverse serves a controller"}};
  for (const auto& [words, part] : idle) {
    const std::string message =
        message_of([&] { parsed("controllers:\n  a: " + words + "\n", car); });
    CAPTURE(message);
    CHECK(message.starts_with("test.yaml:5"));
    CHECK_MESSAGE(message.find(part) != std::string::npos, part);
  }
  CHECK(parsed("controllers: {a: {}, b: {controller: skyhook}}\n",
               car + "current: 1\nsensors: in_car\ninverse: numeric\n")
            .controllers.size() == 2);
}
