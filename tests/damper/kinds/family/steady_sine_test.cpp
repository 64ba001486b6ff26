#include "dashpot/damper/kinds/family/steady_sine.h"

#include <cmath>
#include <numbers>

#include "dashpot/damper/kinds/family/line_family.h"
#include "example_family.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kHalfTurn = std::numbers::pi;

constexpr int kOfCycle = 200;

/// The forces over the last of so many cycles, which began at rest at phase 0, or beyond 100 the
/// first that is like the one before.
std::vector<double> last_cycle(const FamilyModel& model, const SteadySine& sine, int cycles) {
  constexpr int kLeast = 100;
  constexpr double kLike = 1e-6;
  const double part = 2 * kHalfTurn / kOfCycle;
  std::vector<double> state(model.state_size()), force(kOfCycle);
  model.rest(sine.at(0), state);
  for (int cycle = 0; cycle < cycles; ++cycle) {
    const double before = force[0];
    for (int k = 0; k < kOfCycle; ++k) {
      force[static_cast<std::size_t>(k)] = model.force(sine.at(k * part), state);
      model.advance(sine.at(k * part), sine.at((k + 1) * part), part / sine.rate, state);
    }
    if (cycle > kLeast && std::abs(force[0] - before) <= kLike * std::ranges::max(force)) break;
  }
  return force;
}

double force_settled(const FamilyModel& model, const SteadySine& sine, std::size_t place) {
  const double phase = 2 * kHalfTurn / kOfCycle * static_cast<double>(place);
  std::vector<double> state(model.state_size());
  model.settle(sine, phase, state);
  return model.force(sine.at(phase), state);
}

FamilyModel settling_line() {
  FamilyLine line;
  line.gap = 1e-3;
  line.pole_length = 6e-3;
  line.viscosity = 0.28;
  line.size = {2, 0.2, 0, 0, 0.1, -0.5};
  line.phase = {0.3, 0, 0, 0, 0, 0};
  return {std::make_shared<Family>(family_of(std::make_shared<LineFamily>(line))),
          example_member()};
}

/// Springs of e^stiffness before a flow of e^strength, whose resistance follows a sine's mean speed
/// by so much.
FamilyModel sprung_physics(double stiffness, double strength, double roundness) {
  FamilyPhysics physics;
  physics.reference = {2e-4, 3e-5, 1.2e-3, 8e-3, 0.2, 2e4, 0.5, 15, 0.05, 0.02};
  physics.numbers = FamilyPhysics::priors();
  physics.numbers[kStiffness] = stiffness;
  physics.numbers[kYieldShare] = strength;
  physics.numbers[kRoundness] = roundness;
  physics.numbers[kAsymmetry] = 0.3;
  physics.numbers[kSealForce] = -4;
  return {std::make_shared<Family>(family_of(std::make_shared<PhysicsFamily>(physics))),
          example_member()};
}

const FamilyPhysics& physics_of(const FamilyModel& model) {
  return dynamic_cast<const PhysicsFamily&>(*model.family().force).physics();
}

}  // namespace

TEST_CASE("a settled sine has the force of many cycles, however long they take to forget") {
  // Of other steps, so that what is steep at a turn is there a little later.
  constexpr double kOtherSteps = 0.03;
  std::vector<FamilyModel> models{settling_line(), example_family(), example_family_network()};
  for (const double stiffness : {-3., -1., 1., 5.})
    for (const double roundness : {0., 0.4, 1.})
      models.push_back(sprung_physics(stiffness, -2.3, roundness));
  for (std::size_t k = 0; k < models.size(); ++k)
    for (const SteadySine& sine : {SteadySine{0.02, 0.24, 0.9}, {0.02, 2.5, 0}, {5e-3, 20, 0.5}}) {
      const std::vector<double> force = last_cycle(models[k], sine, 2000);
      const auto [low, high] = std::ranges::minmax(force);
      for (const std::size_t place : {0u, 13u, 60u, 105u, 150u, 199u}) {
        CAPTURE(k);
        CAPTURE(sine.rate);
        CAPTURE(place);
        CHECK_CLOSE(force_settled(models[k], sine, place), force[place], 0,
                    kOtherSteps * std::max(-low, high));
      }
    }
}

TEST_CASE("a settled sine is to 0.1 % what the same steps come to, whichever spring takes long" *
          doctest::test_suite("long")) {
  // The seal's spring takes long where its friction is much and gives far, the flow's where it is
  // weak: each by itself, both and neither.
  constexpr int kSteps = 40;
  constexpr double kPart = 2 * kHalfTurn / kSteps;
  for (const double seal_give : {-3., 2.})
    for (const double stiffness : {-3., 3.})
      for (const double roundness : {0., 0.4, 1.}) {
        FamilyPhysics physics = physics_of(sprung_physics(stiffness, 1, roundness));
        physics.numbers[kSealForce] = 0;
        physics.numbers[kSealGive] = seal_give;
        const FamilyModel model(
            std::make_shared<Family>(family_of(std::make_shared<PhysicsFamily>(physics))),
            example_member());
        for (const SteadySine& sine : {SteadySine{0.02, 0.24, 1}, {0.02, 0.14, 0}, {5e-3, 2, 1}}) {
          CAPTURE(seal_give);
          CAPTURE(stiffness);
          CAPTURE(roundness);
          CAPTURE(sine.rate);
          std::vector<double> state(model.state_size());
          double largest = 0;
          for (int k = 0; k < 3000 * kSteps; ++k) {
            model.advance(sine.at(k % kSteps * kPart), sine.at((k + 1) % kSteps * kPart),
                          kPart / sine.rate, state);
            if (k > 2999 * kSteps) largest = std::max(largest, std::abs(model.force({}, state)));
          }
          CHECK_CLOSE(force_settled(model, sine, 0), model.force(sine.at(0), state), 0,
                      1e-3 * largest);
        }
      }
}

TEST_CASE("a weak spring before a strong resistance: where it began is not told for its force") {
  // A fiftieth of it is forgotten in a cycle, so that three or twelve cycles tell of the beginning.
  const FamilyModel model = sprung_physics(-3, 1, 1);
  const SteadySine sine{0.02, 0.24, 1};
  constexpr std::size_t kPlace = 20;
  const double settled = force_settled(model, sine, kPlace);
  const std::vector<double> many = last_cycle(model, sine, 2000);
  const double swing = std::ranges::max(many) - std::ranges::min(many);
  CHECK_CLOSE(settled, many[kPlace], 0, 0.005 * swing);
  for (const int cycles : {3, 12})
    CHECK(std::abs(last_cycle(model, sine, cycles)[kPlace] - settled) > 0.02 * swing);
}

TEST_CASE("a force that turns within a step is not taken for a spring that has forgotten") {
  // Random request 1139 of the designs: 9.31 N was told for 8.68, and so more than without current.
  FamilyPhysics physics;
  physics.reference = {2e-4, 3e-5, 1.2e-3, 8e-3, 0.2, 2e4, 0.5, 15, 0.05, 0.02};
  physics.numbers = {-2.7284, 1.3881,  -0.6535, -3.1069,  0,       0,
                     0.04584, 3,       -0.5,    0.91521,  -3.3115, 0.76065,
                     0.28132, -0.1025, 3.1248,  -0.44378, 0.98479, -0.72408};
  FamilyMember member = example_member();
  member.piston_area = 3.5436e-4;
  member.yield = {{0, 0.175988}, {2440.53, 12509.68}};
  const FamilyModel model(
      std::make_shared<Family>(family_of(std::make_shared<PhysicsFamily>(physics))), member);
  for (const double current : {0., 0.175988}) {
    const SteadySine sine{0.02, 0.0664327 / 0.02, current};
    CHECK_CLOSE(force_settled(model, sine, 0), last_cycle(model, sine, 2000)[0], 2e-3, 0);
  }
}

TEST_CASE("the cycle that returns is found where each number keeps a share of what it was") {
  // Linear shares at once, 0.9999 among them; a root, which is none, after some more.
  int cycles = 0;
  std::vector<double> state{5, -3, 0.1};
  find_cycle(state, [&](std::span<double> s) {
    ++cycles;
    s[0] = 2 + 0.9999 * (s[0] - 2);
    s[1] = -1 + 0.5 * (s[1] + 1);
    s[2] = std::sqrt(0.5 * (1 + s[2] * s[2] * s[2]));
  });
  CHECK(cycles <= 6);
  CHECK_CLOSE(state[0], 2, 1e-6, 0);
  CHECK_CLOSE(state[1], -1, 1e-6, 0);
  CHECK_CLOSE(state[2] * state[2], 0.5 * (1 + state[2] * state[2] * state[2]), 1e-3, 0);
}
