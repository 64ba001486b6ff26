#include "dashpot/damper/laws/landau_surrogate.h"

#include "damper/laws/sine_drive.h"
#include "dashpot/base/random.h"
#include "dashpot/damper/registry.h"

using namespace dashpot;

TEST_CASE("Landau surrogate: TC-4.15") {
  const LawModel model =
      LawModel::constant(find_law("landau_surrogate"), {800, 1000, 0.005, 0.02, -0.2, 0, 1.2, 0});
  const auto found = at_times(model, {0.01, 1}, {0.05, 0.2, 0.3, 0.5, 0.8});
  check_states(found, 0, {1.219304, 0.99773599, -0.99190247, -1.2306797, 0.99190247});
  check_forces(found, {1035.1999, 817.6049, -812.93808, -1047.3756, 812.93808});
}

TEST_CASE(
    "Landau surrogate: without cubic terms p is a linear lag, of which the own step is of second "
    "order") {
  const double p[] = {1, 0, 0.01, 0.1, 2, 0, 1e-3 * 1e-9, 0};
  const auto after = [&](int steps) {
    const double x[] = {0, 0};
    double z = 0;
    for (int k = 0; k < steps; ++k) {
      const double v[] = {1.0 * k / steps, 1.0 * (k + 1) / steps};
      REQUIRE(find_law("landau_surrogate").step(p, x, v, 0.02 / steps, &z) == 1);
    }
    return z;
  };
  // p' + 200 p = 1000 v, v = 50 t: p = 250 (t - (1 - exp(-200 t)) / 200)
  const double exact = 250 * (0.02 - (1 - std::exp(-4.0)) / 200);
  CHECK_CLOSE((after(20) - exact) / (after(40) - exact), 4, 0.1, 0);
  CHECK_CLOSE(after(4000), exact, 1e-5, 0);
}

TEST_CASE(
    "Landau surrogate: a long step lands where p is balanced; too long a one between wells is "
    "refused") {
  const Law& law = find_law("landau_surrogate");
  Random random(6);
  const double x[] = {0, 0};
  for (int trial = 0; trial < 500; ++trial) {
    const double p[] = {1, 0, 1e-5, 0.02, random.uniform(0, 2), random.uniform(0, 5), 1.2, 0};
    const double speed = random.normal(), v[] = {speed, speed};
    double z = 3 * random.normal(), dz;
    for (int k = 0; k < 40; ++k) REQUIRE(law.step(p, x, v, 0.05, &z) == 1);
    law.derivative(p, 0, speed, &z, &dz);
    CHECK_CLOSE(dz * p[2], 0, 0, 1e-6 * (1 + std::abs(speed) / 0.02));
  }
  const double wells[] = {1, 0, 1e-5, 0.02, -0.2, 0, 1.2, 0}, v[] = {0, 0};
  double z = 0.5;
  CHECK(law.step(wells, x, v, 0.05, &z) == 0);
  CHECK(z == 0.5);
}
