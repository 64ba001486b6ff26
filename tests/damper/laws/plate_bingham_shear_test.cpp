#include "dashpot/damper/laws/plate_bingham_shear.h"

#include "support.h"

TEST_CASE("plate_bingham_shear: (eta v / h + tau) w L of TC-5.2b, and Papanastasiou's onset") {
  const double eta = 0.28, tau = 20e3, w = 0.12, L = 0.02, h = 5e-4;
  PlateBinghamShear p{.c0 = eta * w * L / h, .f_y = tau * w * L, .v_s = 0, .f0 = 2};
  CHECK_CLOSE(plate_bingham_shear_force(&p, 0, 0.1, nullptr), (eta * 0.1 / h + tau) * w * L + 2,
              1e-14, 0);
  CHECK_CLOSE(plate_bingham_shear_force(&p, 0, -0.1, nullptr), -(eta * 0.1 / h + tau) * w * L + 2,
              1e-14, 0);
  CHECK(plate_bingham_shear_force(&p, 0, 0, nullptr) == 2);
  p.v_s = 0.01;
  CHECK_CLOSE(plate_bingham_shear_force(&p, 0, 0.02, nullptr),
              eta * w * L / h * 0.02 + tau * w * L * (1 - std::exp(-2.0)) + 2, 1e-14, 0);
}
