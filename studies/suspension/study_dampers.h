#pragma once
#include <cstdint>

#include "studies/suspension/suspension_study.h"

// The dampers of the suspension study.
namespace dashpot {

/// MR2, a virtual damper, by the paper's network.
NetworkDamper identified_mr2(std::uint64_t seed);
/// A production damper's curve, scaled until it damps like `damping`, N*s/m, at the wheel's
/// resonance: along a sine of 20 mm at 1 m/s; by the same network.
NetworkDamper identified_passive(double damping, std::uint64_t seed);

}  // namespace dashpot
