#include "dashpot/damper/kinds/family/steady_sine.h"

#include <cmath>
#include <numbers>

#include "dashpot/damper/kinds/family/line_family.h"
#include "example_family.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kHalfTurn = std::numbers::pi;

/// The force where a sine passes a phase, from rest and as many cycles later as asked.
double force_after(const FamilyModel& model, const SteadySine& sine, double phase, int cycles) {
  constexpr int kOfCycle = 400;
  const double part = 2 * kHalfTurn / kOfCycle;
  std::vector<double> state(model.state_size());
  model.rest(sine.at(phase), state);
  for (int k = -cycles * kOfCycle; k < 0; ++k)
    model.advance(sine.at(phase + k * part), sine.at(phase + (k + 1) * part), part / sine.rate,
                  state);
  return model.force(sine.at(phase), state);
}

double force_settled(const FamilyModel& model, const SteadySine& sine, double phase) {
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

/// Springs of e^stiffness before the flow, whose resistance follows the speed just past by so much.
FamilyModel sprung_physics(double stiffness, double memory, double asymmetry) {
  FamilyPhysics physics;
  physics.reference = {2e-4, 3e-5, 1.2e-3, 8e-3, 0.2, 2e4, 0.5, 15, 0.05, 0.02};
  physics.numbers = FamilyPhysics::priors();
  physics.numbers[kStiffness] = stiffness;
  physics.numbers[kMemory] = memory;
  physics.numbers[kAsymmetry] = asymmetry;
  return {std::make_shared<Family>(family_of(std::make_shared<PhysicsFamily>(physics))),
          example_member()};
}

}  // namespace

TEST_CASE("a settled sine has the force of many cycles, however long they take to forget") {
  std::vector<FamilyModel> models{settling_line(), example_family(), example_family_network()};
  for (const double stiffness : {-3., -1., 1., 5.})
    for (const double memory : {0., 0.4, 1.})
      models.push_back(sprung_physics(stiffness, memory, 0.3));
  for (std::size_t k = 0; k < models.size(); ++k)
    for (const SteadySine& sine : {SteadySine{0.02, 0.24, 0.9}, {0.02, 2.5, 0}, {5e-3, 20, 0.5}}) {
      double most = 0;
      for (int n = 0; n < 8; ++n)
        most = std::max(most, std::abs(force_after(models[k], sine, 0.25 * kHalfTurn * n, 2)));
      for (const double phase : {-1.3, 0., 0.4, 1.9, 3.3}) {
        CAPTURE(k);
        CAPTURE(sine.rate);
        CAPTURE(phase);
        CHECK_CLOSE(force_settled(models[k], sine, phase), force_after(models[k], sine, phase, 150),
                    0, 0.01 * most);
      }
    }
}

TEST_CASE("a weak spring before a strong resistance: where it began is not told for its force") {
  // After three cycles from rest a sine of 26 s has still a tenth of what its first turn left.
  const FamilyModel model = sprung_physics(-3, 1, 0.5);
  const SteadySine sine{0.02, 0.24, 1};
  const double settled = force_settled(model, sine, 0), first = force_after(model, sine, 0, 3);
  CAPTURE(settled);
  CHECK(std::abs(first - settled) > 0.03 * std::abs(settled));
  CHECK_CLOSE(settled, force_after(model, sine, 0, 400), 1e-3, 0);
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
