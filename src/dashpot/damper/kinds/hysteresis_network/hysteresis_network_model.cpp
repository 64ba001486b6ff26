#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"

namespace dashpot {

void HysteresisNetwork::require_sound(const std::string& where) const {
  bank.require_sound(where);
  if (const std::size_t lags = bank.current_rates.size();
      lags < 1 || lags > GatedNetwork::kMaxCurrents)
    throw Error(where, "has " + std::to_string(lags) + " current rates",
                "1 to " + std::to_string(GatedNetwork::kMaxCurrents));
  if (bank.signal_count() > GatedNetwork::kMaxSignals)
    throw Error(where, "has " + std::to_string(bank.size()) + " rates",
                "at most " + std::to_string(GatedNetwork::kMaxSignals - 1));
  network.require_sound(bank.signal_count(), where);
}

}  // namespace dashpot
