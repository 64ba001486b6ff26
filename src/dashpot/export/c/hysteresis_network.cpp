#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"
#include "dashpot/export/c/c_model.h"

namespace dashpot {

CModel c_hysteresis_network(const HysteresisNetworkModel& model) {
  std::vector<const HysteresisBank*> banks;
  std::vector<const GatedNetwork*> networks;
  for (const HysteresisNetwork& member : model.members()) {
    banks.push_back(&member.bank);
    networks.push_back(&member.network);
  }
  return {c_banks(banks) + c_gated_networks(networks) +
          c_members("bank", "kBanks", banks.size(), model.offset())};
}

}  // namespace dashpot
