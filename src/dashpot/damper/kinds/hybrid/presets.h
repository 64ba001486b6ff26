#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "dashpot/damper/law.h"
#include "dashpot/damper/model_info.h"

namespace dashpot {

/// A law with a network on top that learns with it. Every law has one.
struct HybridPreset {
  std::string name, title, equation, source, remarks;  ///< of the law and of the network part
  const Law* law = nullptr;
  std::size_t hidden = 0;                                            ///< neurons
  std::size_t path_states = 0, velocity_lags = 0, current_lags = 0;  ///< of the bank beside the law
  bool usual = false;                                                ///< among model_names()

  ModelInfo info() const;
};
std::span<const HybridPreset> hybrid_presets();

std::string hybrid_name(std::string_view law);  ///< "bingham" -> "bingham+network"

}  // namespace dashpot
