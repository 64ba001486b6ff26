#pragma once
#include <span>
#include <string>
#include <string_view>

#include "dashpot/damper/kinds/passive_network/presets.h"
#include "dashpot/damper/law.h"
#include "dashpot/damper/model_info.h"

namespace dashpot {

/// A law beside a passive network. Every law has one that dissipates wherever its bounds hold.
struct PassiveHybridPreset {
  std::string name, title, equation, source, remarks;  ///< of both together
  const Law* law = nullptr;
  const PassiveNetworkPreset* network = nullptr;
  bool usual = false;  ///< among model_names()

  ModelInfo info() const;
};
std::span<const PassiveHybridPreset> passive_hybrid_presets();

/// Whether a law dissipates wherever the bounds of its table hold: so that it may be part of one.
bool is_law_of_passive_hybrids(std::string_view law);

std::string passive_hybrid_name(std::string_view law);  ///< "dahl" -> "dahl+passive_network"

}  // namespace dashpot
