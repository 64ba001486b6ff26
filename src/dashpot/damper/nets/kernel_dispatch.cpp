// Chooses the kernel for an instruction set. It stands apart from kernel.h so that simd/tables.h,
// which it includes, may include kernel.h without a circle.
#include <string>
#include <type_traits>

#include "dashpot/base/text.h"
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/nets/simd/tables.h"
#include "dashpot/error.h"

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

std::vector<SimdLevel>& levels_in_use() {
  static std::vector<SimdLevel> levels_found = [] {
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
  return levels_found;
}

}  // namespace

const std::vector<SimdLevel>& simd_levels() { return levels_in_use(); }

std::string_view name_of(SimdLevel level) {
  return level == SimdLevel::Avx512 ? "avx512" : level == SimdLevel::Avx2 ? "avx2" : "sse2";
}

void use_simd(std::string_view name, const std::string& asked_by) {
  std::vector<SimdLevel>& levels = levels_in_use();
  std::vector<std::string> known;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    known.emplace_back(name_of(levels[k]));
    if (name_of(levels[k]) != name) continue;
    levels.resize(k + 1);
    return;
  }
  throw Error(asked_by, "this processor does not run " + std::string(name),
              "it runs " + join(known, ", "));
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
