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

std::array<FamilyPreset, 6> make_presets() {
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
           "to runs from rest in the middle of the motion, since the motion before a record is not "
           "always known.",
       .form = FamilyForm::Gates,
       .path_states = 5,
       .velocity_lags = 5},

      paper_network({.name = "family_h3x15",
                     .title = "Network of the family paper, F_Ty",
                     .equation = "F = k x + F_eta(v) + net(A_p, A_g, h, L, eta, T_y, v, x)",
                     .remarks = "the authors' notebook standardises nothing.",
                     .target = FamilyTarget::YieldForce}),

      paper_network(
          {.name = "family_h3x15_residual",
           .title = "Network of the family paper, beside the plate flow",
           .equation = "F = k x + c F_plate(v, T_y) tanh(v / v_s) + net(A_p, A_g, h, L, eta, T_y, "
                       "v, x)",
           .remarks = "the share of the plate flow's force is fitted first.",
           .target = FamilyTarget::Residual}),

      paper_network({.name = "family_h3x15_total",
                     .title = "Network of the family paper, total force",
                     .equation = "F = net(A_p, A_g, h, L, eta, T_y, v, x)",
                     .remarks = "the whole force, as the authors' notebook trains it.",
                     .target = FamilyTarget::Total}),

      {.name = "family_line",
       .title = "Line family (size and phase)",
       .equation = "F = A (cos p v + sin p w x') / r + F_0,  x' = x - x_0,\n"
                   "r^2 = max(2 (q^2 + (v - q)^2), (v^2 + (w x')^2) / 2) + s^2,  q' = w (v - q),\n"
                   "ln A and p: a line in i, i^2, ln eta, ln L, ln h, or in T_y, ln L, ln h",
       .source = "Dashpot's own: the blind row that every other family has to beat",
       .remarks =
           "Thirteen numbers. Each record gives one size and one phase, an ellipse; two ridge "
           "regressions over the records do the rest. w, x_0 and s are those of the motion of the "
           "fit. Where the fit has seen one fluid only, the yield stress stands for the current "
           "and the fluid. It knows neither plate flow nor friction, and is not for a drive or a "
           "ride: a motion that is no slow sine is not what it was fitted on.",
       .form = FamilyForm::Line},

      {.name = "family_physics",
       .title = "Plate flow with learnt corrections, one sensor",
       .equation =
           "F = g (f_1 + f_2) + F_0,  f_k' = K_k (v - u_k),  f_k = u_k D_k(s_k) / s_k\n"
           "s_k^2 = b (p^2 + (v - p)^2) + (1 - b) u_k^2 + s_0^2,  p' = w (v - p)\n"
           "D_1 = F_seal e^(c i / (i + i_h)),  D_2 = plate flow of c_N N s, c_Y Y (1 +- a)\n"
           "N = 12 eta L A_p^2 h / (A_g h^3),  Y = 2 T L A_p / h",
       .source = "Dashpot's own; plate flow as Phillips 1969, resistances that cannot generate "
                 "energy in series with springs",
       .remarks =
           "Seal friction and plate flow, each in series with a spring: whatever sets their "
           "resistances, they take energy out. The flow's field is the yield stress of the "
           "conditions; the seal's friction may grow with the current over the currents of the "
           "fit, so that the coil does not matter. Geometry acts on the flow as physics has it, "
           "and on its spring as on a column of fluid, times powers of gap, length, area and "
           "viscosity. Every number has a value that it shrinks to, that of physics where there is "
           "one; how much is chosen by leaving designs out of the training.",
       .form = FamilyForm::Physics},
  }};
}

}  // namespace

ModelInfo FamilyPreset::info() const {
  const std::vector<std::string> one_sensor{"velocity", "current"};
  const std::vector<std::string> two_sensors{"displacement", "velocity", "current"};
  return {name,
          ModelKind::Family,
          title,
          equation,
          source,
          remarks,
          form == FamilyForm::Line ? two_sensors
          : inputs.empty()         ? one_sensor
                                   : inputs};
}

std::span<const FamilyPreset> family_presets() {
  static const std::array<FamilyPreset, 6> kPresets = make_presets();
  return kPresets;
}

}  // namespace dashpot
