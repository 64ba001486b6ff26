#include "dashpot/damper/laws/plate_bingham.h"

#include "support.h"

TEST_CASE("plate_bingham gives the forces of TC-5.1, at either sign of speed") {
  // The two numbers of TC-5.1's geometry: 12 eta L A^2 / (w h^3) and 2 tau L A / h.
  const double c0 = 12 * 0.28 * 6e-3 * 1.6029e-4 * 1.6029e-4 / (0.02487 * 1e-9);
  const auto force = [&](double yield_stress, double v) {
    const PlateBingham p{
        .c0 = c0, .f_y = 2 * yield_stress * 6e-3 * 1.6029e-4 / 1e-3, .f0 = 0, .v_s = 0};
    return plate_bingham_force(&p, 0, v, nullptr);
  };
  CHECK_CLOSE(force(0, 0.034), 0.70811944, 1e-8, 0);
  CHECK_CLOSE(force(1000, 0.034), 3.2581495, 2e-8, 0);
  CHECK_CLOSE(force(20122.8539, -0.034), -43.309908, 2e-8, 0);
  CHECK_CLOSE(force(59176.47, 0.3), 138.6021, 1e-7, 0);
}

TEST_CASE(
    "plate_bingham: nothing but the offset at standstill, f_y just beyond, 3/2 f_y at high speed") {
  const PlateBingham p{.c0 = 1000, .f_y = 800, .f0 = -5, .v_s = 0};
  CHECK(plate_bingham_force(&p, 0, 0, nullptr) == -5);
  CHECK_CLOSE(plate_bingham_force(&p, 0, 1e-15, nullptr), 795, 1e-6, 0);
  CHECK_CLOSE(plate_bingham_force(&p, 0, 1e6, nullptr), 1e9 + 1195, 0,
              1e-3);  // - Y^3 / (2 G^2) is 3e-10
  const PlateBingham smooth{.c0 = 1000, .f_y = 800, .f0 = 0, .v_s = 0.01};
  CHECK_CLOSE(plate_bingham_force(&smooth, 0, 1e-9, nullptr), 0, 0, 1e-3);
  CHECK_CLOSE(plate_bingham_force(&smooth, 0, 0.1, nullptr),
              plate_bingham_force(&p, 0, 0.1, nullptr) + 5, 1e-8, 0);
}

TEST_CASE("plate_bingham: a yield force that falls with current below 0 counts as none") {
  const PlateBingham p{.c0 = 1000, .f_y = -50, .f0 = 0, .v_s = 0};
  CHECK_CLOSE(plate_bingham_force(&p, 0, 0.2, nullptr), 200, 1e-14, 0);
}
