#pragma once
#include <algorithm>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "dashpot/damper_model.h"

namespace dashpot {

/// A range on one side of the displacements: soft and hard at some of them, N by velocity, and
/// straight between these.
struct RangeSide {
  std::vector<double> displacement;  ///< m, ascending, two at least
  std::vector<std::vector<double>> soft, hard;

  double least(std::size_t place, std::size_t node) const noexcept {
    return std::min(soft[place][node], hard[place][node]);
  }
  double greatest(std::size_t place, std::size_t node) const noexcept {
    return std::max(soft[place][node], hard[place][node]);
  }
};

/// Soft and hard at one displacement, m, or between two neighbouring ones: what a range is there.
/// Looks into the range, which must stay.
class ForceCurves {
 public:
  ForceCurves(const std::vector<double>& velocity, const std::vector<double>& soft,
              const std::vector<double>& hard)
      : velocity_(velocity), soft_{&soft, &soft}, hard_{&hard, &hard} {}
  /// A share of the way from the k-th displacement of a side to the next one.
  ForceCurves(const std::vector<double>& velocity, const RangeSide& side, std::size_t k, double way)
      : velocity_(velocity),
        soft_{&side.soft[k], &side.soft[k + 1]},
        hard_{&side.hard[k], &side.hard[k + 1]},
        way_(way),
        apart_(side.displacement[k + 1] - side.displacement[k]) {}

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
  /// N/m, how a force at a share changes with the displacement.
  double slope_by_displacement(double velocity, double share) const noexcept;

 private:
  const std::vector<double>& velocity_;
  const std::vector<double>*soft_[2], *hard_[2];
  double way_ = 0, apart_ = 0;
};

/// The forces that a semi-active damper can give at a velocity: any between its softest and its
/// hardest, and beside them a spring's. Straight between the velocities of the table.
struct ForceRange {
  std::vector<double> velocity;    ///< m/s, ascending
  std::vector<double> soft, hard;  ///< N, positive when they resist extension
  /// N/m of displacement, beside soft and hard: what a law's dependence on it has of a spring.
  double stiffness = 0;
  double travel = std::numeric_limits<double>::infinity();  ///< m either way, that this holds for
  /// The range by displacement, compression and extension, of the same velocities: soft and hard
  /// are as wide as all of it. Empty: it holds for all displacements.
  std::vector<RangeSide> sides;
  /// The same as it was found, at displacements that are closer and without any room: for a
  /// search.
  std::vector<RangeSide> reached;
  /// Whether it is known up to the ends of the table only. Otherwise it goes straight on outside.
  bool ends = false;
  /// Least and greatest force, N, of the damper itself at a displacement, m, and a velocity, m/s;
  /// within the range. Empty: those of the range.
  std::function<std::pair<double, double>(double, double)> reach;

  /// What is reached at a displacement, as near as a table has it.
  ForceCurves at(double displacement) const noexcept;
  ForceCurves curves() const noexcept { return {velocity, soft, hard}; }
  double force(double v, double share) const noexcept { return curves().force(v, share); }

  /// The lower and the upper force at each velocity of the table: between these and straight lines
  /// between them lie all forces, also where soft and hard change places.
  double least(std::size_t node) const noexcept { return std::min(soft[node], hard[node]); }
  double greatest(std::size_t node) const noexcept { return std::max(soft[node], hard[node]); }
  /// Whether the damper's force, N, spring and all, lies within, or beyond by `slack` at most.
  bool holds(double displacement, double velocity, double force, double slack) const noexcept;
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
/// Whether a damper that stands has no force but its spring's, at any displacement: nothing that it
/// can do sets a car in motion that stands.
bool stands(const ForceRange& range);

/// A quadratic that no force F of a range, at the displacement x and the velocity v, makes
/// negative:
///   q = ff F^2 + fv F v + vv v^2 + f F + v v + fx F x + vx v x + x x + one >= 0,   ff <= 0.
struct ForceLimit {
  double ff = 0, fv = 0, vv = 0, f = 0, v = 0, fx = 0, vx = 0, x = 0, one = 0;

  double at(double displacement, double velocity, double force) const noexcept {
    return (ff * force + fv * velocity + f + fx * displacement) * force +
           (vv * velocity + v + vx * displacement) * velocity + x * displacement + one;
  }
  bool has_displacement() const noexcept { return fx != 0 || vx != 0 || x != 0; }
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
