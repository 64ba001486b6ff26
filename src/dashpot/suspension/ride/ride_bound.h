#pragma once
#include <vector>

#include "dashpot/suspension/bound/bound.h"
#include "dashpot/vehicle.h"

namespace dashpot {

/// Shares of comfort in the indices that a front is made of.
inline constexpr double kFrontWeights[] = {1, 0.8, 0.5, 0.2, 0};

/// The forces that this vehicle's damper can give between its least and its greatest current, at
/// the strut, within a motion. Throws Error(where, ...) where nothing can be proven of it: a damper
/// with a memory, a passive one, a plant that is not a linear quarter car.
ForceRange possible_forces(const Vehicle& vehicle, const StrutMotion& within,
                           const std::string& where);

/// Bounds and optima from comfort alone to road holding alone, both counted as shares of a
/// reference.
std::vector<ClairvoyantBound> front_of_ride(const Plant& plant, const GroundMotion& ground,
                                            const ForceRange& range, const RideSquares& reference,
                                            const BoundOptions& options);

}  // namespace dashpot
