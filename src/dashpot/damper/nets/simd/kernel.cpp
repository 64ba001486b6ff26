// Compiled once per instruction set, into a table of functions of its own. DASHPOT_KERNEL names the
// function that hands the table out; kernel_dispatch.cpp chooses among them.
#include "dashpot/damper/nets/simd/neuron_lanes.h"
#include "dashpot/damper/nets/simd/products.h"
#include "dashpot/damper/nets/simd/respond.h"
#include "dashpot/damper/nets/simd/sample_lanes.h"
#include "dashpot/damper/nets/simd/tables.h"
#include "dashpot/damper/nets/simd/update.h"

namespace dashpot {
namespace {

// The texts above rely on this of the lanes of an instruction set.
static_assert(kKernelAlign % kLaneBytes == 0, "a padded row is whole vectors");
static_assert(kBlock % (kTileColumns<Form::Samples> * kLanes<float>) == 0 &&
                  kBlock % (kTileColumns<Form::Samples> * kLanes<double>) == 0,
              "a row of samples is whole tiles: multiply() has no tail for them");
static_assert(kRoomRows >= kMaxWidth && kMaxWidth % kLanes<float> == 0,
              "inputs that come by whole vectors fit into the room for the widest layer");

template <class Real>
constexpr Kernel<Real> kTable{&forward<Real>, &backward<Real>, &transpose<Real>,
                              &update<Real>,  &respond<Real>,  &evaluate<Real>};
constexpr KernelTables kTables{
    kTable<float>, kTable<double>, {&add_products, &add_errors, &add_gram, &carry}};

}  // namespace

const KernelTables& DASHPOT_KERNEL() { return kTables; }

}  // namespace dashpot
