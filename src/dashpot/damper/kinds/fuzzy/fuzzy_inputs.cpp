#include "dashpot/damper/kinds/fuzzy/fuzzy_inputs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/lag.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::array<std::string_view, 4> kNames{"displacement", "velocity", "velocity_change",
                                                 "current"};

}  // namespace

FuzzyInputs::Source FuzzyInputs::source_of(const std::string& name, const std::string& where) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end())
    throw Error(where, "unknown fuzzy input '" + name + "'",
                suggest(name, {kNames.begin(), kNames.end()}));
  return static_cast<Source>(found - kNames.begin());
}

FuzzyInputs::FuzzyInputs(std::vector<std::string> names, Lags lags, const std::string& where)
    : names_(std::move(names)),
      lags_(lags),
      has_past_(has("velocity_change")),
      has_coil_(has("current") && lags.coil > 0) {
  for (const std::string& name : names_) sources_.push_back(source_of(name, where));
  if (!(lags.velocity > 0 && std::isfinite(lags.velocity)))
    throw Error(where, "the velocity's lag is " + format_number(lags.velocity),
                "write seconds above 0");
  if (!(lags.coil >= 0 && std::isfinite(lags.coil)))
    throw Error(where, "the coil's lag is " + format_number(lags.coil),
                "write seconds, 0 for none");
}

bool FuzzyInputs::has(std::string_view name) const noexcept {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

void FuzzyInputs::rest(const DamperInput& input, std::span<double> state) const noexcept {
  if (has_past_) state.front() = 0;
  if (has_coil_) state.back() = input.current;
}

void FuzzyInputs::advance(const DamperInput& from, const DamperInput& to, double dt,
                          std::span<double> state) const noexcept {
  if (!(dt > 0)) return;
  if (has_past_) {
    const LagWeights past(dt / lags_.velocity);
    state.front() = past.of(state.front(), from.velocity, to.velocity);
  }
  if (has_coil_)
    state.back() = LagWeights(dt / lags_.coil).of(state.back(), from.current, to.current);
}

void FuzzyInputs::read(const DamperInput& input, std::span<const double> state,
                       double* values) const noexcept {
  for (std::size_t k = 0; k < sources_.size(); ++k) switch (sources_[k]) {
      case Source::Displacement:
        values[k] = input.displacement;
        break;
      case Source::Velocity:
        values[k] = input.velocity;
        break;
      case Source::VelocityChange:
        values[k] = input.velocity - state.front();
        break;
      case Source::Current:
        values[k] = has_coil_ ? state.back() : input.current;
        break;
    }
}

}  // namespace dashpot
