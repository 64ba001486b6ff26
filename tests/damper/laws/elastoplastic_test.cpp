#include "dashpot/damper/laws/elastoplastic.h"

#include <numbers>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kAmplitude = 0.01, kSpeed = 2 * std::numbers::pi * kAmplitude;

DamperInput slow_sine(double t) {
  const double phase = 2 * std::numbers::pi * t;
  return {kAmplitude * std::sin(phase), kSpeed * std::cos(phase), 0};
}

}  // namespace

TEST_CASE(
    "elastoplastic: TC-5.3, where the force crosses zero after reversal and the energy of a "
    "cycle") {
  const LawModel model = LawModel::constant(find_law("elastoplastic"), {0, 1000, 4e5, 0});
  for (const int samples : {500, 4000}) {
    const double h = 1.0 / samples;
    std::vector<double> state(1);
    model.rest(slow_sine(0), state);
    double energy = 0, before = 0, crossing = 0;
    for (int k = 0; k < 2 * samples; ++k) {
      const DamperInput now = slow_sine(k * h);
      const double force = model.force(now, state);
      if (k >= samples) energy += force * now.velocity * h;
      if (before > 0 && force <= 0) crossing = now.displacement;
      before = force;
      model.advance(now, slow_sine((k + 1) * h), h, state);
    }
    // The crossing lies between two samples, |v| h apart.
    CHECK_CLOSE(crossing, 7.5e-3, 0, 0.041559364 * h + 2e-6);
    CHECK_CLOSE(energy, 30, 2.0 / samples, 0);
  }
}

TEST_CASE("elastoplastic: its own step is exact, turn by turn") {
  const Elastoplastic p{.c0 = 0, .f_y = 1000, .k = 4e5, .f0 = 0};  // gives way at 2.5 mm
  const double x[] = {0, 0}, there[] = {1, -1}, on[] = {0.1, 0.3};
  double z = 2e-3;
  elastoplastic_step(&p, x, there, 0.004,
                     &z);  // 1 mm on, 1 mm back: yields first, so 1.5 mm is left
  CHECK_CLOSE(z, 1.5e-3, 1e-12, 0);
  elastoplastic_step(&p, x, on, 0.001, &z);
  CHECK_CLOSE(z, 1.7e-3, 1e-12, 0);
  elastoplastic_step(&p, x, on, 1, &z);
  CHECK_CLOSE(elastoplastic_force(&p, 0, 0, &z), 1000, 1e-14, 0);
}

TEST_CASE(
    "elastoplastic: a stretch beyond the limit is not felt, and goes back while something moves") {
  const Elastoplastic p{.c0 = 100, .f_y = 1000, .k = 4e5, .f0 = 5};
  const double z = 3e-3;
  double dz;
  CHECK_CLOSE(elastoplastic_force(&p, 0, 0.1, &z), 1015, 1e-14, 0);
  elastoplastic_derivative(&p, 0, 0.1, &z, &dz);
  CHECK_CLOSE(dz, -4 * 0.1 * 0.2, 1e-12, 0);
  elastoplastic_derivative(&p, 0, 0, &z, &dz);
  CHECK(dz == 0);
}
