#include "dashpot/damper/kinds/fuzzy/presets.h"

#include <array>

namespace dashpot {

ModelInfo FuzzyPreset::info() const {
  return {name, ModelKind::Fuzzy, title, equation, source, remarks, inputs};
}

std::span<const FuzzyPreset> fuzzy_presets() {
  static const std::array<FuzzyPreset, 2> kPresets{{
      {.name = "anfis",
       .title = "ANFIS (adaptive neuro-fuzzy)",
       .equation = "F = sum_r w_r (p_r v + q_r d + s_r i + t_r) / sum_r w_r,  d = v - v_past,\n"
                   "w_r = product of bells 1 / (1 + |(u - c) / a|^2b) over u = v, d",
       .source = "Jang, IEEE Trans. Systems, Man, and Cybernetics 23 (1993) 665; for MR dampers "
                 "Schurter and Roschke, FUZZ-IEEE (2000) 122",
       .remarks =
           "Hybrid learning: consequents by least squares, bells by Levenberg-Marquardt on the "
           "remaining error, instead of the source's steepest descent. The past velocity is that "
           "after a first-order lag, not a sample ago, so that the model does not depend on the "
           "sample time; where the current changes, the coil lags too. Rules are linear in the "
           "current and not split by it, so that nothing is invented between the levels of steady "
           "currents. Fitted to at most 20 000 samples, every k-th.",
       .shape = Membership::Shape::Bell,
       .inputs = {"velocity", "velocity_change", "current"},
       .sets = {5, 2, 1}},

      {.name = "takagi_sugeno",
       .title = "Takagi-Sugeno, static",
       .equation =
           "F = sum_r w_r (p_r v + q_r i + s_r) / sum_r w_r,  w_r = exp(-((v - c_r) / a_r)^2 / 2)",
       .source = "Takagi and Sugeno, IEEE Trans. Systems, Man, and Cybernetics 15 (1985) 116",
       .remarks = "Local straight lines over the velocity; trained as anfis is. No displacement "
                  "and, at steady currents, no state, so no hysteresis.",
       .shape = Membership::Shape::Gaussian,
       .inputs = {"velocity", "current"},
       .sets = {6, 1}},
  }};
  return kPresets;
}

}  // namespace dashpot
