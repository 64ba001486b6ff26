#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/kinds/family/family_baseline.h"
#include "dashpot/damper/model_info.h"

namespace dashpot {

/// What learns the force of a family.
enum class FamilyForm { Gates, Network, Line, Physics };

/// A model of a family of dampers, known by name.
struct FamilyPreset {
  std::string_view name, title, equation, source;
  std::string remarks;
  FamilyForm form = FamilyForm::Network;
  std::vector<std::string> inputs;  ///< of networks, as family_input_named() has them
  FamilyTarget target = FamilyTarget::Total;
  std::vector<std::size_t> hidden;  ///< rectified linear units per hidden layer
  std::size_t path_states = 0, velocity_lags = 0;

  ModelInfo info() const;
};
std::span<const FamilyPreset> family_presets();

}  // namespace dashpot
