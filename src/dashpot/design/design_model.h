#pragma once
#include <memory>
#include <string>
#include <vector>

#include "dashpot/damper/physics/damper_physics.h"

namespace dashpot {

/// What tells a design's figures from its drawing. Immutable: several threads ask it at a time.
class DesignModel {
 public:
  virtual ~DesignModel() = default;
  virtual std::string name() const = 0;
  /// The description is possible (require_possible). A model that knows only forces takes the other figures
  /// from evaluate_physics. What it cannot tell is not finite, which counts as a constraint that fails.
  virtual DamperPhysics evaluate(const DamperDescription& description,
                                 const DamperOperation& operation) const = 0;
};

/// "physics" is what the description asks for; "physics:plate", "physics:moving_wall" and "physics:paper"
/// take that law of the flow. Throws Error(where, ...) on another name.
std::unique_ptr<DesignModel> make_design_model(const std::string& name, const std::string& where);
std::vector<std::string> design_model_names();

}  // namespace dashpot
