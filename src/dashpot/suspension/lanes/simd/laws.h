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

/// The loop that Bouc-Wen laws have in common, of their parameters P (LoopLanes).
template <class P>
struct BoucWenLoop {
  using Parameters = P;
  static constexpr bool kExists = true;
  static constexpr std::size_t kShape[] = {
      offsetof(P, gamma) / sizeof(Lane), offsetof(P, beta) / sizeof(Lane),
      offsetof(P, A) / sizeof(Lane), offsetof(P, n) / sizeof(Lane)};
  static Lane z_max(const P* p) { return bouc_wen_z_max(p->A, p->gamma, p->beta, p->n); }
  static Lane rate(const P* p) { return p->A / z_max(p); }
  static Lane slope(const P* p, Lane m) {
    return normalised_bouc_wen_slope(p->gamma / (p->gamma + p->beta), p->n, m);
  }
};
struct SimpleLoop : BoucWenLoop<BoucWen> {
  static constexpr std::size_t kState = 0;
  static Lane travel(Lane v, const Lane*) { return v; }
};
struct SeriesLoop : BoucWenLoop<ModifiedBoucWen> {
  static constexpr std::size_t kState = 1;
  static Lane travel(Lane v, const Lane* dz) { return v - dz[0]; }
};

using BinghamLanes = LawLanes<Bingham, bingham_force, nullptr, 0>;
using BoucWenLanes = LawLanes<BoucWen, bouc_wen_force, bouc_wen_derivative, 1, SimpleLoop>;
using ModifiedBoucWenLanes =
    LawLanes<ModifiedBoucWen, modified_bouc_wen_force, modified_bouc_wen_derivative, 2, SeriesLoop>;

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
