#include "dashpot/damper/laws/bingham.h"

#include "support.h"

TEST_CASE("Bingham gives the forces of TC-4.1, and its offset at standstill") {
  const Bingham damper{.c0 = 5000, .f_c = 670, .f0 = -95, .v_s = 0};
  CHECK(bingham_force(&damper, 0, -0.1, nullptr) == -1265);
  CHECK(bingham_force(&damper, 0, 0, nullptr) == -95);
  CHECK(bingham_force(&damper, 0, -0.0, nullptr) == -95);
  CHECK(bingham_force(&damper, 0, 0.1, nullptr) == 1075);
}

TEST_CASE("Bingham's smooth friction is within the stated 0.5 % beyond three v_s") {
  const Bingham sharp{.c0 = 0, .f_c = 100, .f0 = 0, .v_s = 0},
      smooth{.c0 = 0, .f_c = 100, .f0 = 0, .v_s = 0.01};
  CHECK(bingham_force(&smooth, 0, 0, nullptr) == 0);
  CHECK(bingham_force(&smooth, 0, 0.01, nullptr) < 80);  // 100 tanh(1) = 76.2
  for (const double v : {-0.3, -0.0301, 0.0301, 0.1})
    CHECK_CLOSE(bingham_force(&smooth, 0, v, nullptr), bingham_force(&sharp, 0, v, nullptr), 0.005,
                0);
}
