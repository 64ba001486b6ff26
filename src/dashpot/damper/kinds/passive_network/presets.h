#pragma once
#include <cstddef>
#include <span>
#include <string_view>

#include "dashpot/damper/kinds/passive_network/passive_windows.h"
#include "dashpot/damper/model_info.h"

namespace dashpot {

/// Springs, resistances and the networks that set them, known by name.
struct PassiveNetworkPreset {
  std::string_view name, title, equation, source, remarks;
  bool displacement = true;  ///< reads it where the records have it
  PassiveSizes sizes;
  std::size_t members = 1;  ///< whose mean is the model

  ModelInfo info() const;
};
std::span<const PassiveNetworkPreset> passive_network_presets();

}  // namespace dashpot
