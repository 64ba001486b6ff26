#include "dashpot/damper/laws/tanh_guo.h"

#include "support.h"

TEST_CASE("Guo's law gives the forces of TC-4.8a") {
  const TanhGuo damper{.A1 = 1200, .A2 = 1500, .A3 = 30, .V0 = 0.05, .X0 = 0.02, .f0 = 40};
  const auto force = [&](double x, double v) { return tanh_guo_force(&damper, x, v, nullptr); };
  CHECK(force(0, 0) == 40);
  CHECK_CLOSE(force(0.01, 0), 839.67874, 0, 5e-6);
  CHECK_CLOSE(force(0.01, 0.05), 1326.1313, 0, 5e-5);
  CHECK_CLOSE(force(-0.01, 0.2), 1502.4339, 0, 5e-5);
  CHECK_CLOSE(force(0, -0.3), -1610, 0, 1e-4);  // tanh(9) is 3e-8 short of 1
}
