#include "dashpot/damper/kinds/passive_hybrid/presets.h"

#include <algorithm>
#include <array>
#include <vector>

#include "dashpot/damper/law_list.h"

namespace dashpot {
namespace {

/// Laws that take energy out of every motion at constant drive wherever the bounds of their tables
/// hold: Law::dissipates says why. A law with a filter, or one that is only measured, does not.
constexpr std::array<std::string_view, 20> kProvenLaws{
    "bingham",
    "biviscous",
    "bouc_wen",
    "compressible_chambers",
    "dahl",
    "elastoplastic",
    "extended_bingham",
    "field_chain",
    "large_scale_bouc_wen",
    "modified_bouc_wen",
    "modified_lugre",
    "normalised_bouc_wen",
    "plate_bingham",
    "plate_bingham_mixed",
    "plate_bingham_shear",
    "plate_herschel_bulkley",
    "semi_phenomenological",
    "tanh_guo",
    "tanh_kwok",
    "viscous_dahl",
};
constexpr std::string_view kUsualLaw = "large_scale_bouc_wen";  // the best on measured dampers

PassiveHybridPreset passive_hybrid_of(const Law& law) {
  const PassiveNetworkPreset& network = find_preset(passive_network_presets(), "passive_network");
  return {
      .name = passive_hybrid_name(law.name),
      .title = std::string(law.title) + " beside a passive network",
      .equation =
          std::string(law.equation) +
          "\nis F_law, and of the model  F = (1 - b) F_law + b F_network,  0 <= b <= 1,  with the "
          "force of passive_network",
      .source = std::string(law.source) + "; the network beside it is Dashpot's own",
      .remarks =
          std::string(law.remarks) + (law.remarks.empty() ? "" : " ") +
          "Two dampers that share a motion: neither knows of the other, and what they take out "
          "adds up. Both are fitted as by themselves; then b is the share that predicts best "
          "what was held back in turn from both: motions, and the ends of the drive.",
      .law = &law,
      .network = &network,
      .usual = law.name == kUsualLaw};
}

}  // namespace

ModelInfo PassiveHybridPreset::info() const {
  ModelInfo info{name, ModelKind::PassiveHybrid, title, equation, source, remarks};
  info.inputs = network->info().inputs;
  info.law = law;
  info.usual = usual;
  return info;
}

std::span<const PassiveHybridPreset> passive_hybrid_presets() {
  static const std::vector<PassiveHybridPreset> kHybrids = [] {
    std::vector<PassiveHybridPreset> hybrids;
    for (const Law* law : laws())
      if (is_law_of_passive_hybrids(law->name)) hybrids.push_back(passive_hybrid_of(*law));
    return hybrids;
  }();
  return kHybrids;
}

bool is_law_of_passive_hybrids(std::string_view law) {
  return std::ranges::find(kProvenLaws, law) != kProvenLaws.end();
}

std::string passive_hybrid_name(std::string_view law) {
  return std::string(law) + "+passive_network";
}

}  // namespace dashpot
