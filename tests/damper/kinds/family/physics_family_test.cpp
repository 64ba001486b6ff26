#include "dashpot/damper/kinds/family/physics_family.h"

#include <cmath>
#include <numbers>

#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/model_file.h"
#include "dashpot/physics/plate_flow.h"
#include "example_family.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Physics as it stands in books: nothing learnt, no rounding, stiff springs.
FamilyPhysics book_physics() {
  FamilyPhysics physics;
  physics.numbers = FamilyPhysics::priors();
  physics.numbers[kYieldShare] = physics.numbers[kRoundness] = 0;
  physics.numbers[kSealForce] = std::log(15.);
  physics.numbers[kSealGive] = -6;
  physics.numbers[kStiffness] = 8;
  physics.numbers[kOnset] = -5;
  physics.reference = {.piston_area = 1.6e-4,
                       .gap_area = 2.5e-5,
                       .gap = 1.2e-3,
                       .pole_length = 8e-3,
                       .viscosity = 0.1,
                       .yield_stress = 2e4,
                       .current = 0.5,
                       .force = 1,
                       .speed = 0.02,
                       .stroke = 1e-3};
  return physics;
}

FamilyModel physics_model(const FamilyPhysics& physics,
                          const FamilyMember& member = example_member()) {
  Family family = family_of(std::make_shared<PhysicsFamily>(physics));
  family.name = "family_physics";
  family.build_spread = 0;
  return {std::make_shared<Family>(family), member};
}

double steady_force(const FamilyModel& model, double v, double i) {
  std::vector<double> state(model.state_size());
  const DamperInput input{0, v, i};
  model.rest(input, state);
  for (int k = 0; k < 5000; ++k) model.advance(input, input, 1e-3, state);
  return model.force(input, state);
}

}  // namespace

TEST_CASE("a family of physics alone has the plate flow's force and the seal's friction") {
  const FamilyMember m = example_member();
  const FamilyModel model = physics_model(book_physics());
  const PlateGap gap{m.pole_length, m.gap_area / m.gap, m.gap};
  for (const double v : {0.05, 0.2, -0.1})
    for (const double i : {0.0, 0.5, 1.0}) {
      const double speed = std::abs(v);
      const double newtonian =
          m.piston_area * plate_newtonian_pressure(&gap, m.viscosity, m.piston_area * speed);
      const double yielding = m.piston_area * plate_yield_pressure(&gap, m.yield.at(i));
      const double wanted = std::copysign(15 + plate_bingham_pressure(newtonian, yielding), v);
      CAPTURE(v);
      CAPTURE(i);
      CHECK_CLOSE(steady_force(model, v, i), wanted, 2e-3, 0);
    }
}

TEST_CASE("the balance of a resistance and its spring is exact to rounding, wherever it lies") {
  Random random(1);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, random.uniform());
  };
  for (int k = 0; k < 2000; ++k) {
    const double yielding = between(1, 1e3), viscous = k % 3 ? between(1, 1e4) : 0;
    const double pull = between(1e-3, 3e3), spring = between(0.1, 1e6);
    const double rest = between(1e-8, 1e-2), own = k % 5 ? between(1e-3, 1) : k % 2;
    const double passive = viscous > 0 && k % 2 ? between(1, 1e4) : 0;
    const auto force_at = [&](double u) {
      const double s = std::sqrt(rest + own * u * u);
      return u * (plate_bingham_pressure(viscous * s, yielding) / s + passive);
    };

    // The same by halving, until nothing is left between the ends.
    double low = 0, high = pull / spring;
    for (int n = 0; n < 200; ++n) {
      const double u = 0.5 * (low + high);
      (force_at(u) + spring * u > pull ? high : low) = u;
    }
    CAPTURE(k);
    const PhysicsSpeed at{rest, own, std::sqrt(rest), std::sqrt(own)};
    CHECK_CLOSE(physics_side(yielding, viscous, passive, 0, pull, spring, &at), force_at(low),
                1e-12, 0);
  }
}

TEST_CASE("gap, area and viscosity act on its force as on that of the plate flow") {
  // The seal is left out of the differences; at rest beyond yielding it is 2 tau L A / h.
  const double v = 1e-3;
  const auto flow = [&](const FamilyMember& member) {
    return steady_force(physics_model(book_physics(), member), v, 1) - 15;
  };
  FamilyMember other = example_member();
  const double force = flow(other);
  other.gap *= 2;
  other.gap_area *= 2;
  CHECK_CLOSE(flow(other), force / 2, 1e-2, 0);
  other = example_member();
  other.piston_area *= 2;
  CHECK_CLOSE(flow(other), force * 2, 1e-2, 0);
}

TEST_CASE("whatever sets its resistances, a closed cycle takes energy out") {
  // Corrections, rounding and asymmetry of any size, and a current that jumps amid the motion.
  FamilyPhysics physics = book_physics();
  for (const double roundness : {0.0, 0.5, 1.0}) {
    physics.numbers[kRoundness] = roundness;
    physics.numbers[kAsymmetry] = 0.4;
    physics.numbers[kStiffness] = 1;
    physics.numbers[kSealGive] = 0;
    physics.numbers[kGapOfYield] = -2;
    const FamilyModel model = physics_model(physics);
    std::vector<double> state(model.state_size());
    DamperInput now{0, 0, 0};
    model.rest(now, state);
    double work = 0, force = model.force(now, state);
    const double dt = 1e-3;
    for (int k = 1; k <= 20000; ++k) {
      const double t = k * dt;
      const DamperInput next{0, 0.01 * std::sin(6 * t) + 0.02 * std::sin(17 * t),
                             k / 37 % 2 ? 1.0 : 0.0};
      model.advance(now, next, dt, state);
      const double after = model.force(next, state);
      work += 0.25 * (force + after) * (now.velocity + next.velocity) * dt;
      now = next;
      force = after;
      // What the springs hold is all that it can give back.
      CHECK(work > -1e-6);
    }
    CHECK(work > 0.1);
  }
}

TEST_CASE("steps of any size lead to the same force") {
  FamilyPhysics physics = book_physics();
  physics.numbers[kRoundness] = 0.7;
  physics.numbers[kStiffness] = 1;
  const auto end = [&](int steps) {
    const FamilyModel model = physics_model(physics);
    std::vector<double> state(model.state_size());
    DamperInput now{0, 0, 1};
    for (int k = 1; k <= steps; ++k) {
      const double t = 1.3 * k / steps;
      const DamperInput next{0, 0.05 * std::sin(9 * t), 1};
      model.advance(now, next, 1.3 / steps, state);
      now = next;
    }
    return model.force(now, state);
  };
  const double fine = end(20000);
  CHECK_CLOSE(end(400), fine, 2e-3, 0);
  CHECK(std::abs(end(800) - fine) < 0.5 * std::abs(end(200) - fine));
}

TEST_CASE("the force grows with the current and is odd in the velocity") {
  FamilyPhysics physics = book_physics();
  physics.numbers[kFieldExponent] = 0.4;
  physics.numbers[kSealGain] = 0.5;
  const FamilyModel model = physics_model(physics);
  double last = 0;
  for (const double i : {0.0, 0.1, 0.3, 0.6, 1.0, 5.0}) {
    const double force = steady_force(model, 0.03, i);
    CHECK(force > last);
    CHECK_CLOSE(steady_force(model, -0.03, i), -force, 1e-9, 0);
    last = force;
  }
}

TEST_CASE("a family of physics is the same after its file, and refuses numbers beyond their ends") {
  FamilyPhysics physics = book_physics();
  physics.deviation = {0.1, -0.2, 0.05, 0.3};
  const FamilyModel model = physics_model(physics);
  ModelFile file;
  file.model = model.with_offset(0);
  const std::string text = format_model(file);
  CHECK(format_model(parse_model(text, "text")) == text);
  physics.numbers[kAsymmetry] = 0.9;
  CHECK(contains(message_of([&] { PhysicsFamily{physics, "here"}; }), "asymmetry is beyond"));
}
