#pragma once
#include <optional>
#include <vector>

#include "dashpot/record/characterise.h"

// What two characterisations of the same kind of damper differ by, and by how much more than cycles
// differ among themselves. All in SI.
namespace dashpot {

/// A number of both, and their difference, second less first, with its standard deviation as far
/// as it is known: not a number where it is not.
struct Difference {
  double first = kNoNumber, second = kNoNumber, noise = kNoNumber;
  double value() const { return second - first; }
  double percent() const { return 100 * value() / first; }
  /// Nothing where the noise is not known, else whether the difference is more than twice it.
  std::optional<bool> is_clear() const;
};

/// Forces at one speed and level of the drive.
struct SpeedDifference {
  double speed = 0;  ///< m/s
  /// Mid-stroke forces; damping_force: half of their difference, whose noise is the scatter from
  /// cycle to cycle of both, not divided by their number: what repeats is one campaign. That of the
  /// two directions is not known: each holds the zero of its load cell.
  Difference rebound, compression, damping_force;
};

/// What two characterisations say at one level of the drive that both have.
struct LevelDifference {
  std::optional<double> drive;  ///< A or V
  std::vector<SpeedDifference> speeds;
  /// With the standard errors of both fits as noise; that of static_force, which holds the zero of
  /// the load cell, is not known.
  Difference friction, yield, static_force, rate, knee_rebound, knee_compression;
};

/// The levels that both have (within 2 % of the largest), at `speeds` (m/s), or, without any, at
/// those of `first` that lie within those of `second`.
std::vector<LevelDifference> differences(const Characterisation& first,
                                         const Characterisation& second,
                                         const std::vector<double>& speeds = {});

}  // namespace dashpot
