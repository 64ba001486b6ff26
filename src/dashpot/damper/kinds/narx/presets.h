#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/kinds/network/presets.h"
#include "dashpot/damper/model_info.h"

namespace dashpot {

/// A network that reads past inputs and forces, known by name.
struct NarxPreset {
  std::string_view name, title, equation, source, remarks;
  std::vector<std::string> inputs;  ///< "displacement", "velocity", "current"
  std::vector<std::size_t> hidden;  ///< neurons per hidden layer
  std::size_t delays = 0;           ///< past values of each input
  std::size_t feedback = 0;         ///< past forces fed back

  ModelInfo info() const;
};
std::span<const NarxPreset> narx_presets();

/// A static network as one that may read past inputs, too: it has the same name, and neither
/// delays nor feedback of its own.
NarxPreset narx_preset(const NetworkPreset& preset);

}  // namespace dashpot
