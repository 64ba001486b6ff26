#include "dashpot/damper/fuzzy/fuzzy_inputs.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"

namespace dashpot {
namespace {

constexpr std::string_view kChange = "velocity_change";

double DamperInput::* field_of(const std::string& name, const std::string& where) {
  if (name == "displacement") return &DamperInput::displacement;
  if (name == "velocity") return &DamperInput::velocity;
  if (name == "current") return &DamperInput::current;
  if (name == kChange) return nullptr;
  throw Error(where, "unknown fuzzy input '" + name + "'",
              suggest(name, {"displacement", "velocity", "current", std::string(kChange)}));
}

}  // namespace

FuzzyInputs::FuzzyInputs(std::vector<std::string> names, double lag, const std::string& where)
    : names_(std::move(names)), lag_(lag), has_past_(has(kChange)) {
  for (const std::string& name : names_) fields_.push_back(field_of(name, where));
  if (!(lag > 0 && std::isfinite(lag)))
    throw Error(where, "the lag is " + format_number(lag) + " s", "write a positive number of seconds");
}

bool FuzzyInputs::has(std::string_view name) const noexcept {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

void FuzzyInputs::rest(std::span<double> state) const noexcept {
  if (has_past_) state[0] = 0;
}

void FuzzyInputs::advance(const DamperInput& from, const DamperInput& to, double dt,
                          std::span<double> state) const noexcept {
  if (!has_past_ || !(dt > 0)) return;
  const double behind = lag_ * (to.velocity - from.velocity) / dt;  // of a velocity that goes on for ever
  state[0] = to.velocity - behind + (state[0] - from.velocity + behind) * std::exp(-dt / lag_);
}

void FuzzyInputs::read(const DamperInput& input, std::span<const double> state, double* values) const noexcept {
  for (std::size_t k = 0; k < fields_.size(); ++k)
    values[k] = fields_[k] ? input.*fields_[k] : input.velocity - state[0];
}

}  // namespace dashpot
