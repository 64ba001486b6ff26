#include <cmath>

#include "dashpot/damper_model.h"

namespace dashpot {

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
