#pragma once
#include <vector>

#include "dashpot/damper_model.h"

namespace dashpot {

/// The forces that a semi-active damper can give at a velocity: any between its softest and its
/// hardest. Straight between the velocities of the table, and straight on outside.
struct ForceRange {
  std::vector<double> velocity;    ///< m/s, ascending
  std::vector<double> soft, hard;  ///< N, positive when they resist extension

  /// soft + share (hard - soft), N; share 0 ... 1.
  double force(double velocity, double share) const noexcept;
  /// The same where the force itself slows the motion: the force at velocity `free` + by_force
  /// force.
  double force_against(double free, double by_force, double share) const noexcept;
  /// Where a force lies between soft (0) and hard (1) at a velocity; 0 where both are one.
  double share(double velocity, double force) const noexcept;
  struct Piece {
    double slope, offset;  ///< force = slope velocity + offset
  };
  Piece piece(double velocity, double share) const noexcept;
};

/// Any damping in between, N*s/m. Throws Error where least > greatest.
ForceRange damping_range(double least, double greatest);
/// The range of a damper without memory: from its least force to its greatest over the currents, A;
/// beyond velocity_max, m/s, in proportion to the velocity. Throws Error where the model has
/// states, and at limits that make no sense.
ForceRange model_range(const DamperModel& model, double current_min, double current_max,
                       double velocity_max);
/// Whether there is anything to choose.
bool has_width(const ForceRange& range);

/// A quadratic that no force of a range makes negative:
/// q(v, F) = ff F^2 + fv F v + vv v^2 + one >= 0.
struct ForceLimit {
  double ff = 0, fv = 0, vv = 0, one = 0;
};
/// Those that hold a range in, of the form (F - a v)(b v - F) + one: of a range of damping the
/// exact one. Each is checked along every straight piece of the range.
std::vector<ForceLimit> force_limits(const ForceRange& range);

}  // namespace dashpot
