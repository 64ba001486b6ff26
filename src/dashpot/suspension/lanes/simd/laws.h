#pragma once
#include <math.h>

#include "dashpot/suspension/dampers/loop_path.h"
#include "dashpot/suspension/lanes/simd/dampers.h"

// The laws that ride in lanes. Each is the C text of its law, in which the build has written Lane,
// a number per vehicle, for each double (law_texts.cmake). To add a law: name it in law_texts.cmake
// and in kLaneLaws, and give it a row below. Its functions must not branch on numbers that differ
// from lane to lane: a text leaves those that do out between #ifndef DASHPOT_LAW_IN_LANES and
// #endif.
namespace dashpot {
namespace {

#include "lanes/law_texts.h"

/// What LoopPath wants to know of Bouc-Wen's loop.
struct BoucWenLanesKind {
  using Number = Lane;
  static bool any(LaneMask mask) { return dashpot::any(mask); }
  static Lane exp_of_twice(Lane r) { return dashpot::exp_of_twice<double>(r); }
  static Lane arctanh(Lane m, LaneMask where) {
    for (std::size_t k = 0; k < kWidth; ++k) m[k] = where[k] ? __builtin_atanh(m[k]) : m[k];
    return m;
  }
  static Lane slope(const LoopShape<Lane>& loop, Lane m) {
    return normalised_bouc_wen_slope(loop.sigma, loop.n, m);
  }
};
/// The loop of a law with parameters P: kState, the place of z among its states; kShape, those of
/// the parameters that it depends on; travel(v, dz), m/s, the speed that drives it.
template <class P, std::size_t kPlace>
struct BoucWenLoop {
  static constexpr bool kExists = true;
  using Loop = LoopPath<BoucWenLanesKind>;
  static constexpr std::size_t kState = kPlace;
  static constexpr std::size_t kShape[] = {
      offsetof(P, gamma) / sizeof(Lane), offsetof(P, beta) / sizeof(Lane),
      offsetof(P, A) / sizeof(Lane), offsetof(P, n) / sizeof(Lane)};
  static LoopShape<Lane> shape(const P& p) {
    const Lane z_max = bouc_wen_z_max(p.A, p.gamma, p.beta, p.n);
    return {z_max, p.A / z_max, p.gamma / (p.gamma + p.beta), p.n};
  }
};
struct SimpleLoop : BoucWenLoop<BoucWen, 0> {
  static Lane travel(Lane v, const Lane*) { return v; }
};
struct SeriesLoop : BoucWenLoop<ModifiedBoucWen, 1> {
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
