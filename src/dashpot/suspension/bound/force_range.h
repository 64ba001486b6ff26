#pragma once
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "dashpot/damper_model.h"

namespace dashpot {

/// The forces that a semi-active damper can give at a velocity: any between its softest and its
/// hardest, and beside them a spring's. Straight between the velocities of the table.
struct ForceRange {
  std::vector<double> velocity;    ///< m/s, ascending
  std::vector<double> soft, hard;  ///< N, positive when they resist extension
  /// N/m of displacement, beside soft and hard: what a law's dependence on it has of a spring. The
  /// rest of that dependence makes soft and hard lie further apart.
  double stiffness = 0;
  double travel = std::numeric_limits<double>::infinity();  ///< m either way, that this holds for
  /// Narrower ranges for some displacements each, of the same velocities, which together are as
  /// wide as this one. Empty: it holds for all.
  std::vector<ForceRange> parts;
  double from = -std::numeric_limits<double>::infinity(),
         to = std::numeric_limits<double>::infinity();  ///< m, that a part is of
  /// Whether it is known up to the ends of the table only. Otherwise it goes straight on outside.
  bool ends = false;
  /// Least and greatest force, N, of the damper itself at a displacement, m, and a velocity, m/s;
  /// within the range. Empty: those of the range.
  std::function<std::pair<double, double>(double, double)> reach;

  /// The part for a displacement, or this.
  const ForceRange& at(double displacement) const noexcept;
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

  /// The lower and the upper force at each velocity of the table: between these and straight lines
  /// between them lie all forces, also where soft and hard change places.
  double least(std::size_t node) const noexcept;
  double greatest(std::size_t node) const noexcept;
};

/// Any damping in between, N*s/m. Throws Error where least > greatest.
ForceRange damping_range(double least, double greatest);

/// Where a damper is asked for its forces.
struct RangeLimits {
  double current_min = 0, current_max = 0;  ///< A
  double velocity = 0;                      ///< m/s either way
  double displacement = 0;  ///< m either way; 0: its force does not depend on displacement
};
/// A force without memory, N, of displacement, velocity and current.
using StaticForce = std::function<double(const DamperInput&)>;
/// From the least force to the greatest over the currents and displacements. The force is looked at
/// on a grid, on both sides of 0, where laws jump, and between the velocities of the table, where
/// the range is widened until it has room for what was found there. Forces in proportion to the
/// velocity give a damping_range. Throws Error(name, ...) at limits that make no sense, and where a
/// force is not finite.
ForceRange force_range(const std::string& name, const StaticForce& force,
                       const RangeLimits& limits);
/// That of a damper model by itself. Throws Error where the model has states, and where its force
/// depends on displacement and no travel is stated.
ForceRange model_range(const DamperModel& model, const RangeLimits& limits);
/// Whether there is anything to choose.
bool has_width(const ForceRange& range);

/// A quadratic that no force F of a range, at the displacement x and the velocity v, makes
/// negative:
///   q = ff F^2 + fv F v + vv v^2 + f F + v v + fx F x + vx v x + x x + one >= 0,   ff <= 0.
struct ForceLimit {
  double ff = 0, fv = 0, vv = 0, f = 0, v = 0, fx = 0, vx = 0, x = 0, one = 0;

  double at(double displacement, double velocity, double force) const noexcept {
    return (ff * force + fv * velocity + f + fx * displacement) * force +
           (vv * velocity + v + vx * displacement) * velocity + x * displacement + one;
  }
};
/// Some that hold a range in: sectors, (F - l1(v)) (l2(v) - F) + one for straight lines l1 and l2
/// that meet at the velocity 0. Of a range of damping it is the exact one but for a millionth of a
/// millionth, which leaves room for rounding.
std::vector<ForceLimit> sector_limits(const ForceRange& range);

/// Where a range has corners, also in displacement: at every fourth velocity of its table, for a
/// search.
struct RangeCorner {
  double displacement, velocity, force;  ///< m, m/s, N
};
std::vector<RangeCorner> corners(const ForceRange& range);

}  // namespace dashpot
