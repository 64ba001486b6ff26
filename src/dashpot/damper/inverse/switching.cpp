#include "dashpot/damper/inverse/switching.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <math.h>  // the C text says fabs, not std::fabs

#include "dashpot/error.h"

namespace dashpot {
namespace {

// clang-format off: the texts are taken in
#include "dashpot/damper/c_text/inverse_clipped_optimal.h"
#include "dashpot/damper/c_text/inverse_heaviside.h"
#include "dashpot/damper/c_text/inverse_modified_clipped_optimal.h"
#include "dashpot/damper/c_text/inverse_signum.h"
// clang-format on

constexpr std::array kNames{"clipped_optimal", "modified_clipped_optimal", "heaviside", "signum"};

}  // namespace

SwitchingInverse::SwitchingInverse(Rule rule, const InverseLimits& limits, double force_max)
    : InverseModel(limits, rule != Rule::Heaviside), rule_(rule), force_max_(force_max) {
  if (!(force_max > 0 && std::isfinite(force_max)))
    throw Error(name(), "the largest force of the damper must be a number above 0");
}

std::string SwitchingInverse::name() const { return kNames[static_cast<std::size_t>(rule_)]; }

double SwitchingInverse::wanted_current(const InverseInput& input,
                                        std::span<double>) const noexcept {
  double share = 0;  // of the current range

  switch (rule_) {
    case Rule::ClippedOptimal:
      share = clipped_optimal_share(&input, force_max_);
      break;
    case Rule::ModifiedClippedOptimal:
      share = modified_clipped_optimal_share(&input, force_max_);
      break;
    case Rule::Heaviside:
      share = heaviside_share(&input, force_max_);
      break;
    case Rule::Signum:
      share = signum_share(&input, force_max_);
      break;
  }
  return limits().current_min +
         std::clamp(share, 0.0, 1.0) * (limits().current_max - limits().current_min);
}

}  // namespace dashpot
