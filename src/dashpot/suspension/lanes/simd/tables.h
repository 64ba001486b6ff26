#pragma once
#include "dashpot/suspension/lanes/ride.h"

namespace dashpot {

const RideKernel& baseline_rides();
const RideKernel& avx2_rides();
const RideKernel& avx512_rides();

}  // namespace dashpot
