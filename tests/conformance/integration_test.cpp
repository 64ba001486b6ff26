#include <cmath>

#include "conformance/laws.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Force at the end of 20 ms in `steps` steps: a motion that a straight line describes exactly, so
/// that what is left is the integrator's error.
double force_after_ramp(const LawModel& model, int steps) {
  const auto at = [](double s) { return DamperInput{1e-5 * s, 0.002 + 0.001 * s, 0.2 + 0.3 * s}; };
  std::vector<double> state(model.state_size());
  model.rest({0, 0, 0.2}, state);
  for (int k = 0; k < steps; ++k)
    model.advance(at(static_cast<double>(k) / steps), at((k + 1.0) / steps), 0.02 / steps, state);
  return model.force(at(1), state);
}

/// Force shortly before the motion turns, where every loop is open: the force then feels the
/// states.
double force_on_sine(const LawModel& model, int steps) {
  const double end = 0.24;
  std::vector<double> state(model.state_size());
  model.rest(sine(0), state);
  for (int k = 0; k < steps; ++k)
    model.advance(sine(end * k / steps), sine(end * (k + 1) / steps), end / steps, state);
  return model.force(sine(end), state);
}

/// Infinite where the coarse run is as good as rounding lets the fine one be: an exact step, or a
/// standstill.
template <class Run>
double measured_order(Run run, int steps) {
  const double exact = run(64 * steps), error = std::abs(run(steps) - exact);
  if (error <= 2e-12 * std::abs(exact)) return INFINITY;
  return std::log2(error / std::abs(run(2 * steps) - exact));
}

}  // namespace

TEST_CASE("laws with states: order 4 under inputs that are straight lines, 2 under a sine") {
  for_each_law([](const Law& law) {
    if (law.states.empty()) return;
    // Every parameter grows with the current, which lags: the stages must see it at their own
    // times.
    Dependence d;
    for (const ParamInfo& info : law.params) {
      d.forms.push_back(info.fit == Fit::Fixed ? Form::Constant : Form::Linear);
      d.coefficients.push_back(info.fit == Fit::Fixed ? std::vector{info.value}
                                                      : std::vector{info.value, 0.5 * info.value});
    }
    const LawModel driven(law, d, DriveUnit::Ampere, 40);
    CHECK(measured_order([&](int n) { return force_after_ramp(driven, n); }, 64) > 3.7);
    // Between samples the sine is taken as straight: that error, of order 2, is what is left.
    const LawModel constant = LawModel::constant(law, defaults(law));
    const double order = measured_order([&](int n) { return force_on_sine(constant, n); }, 4000);
    CAPTURE(order);
    CHECK(order > 1.8);
  });
}
