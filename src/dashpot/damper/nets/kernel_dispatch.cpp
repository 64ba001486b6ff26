// Chooses the kernel for an instruction set. It stands apart from kernel.h so that simd/tables.h,
// which it includes, may include kernel.h without a circle.
#include <type_traits>

#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/nets/simd/tables.h"

namespace dashpot {
namespace {

const KernelTables& tables(SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::Avx512) return avx512_kernel();
  if (level == SimdLevel::Avx2) return avx2_kernel();
#endif
  (void)level;
  return baseline_kernel();
}

}  // namespace

const std::vector<SimdLevel>& simd_levels() {
  static const std::vector<SimdLevel> kLevels = [] {
    std::vector<SimdLevel> levels{SimdLevel::Baseline};
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("bmi2")) {
      levels.push_back(SimdLevel::Avx2);
      if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
          __builtin_cpu_supports("avx512cd"))
        levels.push_back(SimdLevel::Avx512);
    }
#endif
    return levels;
  }();
  return kLevels;
}

template <class Real>
const Kernel<Real>& kernel(SimdLevel level) {
  if constexpr (std::is_same_v<Real, float>)
    return tables(level).single_precision;
  else
    return tables(level).double_precision;
}
template const Kernel<float>& kernel<float>(SimdLevel level);
template const Kernel<double>& kernel<double>(SimdLevel level);

const JacobianKernel& jacobian_kernel(SimdLevel level) { return tables(level).jacobian; }

}  // namespace dashpot
