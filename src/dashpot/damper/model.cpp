#include <cmath>

#include "dashpot/damper_model.h"

namespace dashpot {

Domain usual_domain(double current_min, double current_max) {
  return {-0.025, 0.025, -0.5, 0.5, current_min, current_max};
}

std::size_t DamperModel::run(std::span<const DamperInput> inputs, Steps steps,
                             std::span<double> state, Response to) const noexcept {
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    if (k > 0) advance(inputs[k - 1], inputs[k], steps.to(k), state);
    to.force[k] = force(inputs[k], state);
    if (to.spread) to.spread[k] = spread(inputs[k], state);
    if (!std::isfinite(to.force[k]) || has_diverged(state)) return k;
  }
  return inputs.size();
}

}  // namespace dashpot
