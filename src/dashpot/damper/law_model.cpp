#include "dashpot/damper/law_model.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"

namespace dashpot {
namespace {

using Params = std::array<double, kMaxParams>;
using States = std::array<double, kMaxStates>;

// RK4 is stable up to rate * step = 2.78 on the real axis. Where the cap is reached the run diverges, and is
// reported so, instead of taking hours.
constexpr double kStepLimit = 2.0;
constexpr double kMaxSubsteps = 1000;

/// Motion and coil current within one step. The command is linear in time; so is the coil's current, but for
/// a deviation that decays at the lag rate: this is exact.
class Path {
 public:
  Path(const DamperInput& from, const DamperInput& to, double dt, double lag_rate,
       double coil_current) noexcept
      : from_(from),
        displacement_slope_((to.displacement - from.displacement) / dt),
        velocity_slope_((to.velocity - from.velocity) / dt),
        current_slope_((to.current - from.current) / dt),
        lag_rate_(lag_rate) {
    if (lag_rate == 0) return;
    from_.current -= current_slope_ / lag_rate;
    deviation_ = coil_current - from_.current;
    if (std::abs(deviation_) <= 1e-14 * std::abs(from_.current)) deviation_ = 0;
  }
  double displacement(double t) const noexcept { return from_.displacement + displacement_slope_ * t; }
  double velocity(double t) const noexcept { return from_.velocity + velocity_slope_ * t; }
  double current(double t) const noexcept {
    const double settled = from_.current + current_slope_ * t;
    return deviation_ == 0 ? settled : settled + deviation_ * std::exp(-lag_rate_ * t);
  }
  bool current_varies() const noexcept { return current_slope_ != 0 || deviation_ != 0; }

 private:
  DamperInput from_;
  double displacement_slope_, velocity_slope_, current_slope_, lag_rate_, deviation_ = 0;
};

/// The law's parameters at the start, the middle and the end of a substep.
struct StageParams {
  const double *start, *middle, *end;
};

/// One classical Runge-Kutta step of length h from time t on.
void rk4_step(const Law& law, const Path& path, const StageParams& p, double t, double h,
              double* z) noexcept {
  const std::size_t n = law.states.size();
  const double x_middle = path.displacement(t + h / 2), v_middle = path.velocity(t + h / 2);
  States k1, k2, k3, k4, trial;
  const auto move = [&](const States& slope, double step) {
    for (std::size_t s = 0; s < n; ++s) trial[s] = z[s] + step * slope[s];
  };
  law.derivative(p.start, path.displacement(t), path.velocity(t), z, k1.data());
  move(k1, h / 2);
  law.derivative(p.middle, x_middle, v_middle, trial.data(), k2.data());
  move(k2, h / 2);
  law.derivative(p.middle, x_middle, v_middle, trial.data(), k3.data());
  move(k3, h);
  law.derivative(p.end, path.displacement(t + h), path.velocity(t + h), trial.data(), k4.data());
  for (std::size_t s = 0; s < n; ++s) z[s] += h / 6 * (k1[s] + 2 * (k2[s] + k3[s]) + k4[s]);
}

double substeps(double rate, double dt) noexcept {
  const double wanted = std::ceil(rate * dt / kStepLimit);
  return wanted > 1 ? std::min(wanted, kMaxSubsteps) : 1;  // 1 for NaN too
}

void require_shape(const Law& law, const Dependence& parameters) {
  const std::string where = "parameters of " + std::string(law.name);
  const std::size_t count = law.params.size();
  if (count > kMaxParams || law.states.size() > kMaxStates)
    throw Error(where, "the law has more parameters or states than a model keeps room for",
                "raise kMaxParams or kMaxStates");
  if (parameters.forms.size() != count || parameters.coefficients.size() != count)
    throw Error(where, "got " + std::to_string(parameters.coefficients.size()),
                "the law has " + std::to_string(count));
  for (std::size_t k = 0; k < count; ++k)
    if (parameters.coefficients[k].size() != coefficient_count(parameters.forms[k]))
      throw Error(where + ", " + std::string(law.params[k].name),
                  "has " + std::to_string(parameters.coefficients[k].size()) + " coefficients",
                  "a " + std::string(name_of(parameters.forms[k])) + " one has " +
                      std::to_string(coefficient_count(parameters.forms[k])));
}

}  // namespace

LawModel::LawModel(const Law& law, Dependence parameters, std::string drive_unit, double lag_rate)
    : law_(&law),
      parameters_(std::move(parameters)),
      drive_unit_(std::move(drive_unit)),
      lag_rate_(lag_rate) {
  require_shape(law, parameters_);
  if (drive_unit_ != "A" && drive_unit_ != "V")
    throw Error("drive_unit", "is '" + drive_unit_ + "'", "write A (current) or V (voltage)");
  if (!(lag_rate_ >= 0 && std::isfinite(lag_rate_)))
    throw Error("lag_rate", "is " + format_number(lag_rate_), "write a rate in 1/s, 0 for none");
  for (std::size_t k = 0; k < law.params.size(); ++k) {
    follows_current_ |= parameters_.forms[k] != Form::Constant;
    for (std::size_t power = 0; power < parameters_.coefficients[k].size(); ++power)
      by_power_[power][k] = parameters_.coefficients[k][power];
  }
}

LawModel LawModel::constant(const Law& law, const std::vector<double>& parameters) {
  Dependence dependence{std::vector<Form>(parameters.size(), Form::Constant), {}};
  for (const double value : parameters) dependence.coefficients.push_back({value});
  return LawModel(law, std::move(dependence), "A", 0);
}

bool LawModel::needs_displacement() const noexcept { return law_->needs_displacement; }

std::size_t LawModel::parameter_count() const noexcept {
  std::size_t count = 0;
  for (std::size_t k = 0; k < law_->params.size(); ++k)
    if (!law_->params[k].fixed) count += coefficient_count(parameters_.forms[k]);
  return count;
}

std::size_t LawModel::state_size() const noexcept { return law_->states.size() + (lag_rate_ > 0 ? 1 : 0); }

void LawModel::parameters_at(double current, double* out) const noexcept {
  const std::size_t count = law_->params.size();
  if (!follows_current_) {
    std::copy_n(by_power_[0].data(), count, out);
    return;
  }
  for (std::size_t k = 0; k < count; ++k)
    out[k] = by_power_[0][k] + current * (by_power_[1][k] + current * by_power_[2][k]);
}

void LawModel::rest(const DamperInput& input, std::span<double> state) const noexcept {
  if (law_->rest) {
    Params p;
    parameters_at(input.current, p.data());
    law_->rest(p.data(), input.displacement, state.data());
  }
  if (lag_rate_ > 0) state[law_->states.size()] = input.current;
}

void LawModel::advance(const DamperInput& from, const DamperInput& to, double dt,
                       std::span<double> state) const noexcept {
  const std::size_t states = law_->states.size();
  const Path path(from, to, dt, lag_rate_, lag_rate_ > 0 ? state[states] : 0);
  if (lag_rate_ > 0) state[states] = path.current(dt);
  if (states == 0) return;

  const double top_speed = std::max(std::abs(from.velocity), std::abs(to.velocity));
  Params start, middle, end;
  parameters_at(path.current(0), start.data());
  double rate = law_->rate(start.data(), top_speed);
  const bool varies = follows_current_ && path.current_varies();
  if (varies) {
    parameters_at(path.current(dt), end.data());
    rate = std::max(rate, law_->rate(end.data(), top_speed));
  }
  const double count = substeps(rate, dt), h = dt / count;
  for (double k = 0; k < count; ++k) {
    if (!varies) {
      rk4_step(*law_, path, {start.data(), start.data(), start.data()}, k * h, h, state.data());
      continue;
    }
    parameters_at(path.current((k + 0.5) * h), middle.data());
    parameters_at(path.current((k + 1) * h), end.data());
    rk4_step(*law_, path, {start.data(), middle.data(), end.data()}, k * h, h, state.data());
    start = end;
  }
}

double LawModel::force(const DamperInput& input, std::span<const double> state) const noexcept {
  Params p;
  parameters_at(lag_rate_ > 0 ? state[law_->states.size()] : input.current, p.data());
  return law_->force(p.data(), input.displacement, input.velocity, state.data());
}

std::unique_ptr<DamperModel> LawModel::with_offset(double newton) const {
  Dependence moved = parameters_;
  const auto bias =
      std::find_if(law_->params.begin(), law_->params.end(), [](const ParamInfo& p) { return p.bias; });
  if (bias == law_->params.end()) throw Error(name(), "the law has no offset parameter");
  moved.coefficients[static_cast<std::size_t>(bias - law_->params.begin())][0] += newton;
  return std::make_unique<LawModel>(*law_, std::move(moved), drive_unit_, lag_rate_);
}

void require_bounds(const LawModel& model, double current, const std::string& where) {
  Params p;
  model.parameters_at(current, p.data());
  for (std::size_t k = 0; k < model.law().params.size(); ++k) {
    const ParamInfo& info = model.law().params[k];
    double slack = 0, power = 1e-9;  // what rounding may do to the sum of its terms
    for (const double coefficient : model.parameters().coefficients[k]) {
      slack += std::abs(coefficient) * power;
      power *= std::abs(current);
    }
    if (p[k] >= info.lower - slack && p[k] <= info.upper + slack) continue;
    throw Error(where,
                std::string(info.name) + " is " + format_number(p[k]) + " " + std::string(info.unit) +
                    " at " + format_number(current) + " " + model.drive_unit(),
                "it must lie within " + format_number(info.lower) + " ... " + format_number(info.upper));
  }
}

}  // namespace dashpot
