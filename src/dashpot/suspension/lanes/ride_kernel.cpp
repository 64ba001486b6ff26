#include <array>

#include "dashpot/suspension/lanes/simd/tables.h"

namespace dashpot {

const RideKernel& ride_kernel(SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return avx512_rides();
  if (level == SimdLevel::Avx2) return avx2_rides();
#endif
  (void)level;
  return baseline_rides();
}

std::span<const std::string_view> lane_law_table() {
  static constexpr std::array<std::string_view, 3> kNames{"bingham", "bouc_wen", "modified_bouc_wen"};
  return kNames;
}

}  // namespace dashpot
