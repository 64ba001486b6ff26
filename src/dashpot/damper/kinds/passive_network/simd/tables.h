#pragma once
#include "dashpot/damper/kinds/passive_network/passive_windows.h"

namespace dashpot {

/// One per instruction set: simd/passive_windows.cpp is compiled for each.
const PassiveKernel& baseline_passive();
const PassiveKernel& avx2_passive();
const PassiveKernel& avx512_passive();

}  // namespace dashpot
