#pragma once
#include <cstddef>
#include <span>
#include <string_view>

#include "dashpot/damper/model_info.h"

namespace dashpot {

/// States that act back on themselves and the network that reads them, known by name.
struct StateSpacePreset {
  std::string_view name, title, equation, source, remarks;
  std::size_t path_states = 0, lags = 0;
  std::size_t current_lags = 0;   ///< one where the current is steady within each record
  std::size_t hidden = 0;         ///< neurons of the cell
  std::size_t output_hidden = 0;  ///< neurons of the network that reads the states
  std::size_t members = 1;        ///< whose mean is the model

  ModelInfo info() const;
};
std::span<const StateSpacePreset> state_space_presets();

}  // namespace dashpot
