#pragma once
#include <cstddef>
#include <span>
#include <string_view>

#include "dashpot/damper/model_info.h"

namespace dashpot {

/// A bank of states and the network that reads it, known by name.
struct HysteresisNetworkPreset {
  std::string_view name, title, equation, source, remarks;
  std::size_t path_states = 0, velocity_lags = 0;
  std::size_t current_lags = 0;  ///< one where the current is steady within each record
  std::size_t hidden = 0;        ///< neurons
  std::size_t members = 1;       ///< whose mean is the model

  ModelInfo info() const;
};
std::span<const HysteresisNetworkPreset> hysteresis_network_presets();

}  // namespace dashpot
