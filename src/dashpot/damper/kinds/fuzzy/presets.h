#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/kinds/fuzzy/sugeno.h"
#include "dashpot/damper/model_info.h"

namespace dashpot {

/// A grid of fuzzy sets that is known by name.
struct FuzzyPreset {
  std::string_view name, title, equation, source, remarks;
  Membership::Shape shape = Membership::Shape::Bell;
  std::vector<std::string> inputs;  ///< as FuzzyInputs has them
  std::vector<std::size_t> sets;    ///< fuzzy sets per input; 1: no partition

  ModelInfo info() const;
};
std::span<const FuzzyPreset> fuzzy_presets();

}  // namespace dashpot
