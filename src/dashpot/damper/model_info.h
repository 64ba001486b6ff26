#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/model_kind.h"

namespace dashpot {

struct Law;

/// The description of a registered model, whatever its kind. The texts belong to its law or
/// preset, which last as long as the program.
struct ModelInfo {
  std::string_view name;
  ModelKind kind = ModelKind::Law;
  std::string_view title;
  std::string_view equation;  ///< plain text, one relation per line
  std::string_view source;
  std::string_view remarks;         ///< validity, training, what differs from the source; or empty
  std::vector<std::string> inputs;  ///< what it reads: "velocity", "current", "displacement" ...
  const Law* law = nullptr;         ///< the law that it is or has inside; null for others
  bool usual = true;                ///< among model_names(); others are found by name only

  bool needs_displacement() const;
};

/// Throws Error(where, "unknown model 'bouc'; did you mean ...; known: ...").
[[noreturn]] void throw_unknown_model(std::string_view name, const std::string& where,
                                      const std::vector<std::string>& known,
                                      const std::vector<std::string>& more = {});

/// The preset of that name among those of one kind. Throws Error as throw_unknown_model() does.
template <class Preset>
const Preset& find_preset(std::span<const Preset> presets, std::string_view name) {
  std::vector<std::string> known;
  for (const Preset& preset : presets) {
    if (preset.name == name) return preset;
    known.emplace_back(preset.name);
  }
  throw_unknown_model(name, {}, known);
}

}  // namespace dashpot
