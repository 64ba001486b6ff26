#include "dashpot/damper/kinds/law/law_model.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_text.h"
#include "dashpot/damper/law_side.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

using Params = std::array<double, kMaxParams>;

void require_shape(const Law& law, const Dependence& parameters) {
  const std::string where = "parameters of " + std::string(law.name);
  const std::size_t count = law.params.size();
  if (count > kMaxParams || law.states.size() > kMaxStates)
    throw Error(where, "the law has more parameters or states than a model keeps room for",
                "raise kMaxParams or kMaxStates");
  if (parameters.forms.size() != count || parameters.coefficients.size() != count)
    throw Error(where, "got " + std::to_string(parameters.coefficients.size()),
                "the law has " + std::to_string(count));

  // Each form has so many coefficients, and the coil current stands for itself.
  for (std::size_t k = 0; k < count; ++k)
    if (parameters.coefficients[k].size() != coefficient_count(parameters.forms[k]))
      throw Error(where + ", " + std::string(law.params[k].name),
                  "has " + std::to_string(parameters.coefficients[k].size()) + " coefficients",
                  "a " + std::string(name_of(parameters.forms[k])) + " one has " +
                      std::to_string(coefficient_count(parameters.forms[k])));
  for (std::size_t k = 0; k < count; ++k)
    if (law.params[k].fit == Fit::Drive &&
        (parameters.forms[k] != Form::Linear ||
         parameters.coefficients[k] != std::vector<double>{0, 1}))
      throw Error(where + ", " + std::string(law.params[k].name), "is not the coil current itself",
                  "write form linear with coefficients 0, 1");
}

}  // namespace

LawModel::LawModel(const Law& law, Dependence parameters, DriveUnit drive_unit, double lag_rate)
    : law_(&law),
      text_(law.text ? law.text->shared_from_this() : nullptr),
      parameters_(std::move(parameters)),
      drive_unit_(drive_unit),
      lag_rate_(lag_rate) {
  require_shape(law, parameters_);
  if (!(lag_rate_ >= 0 && std::isfinite(lag_rate_)))
    throw Error("lag_rate", "is " + format_number(lag_rate_), "write a rate in 1/s, 0 for none");

  // Sort the parameters by how they are evaluated: polynomials side by side, the others singly.
  for (std::size_t k = 0; k < law.params.size(); ++k) {
    follows_current_ |= parameters_.forms[k] != Form::Constant;
    if (!is_polynomial(parameters_.forms[k])) {
      exponential_.push_back(k);
      continue;
    }
    for (std::size_t power = 0; power < parameters_.coefficients[k].size(); ++power)
      by_power_[power][k] = parameters_.coefficients[k][power];
  }

  // Explicit steps of a vehicle's integrator, which go down to a 64th of a millisecond, are
  // unstable for a rate above that, and its implicit ones see a force of the difference of two near
  // states.
  constexpr double kFastest = 1e5;  // 1/s
  if (!law.step || !law.rate) return;
  Params p;
  parameters_at(0, p.data());
  steps_itself_ = law.rate(p.data(), 0) > kFastest;
}

LawModel LawModel::constant(const Law& law, const std::vector<double>& parameters) {
  Dependence dependence{std::vector<Form>(parameters.size(), Form::Constant), {}};
  for (const double value : parameters) dependence.coefficients.push_back({value});
  for (std::size_t k = 0; k < std::min(law.params.size(), parameters.size()); ++k) {
    if (law.params[k].fit != Fit::Drive) continue;
    dependence.forms[k] = Form::Linear;
    dependence.coefficients[k] = {0, 1};
  }
  return LawModel(law, std::move(dependence), DriveUnit::Ampere, 0);
}

bool LawModel::needs_displacement() const noexcept { return law_->needs_displacement; }

std::size_t LawModel::parameter_count() const noexcept {
  std::size_t count = 0;
  for (std::size_t k = 0; k < law_->params.size(); ++k)
    if (is_estimated(law_->params[k].fit)) count += coefficient_count(parameters_.forms[k]);
  return count;
}

std::size_t LawModel::state_size() const noexcept {
  return law_->states.size() + (lag_rate_ > 0 ? 1 : 0);
}

void LawModel::rest(const DamperInput& input, std::span<double> state) const noexcept {
  if (law_->rest) {
    Params p;
    parameters_at(input.current, p.data());
    law_->rest(p.data(), input.displacement, input.velocity, state.data());
  }
  if (lag_rate_ > 0) state[law_->states.size()] = input.current;
}

double LawModel::force(const DamperInput& input, std::span<const double> state) const noexcept {
  Params p;
  parameters_at(coil_current(input, state), p.data());
  const double force = law_->force(p.data(), input.displacement, input.velocity, state.data());
  return law_->side_row > 0 ? force + side_force(*law_, p.data(), input.velocity) : force;
}

std::size_t LawModel::run(std::span<const DamperInput> inputs, Steps steps, std::span<double> state,
                          Response to) const noexcept {
  if (!law_->forces || lag_rate_ > 0) return DamperModel::run(inputs, steps, state, to);
  if (to.spread) std::fill_n(to.spread, inputs.size(), 0);

  // Take samples of one current together, as their parameters are the same.
  constexpr std::size_t kAtATime =
      256;  // of forces that the cache still holds when they are checked
  Params p;
  for (std::size_t first = 0, end = 0; first < inputs.size(); first = end) {
    const double current = inputs[first].current;
    const std::size_t last = std::min(first + kAtATime, inputs.size());
    for (end = first + 1; end < last && (!follows_current_ || inputs[end].current == current);)
      ++end;
    parameters_at(current, p.data());
    law_->forces(p.data(), inputs.subspan(first, end - first), to.force + first);
    for (std::size_t k = first; law_->side_row > 0 && k < end; ++k)
      to.force[k] += side_force(*law_, p.data(), inputs[k].velocity);
    for (std::size_t k = first; k < end; ++k)
      if (!std::isfinite(to.force[k])) return k;
  }
  return inputs.size();
}

double LawModel::flow(const DamperInput& input, std::span<const double> state,
                      std::span<double> rates) const noexcept {
  if (lag_rate_ > 0)
    rates[law_->states.size()] = lag_rate_ * (input.current - state[law_->states.size()]);
  Params p;
  parameters_at(coil_current(input, state), p.data());
  return flow(p.data(), input, state.data(), rates.data());
}

std::unique_ptr<DamperModel> LawModel::with_offset(double newton) const {
  Dependence moved = parameters_;
  const auto bias = std::find_if(law_->params.begin(), law_->params.end(),
                                 [](const ParamInfo& p) { return p.fit == Fit::Bias; });
  if (bias == law_->params.end()) throw Error(name(), "the law has no offset parameter");
  moved.coefficients[static_cast<std::size_t>(bias - law_->params.begin())][0] += newton;
  return std::make_unique<LawModel>(*law_, std::move(moved), drive_unit_, lag_rate_);
}

void require_bounds(const LawModel& model, double current, const std::string& where) {
  Params p;
  model.parameters_at(current, p.data());
  for (std::size_t k = 0; k < model.law().params.size(); ++k) {
    const ParamInfo& info = model.law().params[k];
    if (info.fit == Fit::Drive) continue;
    double slack = 0, power = 1e-9;  // what rounding may do to the sum of its terms
    for (const double coefficient : model.parameters().coefficients[k]) {
      slack += std::abs(coefficient) * power;
      if (is_polynomial(model.parameters().forms[k])) power *= std::abs(current);
    }

    // Refuse what lies outside even so.
    if (p[k] >= info.lower - slack && p[k] <= info.upper + slack) continue;
    throw Error(
        where,
        std::string(info.name) + " is " + format_number(p[k]) + " " + std::string(info.unit) +
            " at " + format_number(current) + " " + to_string(model.drive_unit()),
        "it must lie within " + format_number(info.lower) + " ... " + format_number(info.upper));
  }
}

}  // namespace dashpot
