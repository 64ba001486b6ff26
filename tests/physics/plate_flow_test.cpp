#include "dashpot/physics/plate_flow.h"

#include <functional>

#include "support.h"

namespace {

constexpr PlateGap kGap{.length = 6e-3, .width = 0.02487, .height = 1e-3};
constexpr double kViscosity = 0.28, kArea = 1.6029e-4;

double pressure(double yield_stress, double v) {
  return plate_bingham_pressure(plate_newtonian_pressure(&kGap, kViscosity, kArea * v),
                                plate_yield_pressure(&kGap, yield_stress));
}

double herschel_bulkley(double n, double consistency, double v) {
  return plate_herschel_bulkley_pressure(plate_power_law_pressure(&kGap, consistency, n, kArea * v),
                                         plate_yield_pressure(&kGap, 20122.8539), n);
}

/// Flow rate and stress at the moving wall, by the velocity profile itself: plates at y = 0 (at
/// rest) and y = 1 (moving at -u), viscosity 1, pressure gradient 1 driving towards +: stress s(y)
/// = s0 - y.
struct Profile {
  double flow, wall_stress, wall_speed;
};
Profile profile(double s0, double yield) {
  constexpr int kSteps = 200000;
  double speed = 0, flow = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double s = s0 - (k + 0.5) / kSteps;
    const double rate = s > yield ? s - yield : s < -yield ? s + yield : 0;
    flow += (speed + rate / kSteps / 2) / kSteps;
    speed += rate / kSteps;
  }
  return {flow, 1 - s0, -speed};
}

}  // namespace

TEST_CASE("the pressures of a Bingham fluid are those of TC-5.1") {
  CHECK_CLOSE(pressure(0, 0.034), 4417.7393, 2e-8, 0);
  CHECK_CLOSE(pressure(1000, 0.034), 20326.592, 3e-8, 0);
  CHECK_CLOSE(pressure(20122.8539, 0.034), 270197.19, 3e-8, 0);
  CHECK_CLOSE(pressure(59176.47, 0.3), 864695.88, 1e-8, 0);
  CHECK_CLOSE(pressure(59176.47, 0.3) * kArea, 138.6021, 1e-7, 0);
}

TEST_CASE("P(T) has the digits of TC-5.1, and stays the largest root for T from 0 to 1e12") {
  const auto number = [](double t) { return plate_bingham_pressure(1, 2 * t); };
  CHECK_CLOSE(number(0.01), 1.02999623, 0, 5e-9);
  CHECK_CLOSE(number(0.1), 1.29762446, 0, 5e-9);
  CHECK_CLOSE(number(0.5), 1 + std::sqrt(2.0), 1e-15, 0);
  CHECK_CLOSE(number(1), 3.70927536, 0, 5e-9);
  CHECK_CLOSE(number(10), 24.13041839, 0, 5e-9);
  CHECK_CLOSE(number(1000), 2036.96267, 0, 5e-6);
  CHECK(plate_bingham_pressure(0, 0) == 0);
  CHECK_CLOSE(plate_bingham_pressure(0, 3), 3, 1e-15, 0);
  for (double t = 1e-12; t <= 1e12; t *= 3) {
    const long double p = number(t), d = p - 2.0L * t;
    CHECK(d > 0);
    // (p - 2t)^2 (p + t) = p^2 is the cubic; an error of p in its last digit is one of p / d digits
    // in d
    CHECK_CLOSE(static_cast<double>(d * d * (p + t) / (p * p)), 1,
                1e-15 * static_cast<double>(4 + p / d), 0);
  }
}

TEST_CASE("flow for a pressure is the inverse; up to the yield pressure nothing flows") {
  for (const double yield : {0.0, 0.3, 1.0, 1e3})
    for (const double flow : {1e-3, 0.1, 1.0, 50.0})
      CHECK_CLOSE(plate_bingham_newtonian(plate_bingham_pressure(flow, yield), yield), flow, 1e-9,
                  0);
  CHECK(plate_bingham_newtonian(2, 2) == 0);
  CHECK(plate_bingham_newtonian(0, 2) == 0);
  CHECK(plate_bingham_newtonian(0, 0) == 0);
}

TEST_CASE("Gavin's approximation: TC-5.1's value, and at most 2.21 % off, at T = 19.5") {
  CHECK_CLOSE(plate_gavin_pressure(1, 2 * 1.3581607), 4.6914498, 2e-8, 0);
  double worst = 0, where = 0;
  for (double t = 1e-3; t <= 1000; t *= 1.002) {
    const double error =
        std::abs(plate_gavin_pressure(1, 2 * t) / plate_bingham_pressure(1, 2 * t) - 1);
    if (error > worst) worst = error, where = t;
  }
  CHECK_CLOSE(worst, 0.0221, 0, 5e-5);
  CHECK_CLOSE(where, 19.5, 0.03, 0);
}

TEST_CASE(
    "a wall that moves against the flow: the value of TC-5.1b, and the Newtonian force of "
    "TC-3.3") {
  CHECK_CLOSE(plate_moving_wall_pressure(1, 4.0 / 3, 0.1), 2.90979824, 1e-7, 0);
  const double wall = kGap.width * kGap.height / kArea, v = 0.034;
  const double newtonian = plate_newtonian_pressure(&kGap, kViscosity, kArea * v);
  const double p = plate_moving_wall_pressure(newtonian, 0, wall);
  CHECK_CLOSE(p, 4760.4593, 2e-8, 0);
  CHECK_CLOSE((p + plate_wall_drag(p, newtonian, 0, wall)) * kArea, 0.82367092, 2e-8, 0);
}

TEST_CASE("pressure and drag of the moving wall are those of the velocity profile, integrated") {
  for (const double yield : {0.05, 0.2, 0.4})
    for (const double lean :
         {0.5, 0.48, 0.46}) {  // stress at the wall at rest; 0.5: both walls at rest
      const Profile at = profile(lean, yield);
      const double newtonian = 12 * at.flow, yielding = 2 * yield, wall = at.wall_speed / at.flow;
      const double p = plate_moving_wall_pressure(newtonian, yielding, wall);
      CHECK_CLOSE(p, 1, 1e-6, 0);
      // Stress times w L on the piston, over its area: A = Q / u gives w L / A = wall L / h.
      CHECK_CLOSE(plate_wall_drag(p, newtonian, yielding, wall), wall * at.wall_stress, 1e-6, 1e-9);
    }
}

TEST_CASE("Herschel-Bulkley: TC-5.2, Bingham at n = 1, its own flow equation everywhere") {
  CHECK_CLOSE(herschel_bulkley(1, 0.28, 0.034), 270197.19, 3e-8, 0);
  CHECK_CLOSE(herschel_bulkley(1, 0.28, 0.3), 340452, 2e-6, 0);
  CHECK_CLOSE(herschel_bulkley(0.7, 3, 0.034), 266658.75, 3e-8, 0);
  CHECK_CLOSE(herschel_bulkley(0.7, 3, 0.3), 307989.86, 3e-8, 0);
  CHECK_CLOSE(herschel_bulkley(0.5, 15, 0.034), 264041.9, 3e-7, 0);
  CHECK_CLOSE(herschel_bulkley(0.5, 15, 0.3), 289923.66, 3e-8, 0);
  for (double t = 1e-14; t < 1e20; t *= 10) {
    CHECK_CLOSE(plate_herschel_bulkley_pressure(1, t, 1), plate_bingham_pressure(1, t), 1e-13, 0);
    for (const double n : {0.1, 0.5, 2.0}) {
      const double p = plate_herschel_bulkley_pressure(1, t, n), r = t / p, m = 1 / n;
      if (r > 0.999) continue;  // 1 - r has lost its digits here, in this check
      CHECK_CLOSE(std::pow(p, m) * std::pow(1 - r, m + 1) * (1 + r / (m + 1)), 1, 1e-10 * m, 0);
    }
  }
  CHECK(plate_herschel_bulkley_pressure(0, 0, 0.5) == 0);
  CHECK(plate_herschel_bulkley_pressure(0, 5, 0.5) == 5);
  CHECK(plate_herschel_bulkley_pressure(5, 0, 0.5) == 5);
}

TEST_CASE("shear mode: Bingham's stress, and Papanastasiou's smooth one that tends to it") {
  CHECK_CLOSE(plate_shear_stress(0.28, 1000, 340, 0), 1095.2, 1e-15, 0);
  CHECK(plate_shear_stress(0.28, 1000, 0, 0) == 0);
  CHECK_CLOSE(plate_shear_stress(0, 1000, 2, 0.5), 1000 * (1 - std::exp(-1.0)), 1e-14, 0);
  CHECK_CLOSE(plate_shear_stress(0.28, 1000, 340, 1), plate_shear_stress(0.28, 1000, 340, 0), 1e-15,
              0);
}
