#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/kinds/family/family_baseline.h"
#include "dashpot/damper/model_info.h"

namespace dashpot {

/// A model of a family of dampers, known by name: static networks of its inputs, or gates where it
/// has none.
struct FamilyPreset {
  std::string_view name, title, equation, source;
  std::string remarks;
  std::vector<std::string> inputs;  ///< as family_input_named() has them
  FamilyTarget target = FamilyTarget::Total;
  std::vector<std::size_t> hidden;  ///< rectified linear units per hidden layer
  std::size_t path_states = 0, velocity_lags = 0;

  ModelInfo info() const;
};
std::span<const FamilyPreset> family_presets();

}  // namespace dashpot
