#include "dashpot/damper/kinds/hybrid/presets.h"

#include <algorithm>
#include <array>
#include <vector>

#include "dashpot/damper/law_list.h"

namespace dashpot {
namespace {

/// The best on measured dampers among the laws that hybrids were tried with: docs/decisions/009.
constexpr std::array<std::string_view, 2> kUsualHybrids{"large_scale_bouc_wen",
                                                        "modified_bouc_wen"};

std::string equation_of(const Law& law) {
  return std::string(law.equation) +
         "\nand to F is added  sum_j (sum_k G_jk c_k(i)) t_j,\n"
         "t = [1, s, tanh(W [s, i] + b)],  c = [1, i_m, i_m i_n],  s: v" +
         (law.needs_displacement ? ", x" : "") + (law.states.empty() ? "" : ", the states") +
         " and F of the law, mixed";
}

std::string remarks_of(const Law& law) {
  return (law.remarks.empty() ? "" : std::string(law.remarks) + " ") +
         "The parameters of the law and the weights of the network are fitted together, in free "
         "run, by Levenberg-Marquardt from the law's own fit; so the law's parameters are no "
         "properties of the damper here and have no intervals. The network reads what the law "
         "knows; where the drive varies within the records, also a bank of Dahl states and lags. "
         "The weight decay is the one with which trials predict held-back data best. Nothing "
         "feeds back, and beyond the training data the network's part stays as at their edge.";
}

HybridPreset hybrid_of(const Law& law) {
  return {.name = hybrid_name(law.name),
          .title = std::string(law.title) + " with a network",
          .equation = equation_of(law),
          .source = std::string(law.source) + "; the network on top is Dashpot's own",
          .remarks = remarks_of(law),
          .law = &law,
          .hidden = 8,
          .path_states = 5,
          .velocity_lags = 2,
          .current_lags = 2,
          .usual = std::ranges::find(kUsualHybrids, law.name) != kUsualHybrids.end()};
}

}  // namespace

ModelInfo HybridPreset::info() const {
  ModelInfo info{name, ModelKind::Hybrid, title, equation, source, remarks};
  info.inputs = info_of(*law).inputs;
  info.law = law;
  info.usual = usual;
  return info;
}

std::span<const HybridPreset> hybrid_presets() {
  static const std::vector<HybridPreset> kHybrids = [] {
    std::vector<HybridPreset> hybrids;
    for (const Law* law : laws()) hybrids.push_back(hybrid_of(*law));
    return hybrids;
  }();
  return kHybrids;
}

std::string hybrid_name(std::string_view law) { return std::string(law) + "+network"; }

}  // namespace dashpot
