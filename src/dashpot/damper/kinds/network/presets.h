#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/model_info.h"

namespace dashpot {

/// A static network's architecture that is known by name.
struct NetworkPreset {
  std::string_view name, title, equation, source, remarks;
  std::vector<std::string> inputs;  ///< "displacement", "velocity", "current"
  std::vector<std::size_t> hidden;  ///< neurons per hidden layer

  ModelInfo info() const;
};
std::span<const NetworkPreset> network_presets();

inline constexpr std::string_view kOneSensorPaper =
    "Tudon-Martinez et al., the one-sensor paper: static network 8.22 % and 4.38 % (rms / half "
    "span)";

}  // namespace dashpot
