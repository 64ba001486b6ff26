#pragma once
#include <vector>

#include "dashpot/suspension/bound/force_range.h"
#include "dashpot/suspension/bound/sampled_plant.h"
#include "dashpot/suspension/bound/storage_function.h"

namespace dashpot {

/// Forces of a range that make an index small: what a controller that knew the road can have.
struct Course {
  double value = 0;            ///< the index, a mean over the cells
  std::vector<double> shares;  ///< per cell, of the way from the softest force to the hardest
};

/// Under shares that are given.
Course follow_shares(const SampledPlant& car, const ForceRange& range, const RideIndex& index,
                     const std::vector<double>& shares);

/// How far the car moves under them.
MotionSquares motion_under(const SampledPlant& car, const ForceRange& range,
                           const std::vector<double>& shares);

/// From a course to a better one, until none is found: a Riccati sweep back along the course, in
/// which a force at an end of its range stays there and one inside is free, gives a law per cell; a
/// run forward follows it, clipped to the range, as far as the index falls.
Course improve(const SampledPlant& car, const ForceRange& range, const RideIndex& index,
               const Course& course);

}  // namespace dashpot
