#include "dashpot/suspension/lanes/simd/tables.h"

namespace dashpot {

const RideKernel& ride_kernel(std::size_t vehicles) {
#if defined(__x86_64__)
  const SimdLevel level = simd_levels().back();
  if (level != SimdLevel::Baseline && vehicles <= narrow_rides().lanes) return narrow_rides();
  if (level == SimdLevel::Avx512) return avx512_rides();
  if (level == SimdLevel::Avx2) return avx2_rides();
#endif
  (void)vehicles;
  return baseline_rides();
}

}  // namespace dashpot
