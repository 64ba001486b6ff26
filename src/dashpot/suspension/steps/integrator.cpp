#include "dashpot/suspension/steps/integrator.h"

#include <algorithm>
#include <cmath>

#include "dashpot/suspension/dampers/damper_state.h"

namespace dashpot {

PlantState PlantState::at_rest(const Plant& plant, const std::vector<MountedDamper>& dampers,
                               const ControlLimits& limits) {
  PlantState state{.x = std::vector<double>(2 * plant.size()),
                   .damper_forces = std::vector<double>(plant.struts.size()),
                   .strut_forces = std::vector<double>(plant.struts.size()),
                   .acceleration = std::vector<double>(plant.size()),
                   .road = std::vector<FootMotion>(plant.tyres.size())};
  for (const MountedDamper& damper : dampers) state.dampers.emplace_back(damper, limits, 0.0);
  return state;
}

Integrator::Integrator(const PlantForces& forces, const IntegratorOptions& options,
                       const PlantState& start) {
  const bool flows = std::ranges::all_of(
      start.dampers, [](const DamperState& damper) { return damper.model().flows(); });
  method_ = (flows && options.controls_error ? make_switching_steps : make_collocation)(
      forces, options, start);
}

bool Integrator::advance(PlantState& state, double end) {
  while (end - state.time > Driver::kInstant) {
    // To the next corner of some current, or to the end.
    double wait = INFINITY;
    for (const DamperState& damper : state.dampers) wait = std::min(wait, damper.next_corner());
    const bool corner = state.time + wait < end;
    const double next = corner ? state.time + wait : end;
    if (wait >= Driver::kInstant && !method_->advance(state, next)) return false;
    if (!corner) break;
    for (DamperState& damper : state.dampers) damper.meet_corner();
    method_->refresh(state);
  }
  state.time = end;
  return true;
}

}  // namespace dashpot
