#pragma once
#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include "dashpot/base/parameter_table.h"
#include "dashpot/damper/driver.h"
#include "dashpot/damper/inverse/inverse.h"
#include "dashpot/damper/model.h"
#include "dashpot/suspension/control/controller.h"

namespace dashpot {

/// Corrects a wanted force by what the measured one misses. Its integral stands still while the
/// current is at one of its limits.
struct ForceLoop {
  double proportional = 0;  ///< 1
  double integral = 0;      ///< 1/s
  double derivative = 0;    ///< s
  bool is_closed() const noexcept { return proportional != 0 || integral != 0 || derivative != 0; }
};
ParameterTable force_loop_settings();

/// A damper in its strut: model, coil driver, and the way from a demand to a current.
struct MountedDamper {
  std::shared_ptr<const DamperModel> model;
  DriverOptions driver;
  /// Wanted force -> current. Without it damping is mapped in a straight line onto the driver's
  /// currents, and a force is that damping which gives it at this speed.
  std::shared_ptr<const InverseModel> inverse;
  ForceLoop loop;
  double current = 0;  ///< A, commanded where there is no controller
  double motion_ratio =
      1;  ///< the damper's travel over the strut's; its force counts there by as much
  /// This piece's force over its model's, as built: neither inverse nor controller knows of it.
  double force_factor = 1;

  /// What a force of the model comes to at the strut.
  double at_strut(double force) const noexcept { return motion_ratio * (force_factor * force); }
  /// The motion of the strut as the damper has it.
  DamperInput at_damper(const DamperInput& strut) const noexcept {
    return {motion_ratio * strut.displacement, motion_ratio * strut.velocity, strut.current};
  }
};

/// The way from a demand to a command, with the memories of inverse and force loop.
class CommandPath {
 public:
  CommandPath(const MountedDamper& damper, const ControlLimits& limits, double deflection);

  /// A; force: what the damper gives now, N.
  double command(const DamperDemand& demand, const DamperInput& now, double force);

 private:
  double wanted_force(const DamperDemand& demand, const DamperInput& now, double force);
  double by_inverse(double wanted, const DamperInput& now, double force);

  const MountedDamper* damper_;
  ControlLimits limits_;
  std::vector<double> inverse_state_;
  std::array<double, 3> missed_{};  // of the force loop
};

/// Its moving parts: states of model, driver, inverse and force loop. Motions and forces are the
/// strut's. Copied to try a step.
class DamperState {
 public:
  DamperState(const MountedDamper& damper, const ControlLimits& limits, double deflection);

  /// A new demand at this deflection and velocity, with this measured force: sets the driver's
  /// command. Whether that is another one than before.
  bool demand(const DamperDemand& demand, const DamperInput& now, double force);
  /// From one instant to another one dt later.
  void advance(const DamperInput& from, const DamperInput& to, double dt) noexcept;
  double force(const DamperInput& input) const noexcept {
    return damper_->at_strut(damper_->model->force(damper_->at_damper(input), state_));
  }
  /// The same from these states of the model, whose rates it gives (DamperModel::flow).
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept {
    return damper_->at_strut(damper_->model->flow(damper_->at_damper(input), state, rates));
  }
  const DamperModel& model() const noexcept { return *damper_->model; }
  std::span<const double> model_state() const noexcept { return state_; }
  void put_model_state(const double* state) noexcept {
    std::copy_n(state, state_.size(), state_.begin());
  }
  /// Without the model.
  void advance_coil(double dt) noexcept { driver_.advance(dt, driver_state_); }
  /// Whether the coil's current stays as it is while no command comes.
  bool is_steady() const noexcept { return driver_.is_steady(driver_state_); }
  /// s until the current's course has a corner by itself: infinite where none comes.
  double next_corner() const noexcept { return driver_.next_corner(driver_state_); }
  void meet_corner() noexcept { driver_.meet_corner(driver_state_); }
  double current() const noexcept { return driver_.current(driver_state_); }
  /// The coil's current dt s from now.
  double current_after(double dt) const noexcept;
  double command() const noexcept { return command_; }

 private:
  const MountedDamper* damper_;
  CommandPath path_;
  Driver driver_;
  std::vector<double> state_, driver_state_;
  double command_ = 0;
};

}  // namespace dashpot
