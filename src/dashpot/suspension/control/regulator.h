#pragma once
#include <vector>

#include "dashpot/plant.h"

namespace dashpot {

/// Weights of squares in the cost that a linear-quadratic regulator minimises; that of the body's
/// acceleration at each strut is 1 (s^4/m^2).
struct RegulatorWeights {
  double deflection = 1e3;       ///< 1/s^4, of struts
  double tyre_deflection = 1e4;  ///< 1/s^4
  double force = 0;  ///< 1/kg^2, of damper forces; 0: only what acceleration makes of them
  double top_acceleration = 0;  ///< 1, of the last coordinate: a building's top floor
};

/// K of u = -K [q, q'], forces of the struts on their bodies, N, up (a damper's own force is -u).
/// Row by row, one per strut. q counted from rest on the ground as it is. Throws Error where no
/// gain holds the plant.
std::vector<double> regulator_of(const Plant& plant, const RegulatorWeights& weights);

}  // namespace dashpot
