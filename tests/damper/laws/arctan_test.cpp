#include "dashpot/damper/laws/arctan.h"

#include "support.h"

namespace {
constexpr Arctan kArctanDamper{
    .f_y = 600, .kappa = 80, .v_h = 0.01, .c = 1000, .a_s = 0.05, .r = 200, .f0 = 20};

double force(double v, double a) {
  const double z = v - a / kArctanDamper.r;
  return arctan_force(&kArctanDamper, 0, v, &z);
}
}  // namespace

TEST_CASE("the inverse tangent gives the forces of TC-4.9") {
  const double up = 1e6, down = -1e6;  // m/s^2, so far above a_s that s is 1 in twelve digits
  CHECK_CLOSE(force(0, up), -237.73206, 0, 5e-6);
  CHECK_CLOSE(force(0, down), 277.73206, 0, 5e-6);
  CHECK_CLOSE(force(0.05, up), 554.3065, 0, 5e-5);
  CHECK_CLOSE(force(-0.2, down), -754.90643, 0, 5e-6);
}

TEST_CASE("at rest the inverse tangent lies midway between its branches") {
  CHECK(force(0, 0) == 20);
  CHECK_CLOSE(force(0, 1e-9), 20, 0, 1e-5);
}
