#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/inverse/history_network.h"

namespace dashpot {

/// An inverse network that is known by name.
struct InverseNetworkPreset {
  std::string_view name, title, equation, source, remarks;
  std::vector<Tap> taps;
  std::vector<std::size_t> hidden;  ///< neurons per hidden layer, tanh
};

/// All presets, in alphabetical order.
std::span<const InverseNetworkPreset> inverse_network_presets();
std::vector<std::string> inverse_network_names();
/// Throws Error "unknown inverse network 'zhou'; did you mean ...; known: ...".
const InverseNetworkPreset& find_inverse_network(std::string_view name,
                                                 const std::string& where = {});

}  // namespace dashpot
