#include "dashpot/damper/kinds/family/presets.h"

#include <array>

namespace dashpot {
namespace {

constexpr std::string_view kFamilyPaper =
    "Duchanoy et al. 2019, the family paper: h3x15 of rectified linear units, eight inputs";

/// Adds the source, training, inputs and layers that the paper's networks share.
FamilyPreset paper_network(FamilyPreset preset) {
  preset.remarks =
      "Static, so that displacement stands for the memory. Inputs standardised and trained by "
      "Adam, 200 epochs of batches of 100, the learning rate falling as a cosine from 0.005, with "
      "weight decay; " +
      preset.remarks;
  preset.source = kFamilyPaper;
  preset.inputs = {"piston_area", "gap_area",     "gap",      "pole_length",
                   "viscosity",   "yield_stress", "velocity", "displacement"};
  preset.hidden = {15, 15, 15};
  return preset;
}

std::array<FamilyPreset, 4> make_presets() {
  return {{
      {.name = "family_gated",
       .title = "Gated family with memory, one sensor",
       .equation =
           "F = sum_j (sum_k W_jk g_k) t_j / s_j,  t = [v, w, v - y, tanh(v / v_m), 1],\n"
           "g = 1, b, b^2, b^3, e, b e, b^2 e, h, L, e h, e L, b h, b L,\n"
           "b = |i| / (|i| + i_half),  e = ln eta,  w' = rho (v - |v| w),  y' = lambda (v - y)",
       .source = "Dashpot's own; b saturates as the family paper's equation 8",
       .remarks =
           "A ridge regression: nothing but W is fitted. Its two penalties, one on what geometry "
           "does and one on the rest, are those that predict designs left out of the training "
           "best; the remaining error there is the spread of builds, kept in the model. The field "
           "enters by the current and the fluid's viscosity, not by the yield stress. Fitted also "
           "to runs from rest amid the motion, since the motion before a record is not always "
           "known.",
       .path_states = 5,
       .velocity_lags = 5},

      paper_network({.name = "family_h3x15",
                     .title = "The family paper's network, F_Ty",
                     .equation = "F = k x + F_eta(v) + net(A_p, A_g, h, L, eta, T_y, v, x)",
                     .remarks = "the authors' notebook standardises nothing.",
                     .target = FamilyTarget::YieldForce}),

      paper_network(
          {.name = "family_h3x15_residual",
           .title = "The family paper's network, beside the plate flow",
           .equation = "F = k x + c F_plate(v, T_y) tanh(v / v_s) + net(A_p, A_g, h, L, eta, T_y, "
                       "v, x)",
           .remarks = "the share of the plate flow's force is fitted first.",
           .target = FamilyTarget::Residual}),

      paper_network({.name = "family_h3x15_total",
                     .title = "The family paper's network, total force",
                     .equation = "F = net(A_p, A_g, h, L, eta, T_y, v, x)",
                     .remarks = "the whole force, as the authors' notebook trains it.",
                     .target = FamilyTarget::Total}),
  }};
}

}  // namespace

ModelInfo FamilyPreset::info() const {
  const std::vector<std::string> one_sensor{"velocity", "current"};
  return {name,
          ModelKind::Family,
          title,
          equation,
          source,
          remarks,
          inputs.empty() ? one_sensor : inputs};
}

std::span<const FamilyPreset> family_presets() {
  static const std::array<FamilyPreset, 4> kPresets = make_presets();
  return kPresets;
}

}  // namespace dashpot
