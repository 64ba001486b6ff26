#include "dashpot/suspension/dampers/damper_state.h"

#include <algorithm>
#include <array>

#include "dashpot/damper/inverse/inverse.h"
#include "dashpot/suspension/control/control_text.h"

namespace dashpot {
namespace {

// clang-format off: the texts are taken in
#include "dashpot/suspension/control/c_text/demanded_force.h"
#include "dashpot/suspension/control/c_text/force_loop.h"
#include "dashpot/suspension/control/c_text/straight_current.h"
// clang-format on

}  // namespace

ParameterTable force_loop_settings() {
  static constexpr std::array kRows{
      ParameterRow{"proportional", "1", 0, 0, 100,
                   "of the force that is missed, added to the wanted one"},
      ParameterRow{"integral", "1/s", 0, 0, 1e5,
                   "of its integral, which stands still at a limit of the current"},
      ParameterRow{"derivative", "s", 0, 0, 1, "of its change"}};
  return kRows;
}

CommandPath::CommandPath(const MountedDamper& damper, const ControlLimits& limits,
                         double deflection)
    : damper_(&damper),
      limits_(limits),
      inverse_state_(damper.inverse ? damper.inverse->state_size() : 0) {
  if (damper.inverse)
    damper.inverse->rest(damper.at_damper({deflection, 0, damper.current}), inverse_state_);
}

double CommandPath::wanted_force(const DamperDemand& demand, const DamperInput& now, double force) {
  const double wanted = demanded_force(&demand, now.velocity);
  const ForceLoop& loop = damper_->loop;
  if (!loop.is_closed()) return wanted;
  return force_loop_step(&loop, wanted, force, limits_.sample_time, missed_.data());
}

double CommandPath::by_inverse(double wanted, const DamperInput& now, double force) {
  const double ratio = damper_->motion_ratio;
  const DamperInput motion = damper_->at_damper(now);
  return damper_->inverse->command({.wanted = wanted / ratio,
                                    .displacement = motion.displacement,
                                    .velocity = motion.velocity,
                                    .current = motion.current,
                                    .measured = force / ratio},
                                   inverse_state_);
}

double CommandPath::command(const DamperDemand& demand, const DamperInput& now, double force) {
  if (demand.kind == DamperDemand::Kind::Current) return demand.value;
  if (damper_->inverse) {
    const double current = by_inverse(wanted_force(demand, now, force), now, force);
    const DriverOptions& range = damper_->driver;
    force_loop_limit(current, range.current_min, range.current_max, missed_.data());
    return current;
  }
  return straight_current(&demand, now.velocity, &limits_);
}

DamperState::DamperState(const MountedDamper& damper, const ControlLimits& limits,
                         double deflection)
    : damper_(&damper),
      path_(damper, limits, deflection),
      driver_(damper.driver),
      state_(damper.model->state_size()),
      driver_state_(Driver::kStates),
      command_(damper.current) {
  driver_.rest(damper.current, driver_state_);
  note_rest();
  damper.model->rest(damper.at_damper({deflection, 0, damper.current}), state_);
}

bool DamperState::demand(const DamperDemand& demand, const DamperInput& now, double force) {
  // A damping or a current that stays asks for the same command, whatever the motion.
  const bool stays = demand.kind == demand_.kind && demand.value == demand_.value &&
                     (demand.kind == DamperDemand::Kind::Current ||
                      (demand.kind == DamperDemand::Kind::Damping && !damper_->inverse));
  if (is_at_rest_ && stays) return false;

  demand_ = demand;
  const double before = command_;
  command_ = path_.command(demand, now, force);
  if (is_at_rest_ && command_ == before) return false;
  driver_.command(command_, driver_state_);
  note_rest();
  return command_ != before;
}

void DamperState::advance(const DamperInput& from, const DamperInput& to, double dt) noexcept {
  damper_->model->advance(damper_->at_damper(from), damper_->at_damper(to), dt, state_);
  advance_coil(dt);
}

double DamperState::current_after(double dt) const noexcept {
  std::array<double, Driver::kStates> state;
  std::copy_n(driver_state_.begin(), Driver::kStates, state.begin());
  driver_.advance(dt, state);
  return driver_.current(state);
}

}  // namespace dashpot
