#include "dashpot/damper/laws/extended_bingham.h"

#include "damper/laws/sine_drive.h"
#include "dashpot/base/random.h"
#include "dashpot/damper/registry.h"

using namespace dashpot;

TEST_CASE("extended Bingham: TC-4.2") {
  const LawModel model =
      LawModel::constant(find_law("extended_bingham"), {5000, 500, 20000, 1e5, 2e5, -50});
  const auto found = at_times(model, {0.01, 1}, {0.05, 0.2, 0.5, 1, 2}, 1e-5);
  check_forces(found, {444.95724, 520.3396, -668.90861, 559.19951, 561.11618});
  CHECK(found[0].state[0] == 0);
  check_states({found.begin() + 1, found.end()}, 0,
               {3.1712879e-3, 3.0153573e-3, -2.6870006e-3, -2.7498927e-3}, 1e-11);
}

TEST_CASE("extended Bingham: the own step meets TC-4.2 with an error of second order") {
  const Law& law = find_law("extended_bingham");
  const double p[] = {5000, 500, 20000, 1e5, 2e5, -50};
  const auto force_at_half_second = [&](int steps) {
    double z[] = {0, 0}, x[] = {0, 0}, v[] = {0, 0};
    for (int k = 0; k < steps; ++k) {
      x[0] = x[1];
      x[1] = Sine{0.01, 1}.at(0.5 * (k + 1) / steps).displacement;
      REQUIRE(law.step(p, x, v, 0.5 / steps, z) == 1);
    }
    return law.force(p, x[1], 0, z);
  };
  CHECK_CLOSE(force_at_half_second(50), -668.90861, 0, 1);
  CHECK_CLOSE(force_at_half_second(500), -668.90861, 0, 0.01);
  CHECK_CLOSE(force_at_half_second(5000), -668.90861, 0, 1e-4);
}

TEST_CASE(
    "extended Bingham: at any stiffness and step it settles on a standstill, on the yield force") {
  const Law& law = find_law("extended_bingham");
  Random random(8);
  for (int trial = 0; trial < 500; ++trial) {
    const double c0 = std::pow(10, random.uniform(-2, 6)), h = std::pow(10, random.uniform(-5, 1));
    const double p[] = {c0, 500, 1e4, 1e5, std::pow(10, random.uniform(3, 10)), 0};
    const double moving[] = {0, 0.1 * random.normal()}, still[] = {moving[1], moving[1]},
                 v[] = {0, 0};
    double z[] = {0, 0};
    REQUIRE(law.step(p, moving, v, h, z) == 1);
    double force = std::abs(law.force(p, still[0], 0, z));
    for (int k = 0; k < 50; ++k) law.step(p, still, v, 10, z);
    CHECK(std::isfinite(force));
    CHECK(std::abs(law.force(p, still[0], 0, z)) <= 500 * (1 + 1e-6) + 1e-6 * force);
  }
}
