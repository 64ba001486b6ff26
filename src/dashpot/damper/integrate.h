#pragma once
#include <algorithm>
#include <cmath>

#include "dashpot/damper/model.h"

namespace dashpot {

class LawModel;

/// Motion and coil current within one step of a simulation. The command is linear in time; so is the coil's
/// current, but for a deviation that decays at the lag rate: this is exact.
class InputPath {
 public:
  InputPath(const DamperInput& from, const DamperInput& to, double dt, double lag_rate,
            double coil_current) noexcept
      : from_(from),
        displacement_slope_((to.displacement - from.displacement) / dt),
        velocity_slope_((to.velocity - from.velocity) / dt),
        current_slope_((to.current - from.current) / dt),
        lag_rate_(lag_rate) {
    if (lag_rate == 0) return;
    from_.current -= current_slope_ / lag_rate;
    deviation_ = coil_current - from_.current;
    if (std::abs(deviation_) <= 1e-14 * std::abs(from_.current)) deviation_ = 0;
  }
  double displacement(double t) const noexcept { return from_.displacement + displacement_slope_ * t; }
  double velocity(double t) const noexcept { return from_.velocity + velocity_slope_ * t; }
  double current(double t) const noexcept {
    const double settled = from_.current + current_slope_ * t;
    return deviation_ == 0 ? settled : settled + deviation_ * std::exp(-lag_rate_ * t);
  }
  double top_speed(double dt) const noexcept {
    return std::max(std::abs(from_.velocity), std::abs(velocity(dt)));
  }
  bool current_varies() const noexcept { return current_slope_ != 0 || deviation_ != 0; }

 private:
  DamperInput from_;
  double displacement_slope_, velocity_slope_, current_slope_, lag_rate_, deviation_ = 0;
};

/// Brings a law's states over one step of the simulation, dt long, in as many steps of its own as its rate
/// asks for: classical Runge-Kutta, or the law's own step where that would take many.
void integrate(const LawModel& model, const InputPath& path, double dt, double* z) noexcept;

}  // namespace dashpot
