#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/law.h"

namespace dashpot {

/// Every force law, in alphabetical order.
std::span<const Law* const> laws();

/// A network architecture that is known by name.
struct NetworkPreset {
  std::string_view name, title, equation, source, remarks;
  std::vector<std::string> inputs;  ///< "displacement", "velocity", "current"
  std::vector<std::size_t> hidden;  ///< neurons per hidden layer
};
std::span<const NetworkPreset> network_presets();

/// What every registered model says of itself, law or not.
struct ModelInfo {
  std::string_view name, kind, title, equation, source, remarks;  ///< kind: "law", "network"
  std::vector<std::string> inputs;                                ///< "displacement", "velocity", "current"
  bool needs_displacement() const;
};
/// Throws Error "unknown model 'bouc'; did you mean ...; known: ...".
ModelInfo model_info(std::string_view name, const std::string& where = {});

std::vector<std::string> model_names();  ///< laws, then networks

/// Both throw as model_info does.
const Law& find_law(std::string_view name, const std::string& where = {});
const NetworkPreset& find_network_preset(std::string_view name, const std::string& where = {});
bool is_law(std::string_view name);

}  // namespace dashpot
