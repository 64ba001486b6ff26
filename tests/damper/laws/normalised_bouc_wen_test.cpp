#include "dashpot/damper/laws/normalised_bouc_wen.h"

#include "damper/laws/sine_drive.h"
#include "dashpot/base/random.h"
#include "dashpot/damper/laws/bouc_wen.h"
#include "dashpot/damper/registry.h"

using namespace dashpot;

TEST_CASE("normalised Bouc-Wen: TC-4.13") {
  // The set of docs/sources.md in SI: 0.8 N*s/mm, 50 N, 0.5 mm^-1
  const LawModel model =
      LawModel::constant(find_law("normalised_bouc_wen"), {800, 50, 500, 0.75, 2, 0});
  const auto found = at_times(model, {0.012375, 0.8403}, {0.05, 0.2, 0.5, 1, 2});
  check_states(found, 0, {0.92382516, 0.99995799, -0.98166159, 0.098737168, -1});
  check_forces(found, {96.650114, 75.735427, -94.911018, 33.027465, -72.07687});
}

TEST_CASE("normalised Bouc-Wen: any n steps with bounded w and an error of second order") {
  const Law& law = find_law("normalised_bouc_wen");
  Random random(4);
  for (int trial = 0; trial < 2000; ++trial) {
    const double p[] = {0,
                        1,
                        1e3,
                        trial % 2 ? random.uniform(0.5, 3) : random.uniform(0.5, 1000),
                        random.uniform(1, 20),
                        0};
    const double x[] = {0, 0}, v[] = {random.normal(), random.normal()};
    double w = random.uniform(-1, 1);
    REQUIRE(law.step(p, x, v, std::pow(10, random.uniform(-6, 2)), &w) == 1);
    CHECK(std::abs(w) <= 1);
  }
  const auto after = [](double n, int steps) {
    double w = -0.9;
    for (int k = 0; k < steps; ++k) w = normalised_bouc_wen_move(2, n, w, 0.8 / steps);
    return w;
  };
  for (const double n : {1.5, 3.0}) {
    const double truth = after(n, 1 << 14);
    CHECK_CLOSE((after(n, 64) - truth) / (after(n, 128) - truth), 4, 0.1, 0);
    CHECK_CLOSE(after(n, 1), truth, 0, 0.002);
  }
  CHECK_CLOSE(after(10, 1), after(10, 1 << 14), 0, 0.002);
  // the closed forms against it: n = 1 and 2 as the limits of n
  for (const double n : {1.0, 2.0}) CHECK_CLOSE(after(n, 1), after(n + 1e-9, 4096), 0, 1e-6);
}

TEST_CASE(
    "normalised Bouc-Wen: w = z / z_max of the law with gamma and beta, a negative beta too") {
  for (const double beta : {300.0, 0.0, -250.0}) {
    const BoucWen other{1, 0, 0, 0, 1000, beta, 5, 2, 0};
    const double z_max = std::sqrt(5 / (1000 + beta)), sigma = 1000 / (1000 + beta);
    const NormalisedBoucWen p{0, 1, 5 / z_max, sigma, 2, 0};
    for (const double w : {-0.8, 0.3})
      for (const double v : {-0.2, 0.1}) {
        const double z = w * z_max;
        double dw, dz;
        normalised_bouc_wen_derivative(&p, 0, v, &w, &dw);
        bouc_wen_derivative(&other, 0, v, &z, &dz);
        CHECK_CLOSE(dw * z_max, dz, 1e-12, 1e-14);
      }
  }
}
