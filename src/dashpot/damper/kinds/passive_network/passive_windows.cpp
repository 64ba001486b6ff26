#include "dashpot/damper/kinds/passive_network/passive_windows.h"

namespace dashpot {

PassiveLayout::PassiveLayout(const PassiveSizes& sizes) {
  count = 0;
  const auto take = [this](std::size_t numbers) {
    const std::size_t at = count;
    count += numbers;
    return at;
  };
  weights = take((sizes.neurons + sizes.memories) * sizes.inputs());
  gates = take(2 * sizes.springs * (sizes.neurons + 2));
  viscous_weights = take(sizes.viscous_neurons * (sizes.seen() + 1));
  viscous = take(sizes.viscous_neurons + 2);
  levers = take(2 * sizes.springs);
  stiffness = take(sizes.springs);
  memory_rates = take(sizes.memories);
  saturation = take(1);
  potential = take(5);
  drive_rate = take(1);
  inertia = take(1);
  inertia_rate = take(1);
}

}  // namespace dashpot
