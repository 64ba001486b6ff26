// Layer: suspension
#pragma once

// A damper in the strut of a plant, with the coil's driver, the inverse and the force loop that
// turn a controller's demand into a current. Models and inverses are shared, never changed. SI.

#include <memory>

#include "dashpot/damper_model.h"
#include "dashpot/driver.h"

namespace dashpot {

class InverseModel;

/// Corrects a wanted force by what the measured one misses. Its integral stands still while the
/// current is at one of its limits.
struct ForceLoop {
  double proportional = 0;  ///< 1
  double integral = 0;      ///< 1/s
  double derivative = 0;    ///< s
  bool is_closed() const noexcept { return proportional != 0 || integral != 0 || derivative != 0; }
};

/// A damper in its strut: model, coil driver, and the way from a demand to a current.
struct MountedDamper {
  std::shared_ptr<const DamperModel> model;
  DriverOptions driver;
  /// From a wanted force to a current. Without it damping is mapped in a straight line onto the
  /// driver's currents, and a force is that damping which gives it at this speed.
  std::shared_ptr<const InverseModel> inverse;
  ForceLoop loop;
  double current = 0;  ///< A, commanded where there is no controller
  /// The damper's travel over the strut's, by which its force counts there as well.
  double motion_ratio = 1;
  /// This piece's force over its model's, as built: neither inverse nor controller knows of it.
  double force_factor = 1;

  /// A force of the model as it acts at the strut, N.
  double at_strut(double force) const noexcept { return motion_ratio * (force_factor * force); }
  /// The motion of the strut as the damper has it.
  DamperInput at_damper(const DamperInput& strut) const noexcept {
    return {motion_ratio * strut.displacement, motion_ratio * strut.velocity, strut.current};
  }
};

}  // namespace dashpot
