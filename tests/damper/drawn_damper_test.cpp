#include "dashpot/damper/drawn_damper.h"

#include <cmath>

#include "dashpot/physics/damper_physics.h"
#include "support.h"

using namespace dashpot;

namespace {

/// The force after half a second at a constant speed, by steps of 0.1 ms.
double steady(const DrawnDamper& damper, double speed, double current) {
  std::vector<double> state(1);
  DamperInput now{0, 0, current};
  damper.rest(now, state);
  for (int k = 1; k <= 5000; ++k) {
    const DamperInput next{speed * k * 1e-4, speed, current};
    damper.advance(now, next, 1e-4, state);
    now = next;
  }
  return damper.force(now, state);
}

}  // namespace

TEST_CASE("a drawn damper comes to the force of its physics, in either direction") {
  for (const char* fluid :
       {"fluid: 132DG\n",
        "fluid: {name: own, density: 3000, viscosity: 0.1, herschel_bulkley: {index: 0.8, "
        "shear_rate: 500}, laws: {carlson: {volume_fraction: 0.3}}}\n"}) {
    const DamperDescription drawing = parse_description(std::string(fluid) + "name: d\n", "d.yaml");
    const DrawnDamper damper(drawing, {.strength = 1.1, .friction = 20, .stiffness = 1e6}, 2);
    for (const double current : {0., 0.5, 2.}) {
      const DamperPhysics p = evaluate_physics(drawing, {.current = current, .velocity = 0.1});
      CHECK_CLOSE(steady(damper, 0.1, current), 1.1 * p.plate_force + 20, 1e-6, 0);
      CHECK_CLOSE(steady(damper, -0.1, current), -1.1 * p.plate_force - 20, 1e-6, 0);
    }
    const DrawnDamper leaning(drawing, {.stiffness = 1e6, .asymmetry = 0.2}, 2);
    CHECK_CLOSE(steady(leaning, 0.1, 1) / steady(leaning, -0.1, 1), -1.2 / 0.8, 1e-6, 0);
  }
}

TEST_CASE("a drawn damper's rates lead to where its steps do") {
  const DamperDescription drawing = parse_description("fluid: 132DG\nname: d\n", "d.yaml");
  const DrawnDamper damper(drawing, {.friction = 20, .stiffness = 1e6, .asymmetry = 0.2}, 2);
  constexpr double kStep = 1e-6;
  for (const double speed : {0.1, -0.1}) {
    const DamperInput input{0, speed, 1};
    std::vector<double> stepped(1), flown(1), rates(1);
    for (int k = 0; k < 3000; ++k) {
      damper.advance(input, input, kStep, stepped);
      CHECK(damper.flow(input, flown, rates) == damper.force(input, flown));
      flown[0] += kStep * rates[0];
    }
    CHECK_CLOSE(flown[0], stepped[0], 1e-3, 0);
  }
}

TEST_CASE("before its fluid yields a drawn damper is its spring; what cannot be built is refused") {
  const DamperDescription drawing = parse_description("name: d\n", "d.yaml");
  const DrawnDamper damper(drawing, {.stiffness = 1e6}, 2);
  std::vector<double> state(1);
  damper.rest({0, 0, 2}, state);
  for (int k = 1; k <= 10; ++k) damper.advance({0, 0.1, 2}, {0, 0.1, 2}, 1e-4, state);
  CHECK_CLOSE(state[0], 1e6 * 0.1 * 10e-4, 1e-9, 0);
  CHECK(message_of([&] { DrawnDamper(drawing, {}, 2); }).find("without a spring") !=
        std::string::npos);
  DamperDescription fixed = drawing;
  fixed.yield_stress = 1e4;
  CHECK(message_of([&] { DrawnDamper(fixed, {.stiffness = 1}, 2); }).find("no current changes") !=
        std::string::npos);
}
