#include "dashpot/damper/kinds/passive_network/passive_network_model.h"

#include <algorithm>

namespace dashpot {

bool PassiveNetworkModel::needs_displacement() const noexcept {
  return std::ranges::any_of(members(), &PassiveNetwork::reads_displacement);
}

double PassiveNetworkModel::stored_energy(const DamperInput& input,
                                          std::span<const double> state) const noexcept {
  double sum = 0;
  for (const PassiveNetwork& member : members()) {
    sum += member.stored_energy(input, state.first(member.size()));
    state = state.subspan(member.size());
  }
  return sum / static_cast<double>(members().size());
}

}  // namespace dashpot
