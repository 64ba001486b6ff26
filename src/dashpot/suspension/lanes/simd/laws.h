#pragma once
#include <math.h>

#include "dashpot/suspension/lanes/simd/dampers.h"

// The laws that ride in lanes. Each is the C text of its law, in which the build has written Lane,
// a number per vehicle, for each double (law_texts.cmake). To add a law: name it in law_texts.cmake
// and in kLaneLaws, and give it a row below. Its functions must not branch on numbers that differ
// from lane to lane: a text leaves those that do out between #ifndef DASHPOT_LAW_IN_LANES and
// #endif.
namespace dashpot {
namespace {

#include "lanes/law_texts.h"

using BinghamLanes = LawLanes<Bingham, bingham_force, nullptr, 0>;
using BoucWenLanes = LawLanes<BoucWen, bouc_wen_force, bouc_wen_derivative, 1>;
using ModifiedBoucWenLanes =
    LawLanes<ModifiedBoucWen, modified_bouc_wen_force, modified_bouc_wen_derivative, 2>;

/// Calls run.operator()<damper>() for a law by its place in kLaneLaws.
template <class Run>
void with_law(std::size_t law, Run run) {
  static_assert(sizeof kLaneLaws == 3 * sizeof *kLaneLaws, "one case per law, in their order");
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
