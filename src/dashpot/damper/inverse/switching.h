#pragma once
#include "dashpot/damper/inverse/inverse.h"

namespace dashpot {

/// Schemes that need no model of the damper: they switch or scale the current by what force is
/// wanted and what force or motion is measured. Currents count from the least one of the limits.
class SwitchingInverse final : public InverseModel {
 public:
  enum class Rule {
    ClippedOptimal,          ///< full when (f_c - f) f > 0
    ModifiedClippedOptimal,  ///< then in proportion to |f_c|, full from force_max on
    Heaviside,               ///< full when f_c v > 0
    Signum                   ///< gain (f_c - f) sgn f, within the limits
  };
  /// force_max: N, the damper's largest force; sets the gain 10 / force_max (of the current range)
  /// too. Throws Error when it is not above 0.
  SwitchingInverse(Rule rule, const InverseLimits& limits, double force_max);

  std::string name() const override;
  double force_max() const { return force_max_; }

 protected:
  double wanted_current(const InverseInput& input, std::span<double> state) const noexcept override;

 private:
  Rule rule_;
  double force_max_;
};

}  // namespace dashpot
