#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/family/family_baseline.h"
#include "dashpot/damper/fuzzy/sugeno.h"
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

/// A bank of states and the networks that read it, known by name.
struct StateNetworkPreset {
  std::string_view name, title, equation, source, remarks;
  std::size_t path_states = 0, velocity_lags = 0;
  std::size_t current_lags = 0;  ///< one where the current is steady within each record
  std::size_t hidden = 0;        ///< neurons
  std::size_t members = 1;       ///< whose mean is the model
};
std::span<const StateNetworkPreset> state_network_presets();

/// A grid of fuzzy sets that is known by name.
struct FuzzyPreset {
  std::string_view name, title, equation, source, remarks;
  Membership::Shape shape = Membership::Shape::Bell;
  std::vector<std::string> inputs;  ///< as FuzzyInputs has them
  std::vector<std::size_t> sets;    ///< fuzzy sets per input; 1: no partition
};
std::span<const FuzzyPreset> fuzzy_presets();

/// A model of a family of dampers, known by name: static networks of its inputs, or gates where it has none.
struct FamilyPreset {
  std::string_view name, title, equation, source, remarks;
  std::vector<std::string> inputs;  ///< as family_input_named() has them
  FamilyTarget target = FamilyTarget::Total;
  std::vector<std::size_t> hidden;  ///< rectified linear units per hidden layer
  std::size_t path_states = 0, velocity_lags = 0;
};
std::span<const FamilyPreset> family_presets();

/// What every registered model says of itself, law or not.
struct ModelInfo {
  std::string_view name, kind, title, equation, source, remarks;  ///< kind: as DamperModel::kind
  std::vector<std::string> inputs;  ///< "displacement", "velocity", "current", "velocity_change"
  bool needs_displacement() const;
};
/// Throws Error "unknown model 'bouc'; did you mean ...; known: ...".
ModelInfo model_info(std::string_view name, const std::string& where = {});

std::vector<std::string> model_names();  ///< laws, networks, state networks, fuzzy models, families

/// All throw as model_info does.
const Law& find_law(std::string_view name, const std::string& where = {});
const NetworkPreset& find_network_preset(std::string_view name, const std::string& where = {});
const StateNetworkPreset& find_state_network_preset(std::string_view name, const std::string& where = {});
const FuzzyPreset& find_fuzzy_preset(std::string_view name, const std::string& where = {});
const FamilyPreset& find_family_preset(std::string_view name, const std::string& where = {});
bool is_law(std::string_view name);

}  // namespace dashpot
