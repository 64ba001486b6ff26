#pragma once
#include "dashpot/suspension/lanes/ride.h"

namespace dashpot {

const RideKernel& baseline_rides();
const RideKernel& narrow_rides();  ///< of AVX2, on its shortest vectors
const RideKernel& avx2_rides();
const RideKernel& avx512_rides();

}  // namespace dashpot
