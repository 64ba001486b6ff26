#include "dashpot/damper/laws/field_chain.h"

#include "dashpot/damper/laws/plate_bingham.h"
#include "support.h"

namespace {

/// A circuit that gives TC-3.2b's 2.15216 T/A before saturation.
FieldChain chain(double current) {
  const double core = 0.06, gap = 0.002, permeability = 2000;
  return {.c0 = 1120,
          .f_m = 2400,
          .f_f = 20,
          .turns = 2.15216 * (core / permeability + gap) / DASHPOT_MU0,
          .current = current,
          .core_length = core,
          .gap_length = gap,
          .permeability = permeability,
          .B_sat = 1.40056,
          .f0 = -3,
          .v_s = 0};
}

}  // namespace

TEST_CASE(
    "field_chain: the yield stress of TC-3.2b at its currents, of either sign, and held beyond") {
  const double stress[] = {20121.717, 34513.214, 44914.487, 51686.399,
                           55792.833, 58081.816, 59164.705};
  for (int k = 0; k < 7; ++k) {
    const FieldChain p = chain(0.25 * (k + 1)), reversed = chain(-0.25 * (k + 1));
    CHECK_CLOSE(field_chain_yield_stress(&p), stress[k], 2e-6,
                0);  // its two numbers have six digits
    CHECK(field_chain_yield_stress(&reversed) == field_chain_yield_stress(&p));
  }
  const FieldChain far = chain(1000);
  CHECK_CLOSE(field_chain_yield_stress(&far), 59456.1, 1e-6, 0);
}

TEST_CASE(
    "field_chain: its force is plate_bingham's at that yield stress, with friction and offset") {
  const FieldChain p = chain(0.5);
  const PlateBingham flow{.c0 = 1120, .f_y = 2400 * 34513.214 / 59456.1, .f0 = 0, .v_s = 0};
  for (const double v : {-0.2, 0.001, 0.4})
    CHECK_CLOSE(field_chain_force(&p, 0, v, nullptr),
                plate_bingham_force(&flow, 0, v, nullptr) + std::copysign(20, v) - 3, 3e-6, 0);
  CHECK(field_chain_force(&p, 0, 0, nullptr) == -3);
}
