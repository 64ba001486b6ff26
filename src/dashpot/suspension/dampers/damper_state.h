#pragma once
#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "dashpot/controller.h"
#include "dashpot/driver.h"
#include "dashpot/mounted_damper.h"
#include "dashpot/suspension/dampers/soft_friction.h"

namespace dashpot {

/// The gains of a ForceLoop, in its order.
ParameterTable force_loop_settings();

/// The way from a controller's demand to a command, A, with the memories of inverse and force loop.
/// The damper must outlive it.
class CommandPath {
 public:
  CommandPath(const MountedDamper& damper, const ControlLimits& limits, double deflection);

  /// now: the strut's motion and the coil's current; force: the damper's at the strut, N.
  double command(const DamperDemand& demand, const DamperInput& now, double force);

 private:
  double wanted_force(const DamperDemand& demand, const DamperInput& now, double force);
  double by_inverse(double wanted, const DamperInput& now, double force);

  const MountedDamper* damper_;
  ControlLimits limits_;
  std::vector<double> inverse_state_;
  std::array<double, 3> missed_{};  ///< memory of the force loop
};

/// The states of a mounted damper: of model, driver, inverse and force loop. Motions and forces are
/// the strut's. It is copied to try a step; the damper must outlive it.
class DamperState {
 public:
  DamperState(const MountedDamper& damper, const ControlLimits& limits, double deflection);

  /// A new demand at this deflection and velocity, with this measured force, N: sets the driver's
  /// command and returns whether it has changed.
  bool demand(const DamperDemand& demand, const DamperInput& now, double force);
  /// From one instant to another one dt s later.
  void advance(const DamperInput& from, const DamperInput& to, double dt) noexcept;
  double force(const DamperInput& input) const noexcept {
    return damper_->at_strut(damper_->model->force(damper_->at_damper(input), state_));
  }
  /// The force from these states of the model, and their rates (DamperModel::flow).
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept {
    return damper_->at_strut(damper_->model->flow(damper_->at_damper(input), state, rates));
  }
  /// The same of a damper that is this law, with its parameters at the present current.
  double flow(const SoftLaw& law, const double* parameters, const DamperInput& input,
              const double* state, double* rates) const noexcept {
    return damper_->at_strut(law.flow(parameters, damper_->at_damper(input), state, rates));
  }
  /// The damper's own speed at this motion of the strut, m/s.
  double speed(const DamperInput& input) const noexcept {
    return damper_->at_damper(input).velocity;
  }
  const MountedDamper& mounted() const noexcept { return *damper_; }
  const DamperModel& model() const noexcept { return *damper_->model; }
  std::span<const double> model_state() const noexcept { return state_; }
  void put_model_state(const double* state) noexcept {
    std::copy_n(state, state_.size(), state_.begin());
  }
  /// The driver alone, without the model.
  void advance_coil(double dt) noexcept {
    if (is_at_rest_) return;
    driver_.advance(dt, driver_state_);
    note_rest();
  }
  /// Whether the coil's current stays as it is while no command comes.
  bool is_steady() const noexcept { return is_at_rest_ || driver_.is_steady(driver_state_); }
  /// s until the current's course has a corner by itself: infinite where none comes.
  double next_corner() const noexcept {
    return is_at_rest_ ? std::numeric_limits<double>::infinity()
                       : driver_.next_corner(driver_state_);
  }
  void meet_corner() noexcept {
    driver_.meet_corner(driver_state_);
    note_rest();
  }
  double current() const noexcept { return driver_.current(driver_state_); }
  /// The coil's current dt s from now.
  double current_after(double dt) const noexcept;
  double command() const noexcept { return command_; }

 private:
  void note_rest() noexcept {
    is_at_rest_ = driver_.options().period == 0 && driver_.is_steady(driver_state_);
  }

  const MountedDamper* damper_;
  CommandPath path_;
  Driver driver_;
  std::vector<double> state_, driver_state_;
  double command_ = 0;
  DamperDemand demand_{DamperDemand::Kind::Force};  ///< the last one; at first none that stays
  /// Neither time nor the same command again changes the driver's state.
  bool is_at_rest_ = false;
};

}  // namespace dashpot
