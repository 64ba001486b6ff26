// Compiled once per instruction set; DASHPOT_KERNEL names the function that hands out the result.
#include "dashpot/damper/nets/simd/neuron_lanes.h"
#include "dashpot/damper/nets/simd/respond.h"
#include "dashpot/damper/nets/simd/sample_lanes.h"
#include "dashpot/damper/nets/simd/tables.h"
#include "dashpot/damper/nets/simd/update.h"

namespace dashpot {
namespace {

template <class Real>
constexpr Kernel<Real> kTable{&forward<Real>, &backward<Real>, &transpose<Real>,
                              &update<Real>,  &respond<Real>,  &evaluate<Real>};
constexpr KernelTables kTables{kTable<float>, kTable<double>, {&add_products, &add_errors}};

}  // namespace

const KernelTables& DASHPOT_KERNEL() { return kTables; }

}  // namespace dashpot
