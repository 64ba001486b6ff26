#pragma once
#include "dashpot/damper/nets/kernel.h"

namespace dashpot {

/// All of the kernel for one instruction set. simd/kernel.cpp makes one table per set; tables of
/// sets that the compiler cannot target do not exist, and only the baseline's exists beside x86-64.
struct KernelTables {
  Kernel<float> single_precision;
  Kernel<double> double_precision;
  JacobianKernel jacobian;
};
const KernelTables& baseline_kernel();
const KernelTables& avx2_kernel();
const KernelTables& avx512_kernel();

}  // namespace dashpot
