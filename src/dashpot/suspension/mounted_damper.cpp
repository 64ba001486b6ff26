#include "dashpot/suspension/mounted_damper.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dashpot {

DamperState::DamperState(const MountedDamper& damper, const ControlLimits& limits, double deflection)
    : damper_(&damper),
      limits_(limits),
      driver_(damper.driver),
      state_(damper.model->state_size()),
      driver_state_(Driver::kStates),
      inverse_state_(damper.inverse ? damper.inverse->state_size() : 0),
      command_(damper.current) {
  const DamperInput rest = damper.at_damper({deflection, 0, damper.current});
  driver_.rest(damper.current, driver_state_);
  damper.model->rest(rest, state_);
  if (damper.inverse) damper.inverse->rest(rest, inverse_state_);
}

double DamperState::wanted_force(const DamperDemand& demand, const DamperInput& now) {
  const double wanted = demand.kind == DamperDemand::Kind::Force ? demand.value : demand.value * now.velocity;
  const ForceLoop& loop = damper_->loop;
  if (loop.proportional == 0 && loop.integral == 0 && loop.derivative == 0) return wanted;
  const double missed = wanted - force(now), dt = limits_.sample_time;
  missed_sum_ += missed * dt;
  const double rate = (missed - missed_) / dt;
  missed_ = missed;
  return wanted + loop.proportional * missed + loop.integral * missed_sum_ + loop.derivative * rate;
}

void DamperState::demand(const DamperDemand& demand, const DamperInput& now) {
  if (demand.kind == DamperDemand::Kind::Current) {
    command_ = demand.value;
  } else if (damper_->inverse) {
    const double ratio = damper_->motion_ratio;
    const DamperInput motion = damper_->at_damper(now);
    command_ = damper_->inverse->command({.wanted = wanted_force(demand, now) / ratio,
                                          .displacement = motion.displacement,
                                          .velocity = motion.velocity,
                                          .current = motion.current,
                                          .measured = force(now) / ratio},
                                         inverse_state_);
  } else {
    const double damping = demand.kind == DamperDemand::Kind::Damping ? demand.value
                           : now.velocity != 0                        ? demand.value / now.velocity
                                                                      : limits_.damping_min;
    const double range = limits_.damping_max - limits_.damping_min;
    const double place = range > 0 ? std::clamp((damping - limits_.damping_min) / range, 0.0, 1.0) : 0;
    command_ = limits_.current_min + place * (limits_.current_max - limits_.current_min);
  }
  driver_.command(command_, driver_state_);
}

void DamperState::advance(const DamperInput& from, const DamperInput& to, double dt) noexcept {
  damper_->model->advance(damper_->at_damper(from), damper_->at_damper(to), dt, state_);
  driver_.advance(dt, driver_state_);
}

double DamperState::current_after(double dt) const noexcept {
  std::array<double, Driver::kStates> state;
  std::copy_n(driver_state_.begin(), Driver::kStates, state.begin());
  driver_.advance(dt, state);
  return driver_.current(state);
}

}  // namespace dashpot
