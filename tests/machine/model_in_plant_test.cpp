#include "dashpot/machine/model_in_plant.h"

#include <cmath>
#include <numbers>

#include "dashpot/base/random.h"
#include "dashpot/machine/in_plant.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A pushed mass of 2 kg on 4 N/mm beside a spring that yields (30 N, 20 N/mm) and a dashpot, by a
/// symplectic method in steps of 10 us: of no structure that a model here has. 400 Hz.
PlantRecording pushed_on_yielding_spring(double seconds) {
  constexpr double kStep = 1e-5;
  constexpr int kEvery = 250;
  PlantRecording recording{.name = "pushed", .sample_time = kStep * kEvery, .channels = {}};
  recording.channels = {{.name = "push", .unit = "N", .samples = {}, .origin = {}},
                        {.name = "x", .unit = "m", .samples = {}, .origin = {}},
                        {.name = "a", .unit = "m/s^2", .samples = {}, .origin = {}}};
  Random random(7);
  double x = 0, v = 0, spring = 0;
  for (int k = 0; k < static_cast<int>(seconds / kStep); ++k) {
    double push = 0;
    for (int n = 1; n <= 12; ++n)
      push += 14 * std::cos(2 * std::numbers::pi * 1.3 * n * kStep * k + 0.7 * n * n);
    const double acceleration = (push - 4000 * x - 25 * v - spring) / 2;
    if (k % kEvery == 0) {
      recording.channels[0].samples.push_back(push);
      recording.channels[1].samples.push_back(x + 2e-5 * random.normal());
      recording.channels[2].samples.push_back(acceleration + 0.05 * random.normal());
    }
    v += kStep * acceleration;
    x += kStep * v;
    spring = std::clamp(spring + kStep * 2e4 * v, -30.0, 30.0);
  }
  recording.samples = recording.channels[0].samples.size();
  return recording;
}

InPlantSetup pushed_setup() {
  InPlantSetup setup;
  setup.model = &find_machine("oscillator", "test");
  setup.known = {{"stiffness", 4000}, {"mass", 2}};
  setup.inputs = {{"push", {PlantInput::Force, 0}}};
  setup.sensors = {{.channel = "x", .place = {PlantQuantity::Displacement, 0}},
                   {.channel = "a", .place = {PlantQuantity::Acceleration, 0}}};
  setup.skip = 0.1;
  return setup;
}

InPlantOptions quick_options() {
  InPlantOptions options{.starts = 2, .grade = ""};
  options.network.members = 1;
  options.network.epochs = 120;
  return options;
}

}  // namespace

TEST_CASE(
    "in plant: a passive network in an oscillator leaves less than the law that it learnt along" *
    doctest::test_suite("long")) {
  const std::vector<std::string> models{"passive_network"};
  const std::vector<InPlantFit> fits =
      identify_in_plant(models, pushed_setup(), {pushed_on_yielding_spring(5)}, quick_options());
  REQUIRE(fits.size() == 2);
  CHECK(fits[0].model == kLawBeforeModels);
  CHECK_FALSE(fits[0].was_asked_for);
  const InPlantReport &law = fits[0].report, &network = fits[1].report;
  REQUIRE(network.has_models());
  CHECK(network.along == kLawBeforeModels);

  // On the time that no fit has seen, at either sensor; the law has no memory.
  for (std::size_t s = 0; s < 2; ++s) {
    CAPTURE(law.sensors[s].held_back);
    CAPTURE(network.sensors[s].held_back);
    CHECK(network.sensors[s].held_back < 0.7 * law.sensors[s].held_back);
  }
}

TEST_CASE("in plant: a hybrid and a bank beside a law, along which they learn" *
          doctest::test_suite("long")) {
  const PlantRecording ride = pushed_on_yielding_spring(3);
  const std::vector<std::string> models{"hysteresis_network", "viscous_dahl", "dahl+network"};
  InPlantSetup setup = pushed_setup();
  setup.known = {{"stiffness", 4000}};
  setup.unknown = {{"mass", 0.5, 8, 1.6}};
  const std::vector<InPlantFit> fits = identify_in_plant(models, setup, {ride}, quick_options());
  CHECK(has_interval(fits[0].report.plant[0]));
  REQUIRE(fits.size() == 3);
  CHECK(fits[0].model == "viscous_dahl");
  for (const std::size_t k : {1u, 2u}) {
    CAPTURE(fits[k].model);
    CAPTURE(fits[k].report.message);
    REQUIRE(fits[k].report.has_models());
    CHECK(fits[k].report.along == "viscous_dahl");
    CHECK(fits[k].report.sensors[0].held_back < 0.3 * fits[k].report.sensors[0].rms);

    // The plant's numbers are told without intervals.
    REQUIRE(fits[k].report.plant.size() == 1);
    CAPTURE(fits[0].report.plant[0].value);
    CHECK_CLOSE(fits[k].report.plant[0].value, 2, 0.05, 0);
    CHECK_FALSE(has_interval(fits[k].report.plant[0]));
  }
}

TEST_CASE("in plant: models that cannot stand there are refused with what could") {
  const auto refused = [](const std::string& model, const InPlantSetup& setup) {
    return message_of([&] { require_model_for_plant(model, setup, "--models"); });
  };
  CHECK(contains(refused("family_gated", pushed_setup()),
                 "'family_gated' is a model of many dampers that differ by their drawings"));
  CHECK(contains(refused("mean", pushed_setup()), "is made of models that were fitted to a"));
  CHECK(contains(refused("passive_netwrok", pushed_setup()), "passive_network"));
  InPlantSetup setup = pushed_setup();
  setup.inputs[0].road = RoadPrior{};
  CHECK(contains(refused("passive_network", setup),
                 "laws alone are identified on a road that nothing measures"));
  setup = pushed_setup();
  setup.inputs.push_back({"behind", {PlantInput::Ground, 0}});
  setup.inputs.back().follows = "push";
  CHECK(contains(refused("passive_network", setup),
                 "what makes a bench of the plant, as 'passive_network' needs, knows no road that "
                 "follows"));
}
