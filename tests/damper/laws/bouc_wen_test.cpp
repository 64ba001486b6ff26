#include "dashpot/damper/laws/bouc_wen.h"

#include "damper/laws/sine_drive.h"
#include "dashpot/base/random.h"
#include "dashpot/damper/registry.h"

using namespace dashpot;

TEST_CASE("Bouc-Wen: TC-4.4") {
  // The set of docs/sources.md in SI: 100 cm^-2 = 1e6 m^-2.
  const LawModel model =
      LawModel::constant(find_law("bouc_wen"), {88000, 5000, 2500, 0.038, 1e6, 1e6, 120, 2, 0});
  const auto found = at_times(model, {0.015, 2.5}, {0.05, 0.1, 0.2, 0.25, 0.4, 0.5});
  check_forces(found, {1446.2021, 624.14507, -1954.7423, -1636.2021, 1764.7423, 624.14507});
  CHECK_CLOSE(found[0].state[0], 7.7459667e-3, 0, 5e-11);
}

TEST_CASE(
    "Bouc-Wen: one step is the whole way, whatever n and the direction, as many small ones tell") {
  const Law& law = find_law("bouc_wen");
  Random random(2);
  for (const double n : {1.0, 2.0})
    for (int trial = 0; trial < 40; ++trial) {
      const double gamma = 1e4 * random.uniform(0.1, 1),
                   beta = trial % 4 ? 1e4 * random.uniform(0, 2) : gamma;
      const double p[] = {1, 0, 0, 0, gamma, beta, 50, n, 0};
      const double z_max = std::pow(50 / (gamma + beta), 1 / n);
      const double v[] = {random.uniform(-1, 1), random.uniform(-1, 1)}, x[] = {0, 0};
      const double h = 3 * z_max / 50;  // up to three knees
      double once = z_max * random.uniform(-1, 1), z = once;
      REQUIRE(law.step(p, x, v, h, &once) == 1);
      constexpr int kSteps = 2000;
      for (int k = 0; k < kSteps; ++k) {  // Heun's method: its error is of the order of 1e-6 here
        const double v0 = v[0] + (v[1] - v[0]) * k / kSteps,
                     v1 = v[0] + (v[1] - v[0]) * (k + 1) / kSteps;
        double a, b;
        law.derivative(p, 0, v0, &z, &a);
        const double trial_z = z + h / kSteps * a;
        law.derivative(p, 0, v1, &trial_z, &b);
        z += h / kSteps * (a + b) / 2;
      }
      CAPTURE(n);
      CHECK_CLOSE(once, z, 0, 1e-5 * z_max);
    }
}

TEST_CASE(
    "Bouc-Wen: z_max, and z has no scale: alpha/s, s A, gamma/s and beta/s give the same force") {
  const BoucWen one{88000, 5000, 2500, 0.038, 1e6, 1e6, 120, 2, 0};
  BoucWen other = one;
  other.alpha /= 3, other.A *= 3, other.gamma /= 3, other.beta /= 3;
  CHECK_CLOSE(bouc_wen_travel(&one, 0, 1), 7.7459667e-3, 0, 5e-11);
  for (const double s : {1e-5, 3e-4, -2e-3}) {
    const double z = bouc_wen_travel(&one, 0.001, s), z3 = bouc_wen_travel(&other, 0.003, s);
    CHECK_CLOSE(bouc_wen_force(&other, 0.01, 0.1, &z3), bouc_wen_force(&one, 0.01, 0.1, &z), 1e-13,
                0);
  }
}
