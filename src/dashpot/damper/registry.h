#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/kinds/family/family_baseline.h"
#include "dashpot/damper/kinds/fuzzy/sugeno.h"
#include "dashpot/damper/law.h"

namespace dashpot {

/// Every force law, in alphabetical order.
std::span<const Law* const> laws();

/// A network architecture that is known by name.
struct NetworkPreset {
  std::string_view name, title, equation, source, remarks;
  std::vector<std::string> inputs;  ///< "displacement", "velocity", "current"
  std::vector<std::size_t> hidden;  ///< neurons per hidden layer
  std::size_t delays = 0;           ///< past values of each input
  std::size_t feedback = 0;         ///< past forces fed back

  std::string_view kind() const { return feedback > 0 ? "narx" : "network"; }
};
std::span<const NetworkPreset> network_presets();

/// A bank of states and the networks that read it, known by name.
struct StateNetworkPreset {
  std::string_view name, title, equation, source, remarks;
  std::size_t path_states = 0, velocity_lags = 0;
  std::size_t current_lags = 0;  ///< one where the current is steady within each record
  std::size_t hidden = 0;        ///< neurons
  std::size_t members = 1;       ///< whose mean is the model
};
std::span<const StateNetworkPreset> state_network_presets();

/// States that act back on themselves and the network that reads them, known by name.
struct StateSpacePreset {
  std::string_view name, title, equation, source, remarks;
  std::size_t path_states = 0, lags = 0;
  std::size_t current_lags = 0;   ///< one where the current is steady within each record
  std::size_t hidden = 0;         ///< neurons of the cell
  std::size_t output_hidden = 0;  ///< neurons of the network that reads the states
  std::size_t members = 1;        ///< whose mean is the model
};
std::span<const StateSpacePreset> state_space_presets();

/// A grid of fuzzy sets that is known by name.
struct FuzzyPreset {
  std::string_view name, title, equation, source, remarks;
  Membership::Shape shape = Membership::Shape::Bell;
  std::vector<std::string> inputs;  ///< as FuzzyInputs has them
  std::vector<std::size_t> sets;    ///< fuzzy sets per input; 1: no partition
};
std::span<const FuzzyPreset> fuzzy_presets();

/// A model of a family of dampers, known by name: static networks of its inputs, or gates where it
/// has none.
struct FamilyPreset {
  std::string_view name, title, equation, source, remarks;
  std::vector<std::string> inputs;  ///< as family_input_named() has them
  FamilyTarget target = FamilyTarget::Total;
  std::vector<std::size_t> hidden;  ///< rectified linear units per hidden layer
  std::size_t path_states = 0, velocity_lags = 0;
};
std::span<const FamilyPreset> family_presets();
/// A law with a network on top that learns with it. Every law has one.
struct HybridPreset {
  std::string name, title, equation, source, remarks;  ///< of the law and of the network part
  const Law* law = nullptr;
  std::size_t hidden = 0;                                            ///< neurons
  std::size_t path_states = 0, velocity_lags = 0, current_lags = 0;  ///< of the bank beside the law
  bool usual = false;                                                ///< among model_names()
};
std::span<const HybridPreset> hybrid_presets();
std::string hybrid_name(std::string_view law);  ///< "bingham" -> "bingham+network"

/// What every registered model says of itself, law or not.
struct ModelInfo {
  std::string_view name, kind, title, equation, source, remarks;  ///< kind: as DamperModel::kind
  std::vector<std::string> inputs;  ///< "displacement", "velocity", "current", "velocity_change"
  bool needs_displacement() const;
};
/// Throws Error "unknown model 'bouc'; did you mean ...; known: ...".
ModelInfo model_info(std::string_view name, const std::string& where = {});

/// Laws, networks, state networks, state spaces, fuzzy models, the usual hybrids and families.
std::vector<std::string> model_names();
/// Hybrids that are known beside model_names().
std::vector<std::string> more_model_names();

/// All throw as model_info does.
const Law& find_law(std::string_view name, const std::string& where = {});
const NetworkPreset& find_network_preset(std::string_view name, const std::string& where = {});
const StateNetworkPreset& find_state_network_preset(std::string_view name,
                                                    const std::string& where = {});
const StateSpacePreset& find_state_space_preset(std::string_view name,
                                                const std::string& where = {});
const FuzzyPreset& find_fuzzy_preset(std::string_view name, const std::string& where = {});
const FamilyPreset& find_family_preset(std::string_view name, const std::string& where = {});
const HybridPreset& find_hybrid_preset(std::string_view name, const std::string& where = {});
bool is_law(std::string_view name);
/// The law itself, or the one inside a hybrid; nullptr where there is none.
const Law* law_inside(std::string_view name);

}  // namespace dashpot
