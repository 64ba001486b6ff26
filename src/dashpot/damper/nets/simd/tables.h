#pragma once
#include "dashpot/damper/nets/kernel.h"

namespace dashpot {

/// All of the kernel for one instruction set.
struct KernelTables {
  Kernel<float> single_precision;
  Kernel<double> double_precision;
  JacobianKernel jacobian;
};
const KernelTables& baseline_kernel();
const KernelTables& avx2_kernel();
const KernelTables& avx512_kernel();

}  // namespace dashpot
