#pragma once
#include <cstddef>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"

namespace dashpot {

// Left and right wheels of an axle meet roads that are alike in their long waves. Where nothing
// measures these roads, what they share is among the unknowns.

/// Two inputs of a setup, by their places among its inputs: roads under one axle that nothing
/// measures.
struct RoadPair {
  std::size_t left = 0, right = 0;
};

/// All such pairs. Roads of axles one behind the other are none. Throws Error where three lie side
/// by side, or where one of two is measured.
std::vector<RoadPair> road_pairs(const InPlantSetup& setup);

}  // namespace dashpot
