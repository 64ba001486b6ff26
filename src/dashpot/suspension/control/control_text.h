#pragma once
#include <math.h>  // the C texts say fmin, not std::fmin

#include "dashpot/controller.h"

// What the C texts of c_text/ ask for. They are taken in within namespace dashpot.
namespace dashpot {

using DemandKind = DamperDemand::Kind;
constexpr DemandKind kDemandDamping = DemandKind::Damping, kDemandForce = DemandKind::Force,
                     kDemandCurrent = DemandKind::Current;

}  // namespace dashpot
