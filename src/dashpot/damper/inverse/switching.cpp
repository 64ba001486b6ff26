#include "dashpot/damper/inverse/switching.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/error.h"

namespace dashpot {
namespace {

constexpr double kSignumGain = 10;  // full current at an error of a tenth of the largest force
constexpr std::array kNames{"clipped_optimal", "modified_clipped_optimal", "heaviside", "signum"};

}  // namespace

SwitchingInverse::SwitchingInverse(Rule rule, const InverseLimits& limits, double force_max)
    : InverseModel(limits), rule_(rule), force_max_(force_max) {
  if (!(force_max > 0 && std::isfinite(force_max)))
    throw Error(name(), "the largest force of the damper must be a number above 0");
}

std::string SwitchingInverse::name() const { return kNames[static_cast<std::size_t>(rule_)]; }

double SwitchingInverse::wanted_current(const InverseInput& input, std::span<double>) const noexcept {
  const auto sign = [](double f) { return static_cast<double>((f > 0) - (f < 0)); };
  const double missing = sign(input.measured) * (input.wanted - input.measured);
  double share = 0;  // of the current range
  switch (rule_) {
    case Rule::ClippedOptimal:
      share = missing > 0 ? 1 : 0;
      break;
    case Rule::ModifiedClippedOptimal:
      share = missing > 0 ? std::abs(input.wanted) / force_max_ : 0;
      break;
    case Rule::Heaviside:
      share = sign(input.wanted) * sign(input.velocity) > 0 ? 1 : 0;
      break;
    case Rule::Signum:
      share = kSignumGain * missing / force_max_;
      break;
  }
  return limits().current_min + std::clamp(share, 0.0, 1.0) * (limits().current_max - limits().current_min);
}

}  // namespace dashpot
