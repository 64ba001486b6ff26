#pragma once
#include <string>
#include <vector>

#include "dashpot/dataset.h"
#include "dashpot/monitor.h"
#include "dashpot/physics/damper_description.h"

namespace dashpot {

/// What recordings of a drawn damper tell of what its drawing does not know.
struct PhysicsCalibration {
  /// A number with the interval that holds it with 95 % confidence, as far as the model's errors
  /// are those of the recordings' residuals.
  struct Number {
    std::string name, unit;
    double value = 0, low = 0, high = 0;
    bool is_known = true;  ///< false: the recordings do not tell it
  };
  /// yield_stress and viscosity, times those of the fluid's file; friction N; seal_give m;
  /// stiffness N/m of the spring in series with the flow, the damper's compliance.
  std::vector<Number> numbers;
  /// The yield stress at each constant current by itself, times the file's, the rest as fitted: a
  /// trend says that the shape of tau(H) is not the file's.
  struct Level {
    double current = 0, field = 0, yield_stress = 0;  ///< A, A/m, Pa as fitted at this current
    double ratio = 1;
  };
  std::vector<Level> levels;
  std::vector<std::string> doubts;  ///< numbers that can be traded against each other, and others
  double esr_before = 0, esr_after = 0;  ///< % of the force's power, in free run
  bool converged = false;
  /// The drawing with the calibrated fluid and friction in it.
  DamperDescription damper;
};

/// Plate flow of a Bingham fluid in a drawn damper, in series with a spring, and seal friction with
/// a spring of its own, fitted to free runs of its recordings by least squares, all records alike;
/// each record has an offset of its own. Throws Error where the drawing's fluid is Herschel-Bulkley
/// or its yield stress a number, where the drive is no current, or nothing moves.
PhysicsCalibration calibrate_physics(const DamperDescription& drawing, const Dataset& recordings,
                                     const Monitor& monitor = {});

}  // namespace dashpot
