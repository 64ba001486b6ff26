#include "dashpot/damper/laws/biviscous.h"

#include "support.h"

TEST_CASE("the biviscous law gives the forces of TC-4.3") {
  const Biviscous damper{.C_po = 2000, .C_pr = 50000, .F_y = 800, .f0 = 0};
  const auto force = [&](double v) { return biviscous_force(&damper, 0, v, nullptr); };
  CHECK_CLOSE(force(-0.1), -1000, 1e-14, 0);
  CHECK_CLOSE(force(-0.01), -500, 1e-14, 0);
  CHECK_CLOSE(force(0.005), 250, 1e-14, 0);
  CHECK_CLOSE(force(1.0 / 60), 833.33333, 0, 5e-6);
  CHECK_CLOSE(force(0.1), 1000, 1e-14, 0);
}

TEST_CASE("with C_pr below C_po the biviscous law stays continuous and dissipative") {
  const Biviscous damper{.C_po = 2000, .C_pr = 500, .F_y = 80, .f0 = 0};
  for (double v = -0.2; v < 0.2; v += 1e-3) {
    const double here = biviscous_force(&damper, 0, v, nullptr);
    CHECK(here * v >= 0);
    CHECK_CLOSE(biviscous_force(&damper, 0, v + 1e-3, nullptr), here, 0,
                2.001);  // no steeper than C_po
  }
}
