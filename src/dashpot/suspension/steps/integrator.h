#pragma once
#include <memory>

#include "dashpot/suspension/steps/step_method.h"

namespace dashpot {

/// Brings a plant through smooth stretches of time. Where every damper's states have rates and the
/// error is controlled, by explicit or implicit steps; else, and with fixed steps, by collocation.
class Integrator {
 public:
  Integrator(const PlantForces& forces, const IntegratorOptions& options, const PlantState& start);

  /// Forces at the state's own instant: after a new current or a jump of the ground.
  void refresh(PlantState& state) { method_->refresh(state); }
  /// From the state's instant to `end`, by way of the instants at which a coil's current has a
  /// corner. False where it is no longer finite.
  bool advance(PlantState& state, double end);

  const StepCounts& counts() const { return method_->counts(); }

 private:
  std::unique_ptr<StepMethod> method_;
};

}  // namespace dashpot
