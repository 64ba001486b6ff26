#include "dashpot/damper/laws/hysteretic_biviscous.h"

#include "support.h"

namespace {
constexpr HystereticBiviscous kBiviscousDamper{
    .C_po = 2000, .C_pr = 50000, .F_y = 800, .v0 = 0.005, .a_s = 0.05, .r = 200, .f0 = 0};

double force(const HystereticBiviscous& damper, double v, double a) {
  const double z = v - a / damper.r;
  return hysteretic_biviscous_force(&damper, 0, v, &z);
}
}  // namespace

TEST_CASE("the hysteretic biviscous law gives the forces of TC-4.3 on both branches") {
  const double up = 1e6, down = -1e6;  // m/s^2, so far above a_s that s is 1 in twelve digits
  CHECK_CLOSE(force(kBiviscousDamper, -0.05, up), -900, 1e-9, 0);
  CHECK_CLOSE(force(kBiviscousDamper, 0, up), -250, 1e-9, 0);
  CHECK_CLOSE(force(kBiviscousDamper, 0.005, up), 0, 0, 1e-6);
  CHECK_CLOSE(force(kBiviscousDamper, 0.02, up), 750, 1e-9, 0);
  CHECK_CLOSE(force(kBiviscousDamper, 0.05, up), 900, 1e-9, 0);
  CHECK_CLOSE(force(kBiviscousDamper, 0.05, down), 900, 1e-9, 0);
  CHECK_CLOSE(force(kBiviscousDamper, 0, down), 250, 1e-9, 0);
  CHECK_CLOSE(force(kBiviscousDamper, -0.005, down), 0, 0, 1e-6);
  CHECK_CLOSE(force(kBiviscousDamper, -0.05, down), -900, 1e-9, 0);
}

TEST_CASE("the knees of the rising branch stand at -v1 and v2 of TC-4.3") {
  const auto slope = [](double v) {
    return (force(kBiviscousDamper, v + 1e-7, 1e6) - force(kBiviscousDamper, v, 1e6)) / 1e-7;
  };
  for (const double knee : {-0.011458333, 0.021875}) {
    const bool lower = knee < 0;
    CHECK_CLOSE(slope(knee - 1e-6), lower ? 2000 : 50000, 1e-4, 0);
    CHECK_CLOSE(slope(knee + 1e-6), lower ? 50000 : 2000, 1e-4, 0);
  }
}

TEST_CASE(
    "at rest the hysteretic biviscous force lies midway and does not jump with the sign of noise") {
  CHECK(force(kBiviscousDamper, 0, 0) == 0);
  // s = 1e-6 / 0.05 moves the steep line by 2e-5 v0
  CHECK_CLOSE(force(kBiviscousDamper, 0, 1e-6), -50000 * 0.005 * 2e-5, 1e-6, 0);
}
