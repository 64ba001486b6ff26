#include "dashpot/suspension/steps/plant_equations.h"

#include <algorithm>

#include "dashpot/suspension/dampers/damper_state.h"

namespace dashpot {

PlantEquations::PlantEquations(const PlantForces& forces, const PlantState& start)
    : forces_(forces),
      coordinates_(start.acceleration.size()),
      size_(start.x.size()),
      currents_(start.dampers.size()),
      damper_forces_(start.dampers.size()),
      strut_forces_(start.dampers.size()),
      steady_(start.dampers.size()) {
  for (const DamperState& damper : start.dampers) size_ += damper.model_state().size();
}

void PlantEquations::read(const PlantState& state, double* y) {
  state_ = &state;
  y = std::copy(state.x.begin(), state.x.end(), y);
  for (std::size_t s = 0; s < state.dampers.size(); ++s) {
    const std::span<const double> z = state.dampers[s].model_state();
    y = std::copy(z.begin(), z.end(), y);
    currents_[s] = state.dampers[s].current();
    steady_[s] = state.dampers[s].is_steady();
  }
}

void PlantEquations::rates(double after, const double* y, double* dy) noexcept {
  const std::size_t n = coordinates_;
  const std::span<const double> x(y, 2 * n);
  const double t = state_->time + after;
  const double* z = y + 2 * n;
  double* dz = dy + 2 * n;

  // Each damper's force, and the rates of its states.
  for (std::size_t s = 0; s < currents_.size(); ++s) {
    const DamperState& damper = state_->dampers[s];
    const std::size_t count = damper.model_state().size();
    const double current = steady_[s] ? currents_[s] : damper.current_after(after);
    const DamperInput motion = forces_.strut_motion(s, t, x, current);
    damper_forces_[s] = damper.flow(motion, {z, count}, {dz, count});
    strut_forces_[s] = damper_forces_[s] + forces_.strut_extra(s, motion);
    z += count;
    dz += count;
  }

  // The motion under these forces.
  std::copy_n(y + n, n, dy);
  forces_.accelerate(t, x, strut_forces_, {dy + n, n});
}

void PlantEquations::write_forces(const double* dy, PlantState& state) const {
  state.damper_forces = damper_forces_;
  state.strut_forces = strut_forces_;
  std::copy_n(dy + coordinates_, coordinates_, state.acceleration.begin());
}

void PlantEquations::write(const double* y, const double* dy, double end, PlantState& state) const {
  std::copy_n(y, state.x.size(), state.x.begin());
  y += state.x.size();
  for (DamperState& damper : state.dampers) {
    damper.put_model_state(y);
    y += damper.model_state().size();
    damper.advance_coil(end - state.time);
  }
  state.time = end;
  write_forces(dy, state);
}

}  // namespace dashpot
