#include "dashpot/damper/laws/large_scale_bouc_wen.h"

#include "damper/laws/sine_drive.h"
#include "dashpot/damper/registry.h"

using namespace dashpot;

TEST_CASE("large-scale Bouc-Wen: TC-4.6a") {
  // Its acceleration is that of the motion: the filter's state is set to v - a / r
  const double r = 1000;
  const LawModel model =
      LawModel::constant(find_law("large_scale_bouc_wen"),
                         {2000, 2e6, 50, 0.6, 8e4, 1.2e6, 1e4, 1e4, 200, 2, r, -2000});
  const Sine sine{0.02, 0.5};
  auto found = at_times(model, sine, {0.05, 0.2, 0.5, 1, 2}, 1e-5);
  for (Simulated& s : found) {
    s.state[1] = sine.at(s.t).velocity - sine.acceleration(s.t) / r;
    s.force = model.force(sine.at(s.t), s.state);
  }
  check_forces(found, {135449.83, 136373.09, 119205.22, -139222.01, 135222.01});
}

TEST_CASE(
    "large-scale Bouc-Wen: the filter follows a straight line exactly, in one step of any length") {
  const double p[] = {2000, 2e6, 50, 0.6, 8e4, 1.2e6, 1e4, 1e4, 200, 2, 40, 0};
  const Law& law = find_law("large_scale_bouc_wen");
  const double x[] = {0, 0}, v[] = {0.1, 0.5}, h = 0.2;
  double z[] = {0, 0.3};
  REQUIRE(law.step(p, x, v, h, z) == 1);
  // v_f = v - s/r + (v_f(0) - v(0) + s/r) exp(-r t), s = 2 m/s^2
  CHECK_CLOSE(z[1], 0.5 - 0.05 + (0.3 - 0.1 + 0.05) * std::exp(-8), 1e-14, 0);
}
