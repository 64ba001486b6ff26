#include "dashpot/damper/laws/dahl.h"

#include "damper/laws/sine_drive.h"
#include "dashpot/damper/registry.h"

using namespace dashpot;

TEST_CASE("Dahl: w = 1 - (1 - w0) exp(-rho dx) on a monotone branch, one step or many") {
  // The closed form of TC-4.13 in docs/sources.md.
  const LawModel model = LawModel::constant(find_law("dahl"), {57.42, 27450, 3});
  for (const int steps : {1, 100}) {
    std::vector<double> state{-0.4};
    for (int k = 0; k < steps; ++k) model.advance({0, 0.05, 0}, {0, 0.05, 0}, 0.001 / steps, state);
    const double w = 1 - 1.4 * std::exp(-27450 * 0.05 * 0.001);
    CHECK_CLOSE(state[0], w, 1e-12, 0);
    CHECK_CLOSE(model.force({0, 0.05, 0}, state), 57.42 * w + 3, 1e-12, 0);
  }
}

TEST_CASE("Dahl: a step through a reversal is two branches, and a long one stays bounded") {
  const LawModel model = LawModel::constant(find_law("dahl"), {1, 1000, 0});
  // v from 0.03 to -0.01 in 0.04 s: 0.45 mm forward within 0.03 s, 0.05 mm back
  std::vector<double> state{0};
  model.advance({0, 0.03, 0}, {0, -0.01, 0}, 0.04, state);
  const double forward = 1 - std::exp(-0.45);
  CHECK_CLOSE(state[0], -1 + (1 + forward) * std::exp(-0.05), 1e-13, 0);
  model.advance({0, 5, 0}, {0, 1, 0}, 10, state);
  CHECK(state[0] == 1);
}
