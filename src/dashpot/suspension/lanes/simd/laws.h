#pragma once
#include "dashpot/suspension/lanes/simd/dampers.h"

// The laws' own text once more, with a number per lane for each double. It includes nothing but
// math.h, which is here already, so that nothing else sees this.
#include <math.h>
#define DASHPOT_LAW_IN_LANES
#define double Lane
namespace dashpot {
namespace {
#include "dashpot/damper/laws/bingham.h"
#include "dashpot/damper/laws/modified_bouc_wen.h"
}  // namespace
}  // namespace dashpot
#undef double
#undef DASHPOT_LAW_IN_LANES

namespace dashpot {
namespace {

using BinghamLanes = LawLanes<Bingham, bingham_force, nullptr, 0>;
using BoucWenLanes = LawLanes<BoucWen, bouc_wen_force, bouc_wen_derivative, 1>;
using ModifiedBoucWenLanes =
    LawLanes<ModifiedBoucWen, modified_bouc_wen_force, modified_bouc_wen_derivative, 2>;

/// Calls run.operator()<damper>() for a law by its place in lane_law_table().
template <class Run>
void with_law(std::size_t law, Run run) {
  switch (law) {
    case 0:
      return run.template operator()<BinghamLanes>();
    case 1:
      return run.template operator()<BoucWenLanes>();
    case 2:
      return run.template operator()<ModifiedBoucWenLanes>();
  }
}

}  // namespace
}  // namespace dashpot
