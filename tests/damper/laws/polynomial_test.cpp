#include "dashpot/damper/laws/polynomial.h"

#include "support.h"

namespace {

/// The set of TC-4.11 in docs/sources.md at current i: a_k of the rising branch; the even ones
/// change their sign on the falling one.
double rising(int k, double i) {
  const double b[] = {-61.9, 3432.979, 4062.992, -44504.529, -81937.285, 279061.643, 506645.121};
  const double c[] = {-185.701,    8998.938,   12188.977, -133513.587,
                      -245811.856, 837184.928, 1519935.36};
  return b[k] + c[k] * i;
}

/// The conversion that the header states: m_k and d_k are half the sum and half the difference.
Polynomial reference(double i) {
  Polynomial p{};
  p.v_max = 0.3, p.a_s = 0.05, p.r = 200;
  const auto in_newton = [&](int k) { return rising(k, i) * std::pow(p.v_max, k); };
  p.m1 = in_newton(1), p.m3 = in_newton(3), p.m5 = in_newton(5);
  p.d0 = in_newton(0), p.d2 = in_newton(2), p.d4 = in_newton(4), p.d6 = in_newton(6);
  return p;
}

double force(const Polynomial& p, double v, double a) {
  const double z = v - a / p.r;
  return polynomial_force(&p, 0, v, &z);
}

constexpr double kUp = 1e6, kDown = -1e6;  // m/s^2, so far above a_s that s is 1 in twelve digits

}  // namespace

TEST_CASE("the polynomial gives the forces of TC-4.11") {
  CHECK_CLOSE(force(reference(1), 0.05, kUp), 390.70457, 0, 5e-6);
  CHECK_CLOSE(force(reference(1), 0.05, kDown), 808.68026, 0, 5e-6);
  CHECK_CLOSE(force(reference(0.5), -0.2, kUp), -914.78554, 0, 5e-6);
  CHECK_CLOSE(force(reference(0), 0, kUp), -61.9, 0, 1e-9);
  CHECK_CLOSE(force(reference(1.5), 0.25, kDown), 1930.9644, 0, 5e-5);
}

TEST_CASE("two unlike branches become means and half differences") {
  // rising 1 + 2 u + ... + 7 u^6, falling 10 + 20 u + ... + 70 u^6, in N, at u = 1/2
  const Polynomial p{.f0 = 5.5,
                     .m1 = 11,
                     .m2 = 16.5,
                     .m3 = 22,
                     .m4 = 27.5,
                     .m5 = 33,
                     .m6 = 38.5,
                     .d0 = -4.5,
                     .d1 = -9,
                     .d2 = -13.5,
                     .d3 = -18,
                     .d4 = -22.5,
                     .d5 = -27,
                     .d6 = -31.5,
                     .v_max = 0.3,
                     .a_s = 0.05,
                     .r = 200};
  const double at_half = 1 + 2 / 2.0 + 3 / 4.0 + 4 / 8.0 + 5 / 16.0 + 6 / 32.0 + 7 / 64.0;
  CHECK_CLOSE(force(p, 0.15, kUp), at_half, 1e-9, 0);
  CHECK_CLOSE(force(p, 0.15, kDown), 10 * at_half, 1e-9, 0);
}

TEST_CASE("beyond v_max the polynomial is held; at rest it gives f0") {
  const Polynomial p = reference(1);
  CHECK_CLOSE(force(p, 3, kUp), force(p, 0.3, kUp), 1e-12, 0);
  CHECK_CLOSE(force(p, -3, kUp), force(p, -0.3, kUp), 1e-12, 0);
  CHECK(force(p, 0, 0) == 0);
}
