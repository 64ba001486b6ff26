#include "dashpot/damper/laws/tanh_acceleration.h"

#include <numbers>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "support.h"

TEST_CASE(
    "tanh of velocity and acceleration: its closed form, with the acceleration of the state") {
  const TanhAcceleration damper{.f_y = 900, .kappa = 50, .tau = 0.01, .c = 2000, .r = 200, .f0 = 7};
  const auto force = [&](double v, double a) {
    const double z = v - a / damper.r;
    return tanh_acceleration_force(&damper, 0, v, &z);
  };
  CHECK(force(0, 0) == 7);
  CHECK_CLOSE(force(0.03, 3), 7 + 2000 * 0.03, 1e-12, 0);  // v = tau a: the tanh is at its zero
  CHECK_CLOSE(force(0.03, 1), 7 + 60 + 900 * std::tanh(1.0), 1e-12, 0);
}

TEST_CASE(
    "its filter gives the acceleration of a sine, smaller and later as a first-order lag says") {
  // f_y = 0 but for a line: kappa so small that tanh is its argument, F = f_y kappa (v - tau a)
  const double r = 200, tau = 0.01, kappa = 1e-3, w = 2 * std::numbers::pi * 3;
  const dashpot::LawModel model = dashpot::LawModel::constant(
      dashpot::find_law("tanh_acceleration"), {1e3, kappa, tau, 0, r, 0});
  const auto input = [&](double t) { return dashpot::DamperInput{0, 0.01 * std::sin(w * t), 0}; };
  std::vector<double> state(1);
  model.rest(input(0), state);
  const double h = 1e-4;
  for (int k = 0; k < 10000; ++k) {
    model.advance(input(k * h), input((k + 1) * h), h, state);
    if (k < 5000 || k % 100) continue;
    const double t = (k + 1) * h;
    // a / v = i w r / (r + i w) = w (w + i r) r / (r^2 + w^2)
    const double share = r * w / (r * r + w * w);
    const double a = 0.01 * share * (w * std::sin(w * t) + r * std::cos(w * t));
    CHECK_CLOSE(model.force(input(t), state), 0.01 * std::sin(w * t) - tau * a, 0, 1e-6 * 0.01);
  }
}
