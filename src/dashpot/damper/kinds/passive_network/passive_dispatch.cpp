// Chooses the passes for an instruction set, apart from passive_windows.h so that simd/tables.h may
// include that without a circle.
#include "dashpot/damper/kinds/passive_network/simd/tables.h"

namespace dashpot {

const PassiveKernel& passive_kernel(SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return avx512_passive();
  if (level == SimdLevel::Avx2) return avx2_passive();
#endif
  (void)level;
  return baseline_passive();
}

}  // namespace dashpot
