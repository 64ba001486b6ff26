#pragma once
#include "dashpot/physics/read_points.h"

namespace dashpot {

/// What a material's file states of its flux: points of A/m and T that rise from [0, 0]. Throws
/// Error at the point that does not.
CurvePoints read_flux_curve(const Value& value);

/// H, A/m, at a flux density of 0 or more, T: straight between the points. Beyond the last one the
/// material adds nothing to the vacuum.
double field_on(const CurvePoints& curve, double flux_density) noexcept;

}  // namespace dashpot
