#include "dashpot/damper/integrate.h"

#include <array>

#include "dashpot/damper/law_model.h"

namespace dashpot {
namespace {

using Params = std::array<double, kMaxParams>;

// RK4 is stable up to rate * step = 2.78 on the real axis. Where the cap is reached the run diverges, and is
// reported so, instead of taking hours.
constexpr double kStepLimit = 2.0;
constexpr double kMaxSubsteps = 200;
// A law's own step costs about two explicit ones and serves for six: measured on the modified Bouc-Wen law,
// the error of both then is that of inputs taken as straight lines between samples.
constexpr double kManySubsteps = 3, kOwnStepRatio = 6;

/// One step of length h from time t on, with the parameters at its start, middle and end.
void explicit_step(const Law& law, const InputPath& path, const std::array<const double*, 3>& p, double t,
                   double h, double* z) noexcept {
  const double x[] = {path.displacement(t), path.displacement(t + h / 2), path.displacement(t + h)};
  const double v[] = {path.velocity(t), path.velocity(t + h / 2), path.velocity(t + h)};
  law.runge_kutta(p.data(), x, v, h, law.states.size(), z);
}

/// The law's own step, `count` times; false where the law has none for these parameters.
bool own_steps(const LawModel& model, const InputPath& path, int count, double h, double* z) noexcept {
  if (!model.law().step) return false;
  Params middle;
  for (int k = 0; k < count; ++k) {
    const double t = k * h;
    model.parameters_at(path.current(t + h / 2), middle.data());
    const double x[] = {path.displacement(t), path.displacement(t + h)};
    const double v[] = {path.velocity(t), path.velocity(t + h)};
    if (!model.law().step(middle.data(), x, v, h, z)) return false;
  }
  return true;
}

}  // namespace

void integrate(const LawModel& model, const InputPath& path, double dt, double* z) noexcept {
  const Law& law = model.law();
  const bool varies = model.follows_current() && path.current_varies();
  if (law.exact_step && !varies && own_steps(model, path, 1, dt, z)) return;
  const double top_speed = path.top_speed(dt);
  Params start, middle, end;
  model.parameters_at(path.current(0), start.data());
  double rate = law.rate(start.data(), top_speed);
  if (varies) {
    model.parameters_at(path.current(dt), end.data());
    rate = std::max(rate, law.rate(end.data(), top_speed));
  }
  const double wanted = std::ceil(rate * dt / kStepLimit);
  if (wanted > (law.exact_step ? 1 : kManySubsteps)) {
    const int count =
        law.exact_step ? 1 : 1 + static_cast<int>(std::ceil(std::min(wanted, kMaxSubsteps) / kOwnStepRatio));
    if (own_steps(model, path, count, dt / count, z)) return;
  }
  const int count = wanted > 1 ? static_cast<int>(std::min(wanted, kMaxSubsteps)) : 1;  // 1 for NaN too
  const double h = dt / count;
  for (int k = 0; k < count; ++k) {
    if (!varies) {
      explicit_step(law, path, {start.data(), start.data(), start.data()}, k * h, h, z);
      continue;
    }
    model.parameters_at(path.current((k + 0.5) * h), middle.data());
    model.parameters_at(path.current((k + 1) * h), end.data());
    explicit_step(law, path, {start.data(), middle.data(), end.data()}, k * h, h, z);
    start = end;
  }
}

}  // namespace dashpot
