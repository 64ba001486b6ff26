#include "dashpot/machine/build_in_plant.h"

#include <cmath>
#include <numeric>

#include "damper/kinds/family/example_family.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/virtual_campaign.h"
#include "design/drawn_family.h"
#include "support.h"

using namespace dashpot;

namespace {

/// rms error of a model's force along the true motion, without its mean.
double force_error(const DamperModel& model, const VirtualRide& ride, double current) {
  const std::vector<double>&x = ride.truth.channel("damper_deflection").samples,
        &v = ride.truth.channel("damper_velocity").samples,
        &force = ride.truth.channel("damper_force").samples;
  std::vector<double> state(model.state_size());
  DamperInput before{x[0], v[0], current};
  model.rest(before, state);
  double sum = 0, squares = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const DamperInput now{x[k], v[k], current};
    model.advance(before, now, ride.truth.sample_time, state);
    const double error = model.force(now, state) - force[k];
    sum += error;
    squares += error * error;
    before = now;
  }
  const double count = static_cast<double>(x.size());
  return std::sqrt(squares / count - sum * sum / (count * count));
}

/// A pushed mass of 80 kg on 30 N/mm.
constexpr const char* kPushed = R"(
plant: oscillator
parameters:
  mass: {about: 60 kg, from: 20 kg, to: 200 kg}
  stiffness: 30 N/mm
inputs:
  - {channel: push, kind: force, at: mass}
sensors:
  - {channel: x, quantity: displacement, at: mass, noise: 0.02 mm}
  - {channel: a, quantity: acceleration, at: mass, noise: 0.05}
current: 0.5 A
skip: 0.1 s
)";

VirtualRide pushed(const DamperModel& damper, double current, std::uint64_t seed) {
  InPlantSetup setup = parse_in_plant_setup(kPushed, "pushed");
  setup.known.emplace_back("mass", 80);
  setup.unknown.clear();
  return virtual_campaign(
             setup, damper,
             {.duration = 6, .sample_rate = 250, .levels = {current}, .push = 400, .seed = seed})
      .front();
}

}  // namespace

// The truth is exact plate flow behind a column of fluid, with Coulomb friction, which no family
// has; its builds differ, and this one is 15 % weaker than drawn.
TEST_CASE("in plant: a drive at one current makes a build's other currents its own" *
          doctest::test_suite("long")) {
  DrawnFamily family{.scatter = 0.06, .tests = {}};
  for (const SineMotion motion : {SineMotion{20e-3, 0.6}, SineMotion{8e-3, 6}})
    for (const double current : {0., 0.5, 1.5}) family.tests.push_back({motion, current});
  std::vector<Record> records;
  Random random(5);
  for (const DamperDescription& drawing : random_drawings(drawn_family_request(), 8, 5))
    for (Record& one : recorded_drawing(family, drawing, random)) records.push_back(std::move(one));

  DamperDescription drawing = drawn_family_request().damper;
  drawing.gap = 1.3e-3;
  drawing.bore_diameter = 33e-3;
  drawing.pole_length = 9e-3;
  drawing.fluid = find_fluid("140CG", "test");
  const DrawnDamper weak(drawing, {.strength = 0.85, .friction = 15, .stiffness = 2e6}, 1.5);
  const auto mean = fitted_drawings(records)->with_member(member_of(drawing, 1.5));

  const VirtualRide ride = pushed(weak, 0.5, 1);
  const BuildInPlant told = identify_build_in_plant(*mean, parse_in_plant_setup(kPushed, "pushed"),
                                                    {{.name = "drive",
                                                      .sample_time = ride.recorded.sample_time,
                                                      .samples = ride.recorded.time.size(),
                                                      .channels = ride.recorded.channels}},
                                                    {.grade = ""});
  REQUIRE(told.found.has_models());
  REQUIRE(told.found.plant.size() == 1);
  CHECK_CLOSE(told.found.plant[0].value, 80, 0.02, 0);
  CHECK(told.found.sensors[0].held_back < told.mean.sensors[0].held_back);

  // On another push, at currents that the drive did not have.
  for (const double current : {0., 0.5, 1.5}) {
    const VirtualRide other = pushed(weak, current, 99);
    CAPTURE(current);
    CAPTURE(force_error(*mean, other, current));
    CHECK(force_error(*told.found.kinds.front().model, other, current) <
          0.85 * force_error(*mean, other, current));
  }
}

TEST_CASE("in plant: a build that cannot be found is refused with what could") {
  const InPlantSetup setup = parse_in_plant_setup(kPushed, "pushed");
  const auto refused = [](const FamilyModel& member, const InPlantSetup& plant) {
    return message_of([&] { require_build_for_plant(member, plant, "car.yaml"); });
  };
  CHECK(contains(refused(example_family(), setup), "does not know how builds of a drawing differ"));

  Family knows = example_family_physics().family();
  FamilyPhysics physics = static_cast<const PhysicsFamily&>(*knows.force).physics();
  physics.record_error = 0.05;
  knows.force = std::make_shared<PhysicsFamily>(physics);
  const FamilyModel member(std::make_shared<Family>(knows), example_member());
  CHECK(refused(member, setup).empty());
  InPlantSetup other = setup;
  other.inputs[0].road = RoadPrior{};
  CHECK(contains(refused(member, other), "a build is found on a road that is measured alone"));
  other = setup;
  other.model = &find_machine("half_car", "test");
  other.known.clear();
  CHECK(contains(refused(member, other), "has 2 dampers"));
  other = setup;
  other.drive_unit = DriveUnit::Volt;
  CHECK(contains(refused(member, other), "families are of dampers that take A"));
  FamilyMember strong = example_member();
  strong.build = 1;
  CHECK(contains(refused(FamilyModel(std::make_shared<Family>(knows), strong), setup),
                 "leave 'build' out"));
}
