#include <array>

#include "dashpot/damper/registry.h"

namespace dashpot {
namespace {

constexpr std::string_view kFamilyPaper =
    "Duchanoy et al. 2019, the family paper: h3x15 of rectified linear units, eight inputs";

FamilyPreset paper_network(std::string_view name, FamilyTarget target) {
  return {.name = name,
          .source = kFamilyPaper,
          .inputs = {"piston_area", "gap_area", "gap", "pole_length", "viscosity", "yield_stress",
                     "velocity", "displacement"},
          .target = target,
          .hidden = {15, 15, 15}};
}

std::array<FamilyPreset, 4> make_presets() {
  std::array<FamilyPreset, 4> presets{
      {{},
       paper_network("family_h3x15", FamilyTarget::YieldForce),
       paper_network("family_h3x15_residual", FamilyTarget::Residual),
       paper_network("family_h3x15_total", FamilyTarget::Total)}};
  presets[0] = {
      .name = "family_gated",
      .title = "Gated family with memory, one sensor",
      .equation =
          "F = sum_j (sum_k W_jk g_k) t_j / s_j,  t = [v, w, v - y, tanh(v / v_m), 1],\n"
          "g = 1, b, b^2, b^3, e, b e, b^2 e, h, L, e h, e L, b h, b L,\n"
          "b = |i| / (|i| + i_half),  e = ln eta,  w' = rho (v - |v| w),  y' = lambda (v - y)",
      .source = "Dashpot's own; b saturates as the family paper's equation 8",
      .remarks =
          "A ridge: nothing but W is fitted. The prices of W, one for what geometry does and "
          "one for the rest, are those with which designs that were left out of the training "
          "are foretold best; what is left over there is the spread of builds, kept in the "
          "model. The field enters by the current and the fluid's viscosity, not by the "
          "yield stress. Fitted also to runs from rest amid the motion, "
          "since what moved before is not always known.",
      .path_states = 5,
      .velocity_lags = 5};
  constexpr std::string_view kPlain =
      "Static, so that displacement stands for the memory. Inputs standardised and trained by "
      "Adam, 200 "
      "epochs "
      "of batches of 100, the rate falling as a cosine from 0.005, with a price of weights; ";
  static const std::array<std::string, 3> kRemarks{
      std::string(kPlain) + "the authors' notebook standardises nothing.",
      std::string(kPlain) + "the share of the plate flow's force is fitted first.",
      std::string(kPlain) + "the whole force, as the authors' notebook trains it."};
  presets[1].title = "The family paper's network, F_Ty";
  presets[1].equation = "F = k x + F_eta(v) + net(A_p, A_g, h, L, eta, T_y, v, x)";
  presets[2].title = "The family paper's network, beside the plate flow";
  presets[2].equation =
      "F = k x + c F_plate(v, T_y) tanh(v / v_s) + net(A_p, A_g, h, L, eta, T_y, v, x)";
  presets[3].title = "The family paper's network, total force";
  presets[3].equation = "F = net(A_p, A_g, h, L, eta, T_y, v, x)";
  for (std::size_t k = 0; k < kRemarks.size(); ++k) presets[k + 1].remarks = kRemarks[k];
  return presets;
}

}  // namespace

std::span<const FamilyPreset> family_presets() {
  static const std::array<FamilyPreset, 4> kPresets = make_presets();
  return kPresets;
}

}  // namespace dashpot
