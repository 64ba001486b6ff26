#include "dashpot/damper/laws/sigmoid.h"

#include "support.h"

namespace {
double force(const Sigmoid& damper, double v, double a) {
  const double z = v - a / damper.r;
  return sigmoid_force(&damper, 0, v, &z);
}
constexpr Sigmoid kSigmoidDamper{
    .f_m = 900, .k_a = 120, .k_v = 1.5, .v_h = 0.008, .a_s = 0.05, .r = 200, .f0 = 0};
}  // namespace

TEST_CASE("the sigmoid gives the forces of TC-4.10") {
  const double up = 1e6, down = -1e6;  // m/s^2, so far above a_s that s is 1 in twelve digits
  CHECK_CLOSE(force(kSigmoidDamper, 0, up), -401.61925, 0, 5e-6);
  CHECK_CLOSE(force(kSigmoidDamper, 0, down), 401.61925, 0, 5e-6);
  CHECK_CLOSE(force(kSigmoidDamper, 0.05, up), 955.05387, 0, 5e-6);
  CHECK_CLOSE(force(kSigmoidDamper, -0.2, down), -1170, 0, 1e-6);
}

TEST_CASE("the sigmoid is finite where its exponential overflows, and rests midway") {
  CHECK_CLOSE(force(kSigmoidDamper, 100, 1e6), 900 * 151, 1e-12, 0);
  CHECK(force(kSigmoidDamper, 0, 0) == 0);
}
