#include "dashpot/damper/registry.h"

#include <algorithm>
#include <array>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

extern const Law kArctan, kBingham, kBiviscous, kBoucWen, kChebyshev, kCompressibleChambers, kDahl,
    kElastoplastic, kExtendedBingham, kFieldChain, kHystereticBiviscous, kLandauSurrogate,
    kLargeScaleBoucWen, kLookupMap, kModifiedBoucWen, kModifiedLugre, kNormalisedBoucWen,
    kPlateBingham, kPlateBinghamMixed, kPlateBinghamShear, kPlateHerschelBulkley, kPolynomial,
    kSemiPhenomenological, kSigmoid, kTanhAcceleration, kTanhGuo, kTanhKwok, kViscousDahl;

namespace {

constexpr std::array kLaws{&kArctan,
                           &kBingham,
                           &kBiviscous,
                           &kBoucWen,
                           &kChebyshev,
                           &kCompressibleChambers,
                           &kDahl,
                           &kElastoplastic,
                           &kExtendedBingham,
                           &kFieldChain,
                           &kHystereticBiviscous,
                           &kLandauSurrogate,
                           &kLargeScaleBoucWen,
                           &kLookupMap,
                           &kModifiedBoucWen,
                           &kModifiedLugre,
                           &kNormalisedBoucWen,
                           &kPlateBingham,
                           &kPlateBinghamMixed,
                           &kPlateBinghamShear,
                           &kPlateHerschelBulkley,
                           &kPolynomial,
                           &kSemiPhenomenological,
                           &kSigmoid,
                           &kTanhAcceleration,
                           &kTanhGuo,
                           &kTanhKwok,
                           &kViscousDahl};

constexpr std::string_view kOneSensorPaper =
    "Tudon-Martinez et al., the one-sensor paper: static network 8.22 % and 4.38 % (rms / half "
    "span)";

const std::array<NetworkPreset, 4>& presets() {
  static const std::array<NetworkPreset, 4> kPresets{{
      {.name = "mlp_one_sensor",
       .title = "Static network, one sensor",
       .equation = "F = w2 . tanh(W1 [v, i] + b1) + b2",
       .source = kOneSensorPaper,
       .remarks = "41 parameters; no state and no displacement, so no hysteresis. The activation "
                  "is not stated in "
                  "the source; tanh with a linear output is assumed.",
       .inputs = {"velocity", "current"},
       .hidden = {10}},
      {.name = "mlp_two_sensors",
       .title = "Static network, two sensors",
       .equation = "F = w2 . tanh(W1 [x, v, i] + b1) + b2",
       .source = kOneSensorPaper,
       .remarks = "51 parameters; displacement tells the branches of a loop apart, for motions "
                  "like those it was "
                  "trained on.",
       .inputs = {"displacement", "velocity", "current"},
       .hidden = {10}},
      {.name = "narx_one_sensor",
       .title = "Recurrent network (NARX), one sensor",
       .equation = "F(t) = w2 . tanh(W1 [v(t), v(t-T), v(t-2T), i(t), i(t-T), i(t-2T), F(t-T), "
                   "F(t-2T)] + b1) + b2",
       .source = kOneSensorPaper,
       .remarks =
           "101 parameters. Learnt on the measured force fed back, then in free run over windows "
           "of 10 "
           "and 100 steps and over whole records, which begin without a measured force, by "
           "Levenberg-Marquardt with exact derivatives; the price of weights is the one with which "
           "short "
           "trials foretell best what was held back from them. T: as many samples as fit into 1 "
           "ms, one "
           "at least, of the record with the longest sample time; others are brought to it. A "
           "drive that "
           "is steady within each record is read at present only. The model stands still, and is "
           "reported as diverged, where its force is ten standard deviations from the mean of its "
           "training; --network output=bounded rules that out.",
       .inputs = {"velocity", "current"},
       .hidden = {10},
       .delays = 2,
       .feedback = 2},
      {.name = "narx_two_sensors",
       .title = "Recurrent network (NARX), two sensors",
       .equation = "F(t) = w2 . tanh(W1 [x(t), v(t), i(t), F(t-T)] + b1) + b2",
       .source = kOneSensorPaper,
       .remarks = "61 parameters, the recurrent network of the source; learnt and judged as "
                  "narx_one_sensor is.",
       .inputs = {"displacement", "velocity", "current"},
       .hidden = {10},
       .feedback = 1},
  }};
  return kPresets;
}

constexpr std::array<StateNetworkPreset, 1> kStateNetworks{{
    {.name = "hysteresis_network",
     .title = "Hysteresis-bank network, one sensor",
     .equation = "F = mean of members of  sum_j (sum_k G_jk c_k(u)) t_j,\n"
                 "t = [1, z, tanh(W [z, u] + b)],  z = [v, w, v - y],  c = [1, u_m, u_m u_n],\n"
                 "w' = rho (v - |v| w),  y' = lambda (v - y),  u' = mu (i - u)",
     .source = "Dashpot's own; the states are a bank of Dahl's, AIAA J. 14 (1976) 1675",
     .remarks = "Velocity and current only. States that nothing feeds back to, so the force is "
                "bounded for bounded "
                "inputs. Weights and logarithms of rates are learnt together in free run over "
                "whole records, by "
                "Levenberg-Marquardt with exact derivatives; the price of weights is the one with "
                "which trials "
                "foretell best what was held back from them: conditions, inner levels of the "
                "current, or the ends "
                "of the training records. The four members differ in their random start. Where the "
                "current is "
                "steady within each record, one current lag stays at 10 ms, which such data do not "
                "tell. Fitted to "
                "at most 8 000 samples, every k-th.",
     .path_states = 5,
     .velocity_lags = 2,
     .current_lags = 3,
     .hidden = 10,
     .members = 4},
}};

constexpr std::array<StateSpacePreset, 1> kStateSpaces{{
    {.name = "neural_state_space",
     .title = "Neural state space, one sensor",
     .equation =
         "F = mean of members of  sum_j (sum_k G_jk c_k(u)) t_j,\n"
         "t = [1, z, tanh(V [z, u] + b)],  z = [v, x, v - y],  c = [1, u_m, u_m u_n],\n"
         "x' = r (w - |w| x),  y' = r (w - y),  u' = mu (i - u),\n"
         "w = v + B p,  r = rate exp(3 tanh(D p / 3)),  p = [1, x, u, tanh(W [x, y, v, u, 1])]",
     .source = "Dashpot's own cell; an encoder and a loss over several steps of windows after "
               "Beintema, Toth and "
               "Schoukens, L4DC (2021), and Forgione and Piga, Eur. J. Control 59 (2021) 69",
     .remarks = "Velocity and current only. The states act back on their own speed and rates "
                "through a small "
                "perceptron; without it they are a bank of Dahl states and lags, from which the "
                "training starts. "
                "Bounded for bounded inputs: x stays within -1 ... 1, y near v plus something "
                "bounded. A step is "
                "exact for rates and speeds held over it; steps longer than the model's own (5 ms "
                "at most, kept in "
                "the file) are divided. Learnt first on windows of 400 samples, each run freely "
                "from where an "
                "encoder of past forces and velocities puts the states, then in free run over "
                "whole records from "
                "rest; Levenberg-Marquardt with exact derivatives in both. The encoder is not part "
                "of the model: a "
                "damper that starts from rest has settled under its current. The price of weights "
                "is chosen as for "
                "hysteresis_network. The members differ in their random start.",
     .path_states = 4,
     .lags = 2,
     .current_lags = 2,
     .hidden = 6,
     .output_hidden = 6,
     .members = 3},
}};

const std::array<FuzzyPreset, 2>& grids() {
  static const std::array<FuzzyPreset, 2> kPresets{{
      {.name = "anfis",
       .title = "ANFIS (adaptive neuro-fuzzy)",
       .equation = "F = sum_r w_r (p_r v + q_r d + s_r i + t_r) / sum_r w_r,  d = v - v_past,\n"
                   "w_r = product of bells 1 / (1 + |(u - c) / a|^2b) over u = v, d",
       .source = "Jang, IEEE Trans. Systems, Man, and Cybernetics 23 (1993) 665; for MR dampers "
                 "Schurter and "
                 "Roschke, FUZZ-IEEE (2000) 122",
       .remarks =
           "Hybrid learning: consequents by least squares, bells by Levenberg-Marquardt on what "
           "that leaves, "
           "instead of the source's steepest descent. The past velocity is that after a "
           "first-order lag, not "
           "a sample ago, so that the model does not hang on the sample time; where the current "
           "changes, the "
           "coil lags too. Rules are linear in the current and not split by it, so that nothing is "
           "invented "
           "between the levels of steady currents. Fitted to at most 20 000 samples, every k-th.",
       .shape = Membership::Shape::Bell,
       .inputs = {"velocity", "velocity_change", "current"},
       .sets = {5, 2, 1}},
      {.name = "takagi_sugeno",
       .title = "Takagi-Sugeno, static",
       .equation =
           "F = sum_r w_r (p_r v + q_r i + s_r) / sum_r w_r,  w_r = exp(-((v - c_r) / a_r)^2 / 2)",
       .source = "Takagi and Sugeno, IEEE Trans. Systems, Man, and Cybernetics 15 (1985) 116",
       .remarks = "Local straight lines over the velocity; learnt as anfis is. No displacement "
                  "and, at steady "
                  "currents, no state, so no hysteresis.",
       .shape = Membership::Shape::Gaussian,
       .inputs = {"velocity", "current"},
       .sets = {6, 1}},
  }};
  return kPresets;
}

const Law* law_named(std::string_view name) {
  const auto found =
      std::find_if(kLaws.begin(), kLaws.end(), [&](const Law* law) { return law->name == name; });
  return found == kLaws.end() ? nullptr : *found;
}

/// The best on measured dampers among the laws that hybrids were tried with: docs/decisions/009.
constexpr std::array<std::string_view, 2> kUsualHybrids{"large_scale_bouc_wen",
                                                        "modified_bouc_wen"};

HybridPreset hybrid_of(const Law& law) {
  return {
      .name = hybrid_name(law.name),
      .title = std::string(law.title) + " with a network",
      .equation = std::string(law.equation) +
                  "\nand to F is added  sum_j (sum_k G_jk c_k(i)) t_j,\n"
                  "t = [1, s, tanh(W [s, i] + b)],  c = [1, i_m, i_m i_n],  s: v" +
                  (law.needs_displacement ? ", x" : "") +
                  (law.states.empty() ? "" : ", the states") + " and F of the law, mixed",
      .source = std::string(law.source) + "; the network on top is Dashpot's own",
      .remarks =
          (law.remarks.empty() ? "" : std::string(law.remarks) + " ") +
          "The numbers of the law and the weights of the network are found together, in free run, "
          "by "
          "Levenberg-Marquardt from the law's own fit; so the law's numbers are no properties of "
          "the "
          "damper here and have no intervals. The network reads what the law knows; where the "
          "drive "
          "varies within the records, a bank of Dahl states and lags, too. The price of weights is "
          "the one with which trials foretell best what was held back from them. Nothing feeds "
          "back, and beyond the training data the network's part stays as at their edge.",
      .law = &law,
      .hidden = 8,
      .path_states = 5,
      .velocity_lags = 2,
      .current_lags = 2,
      .usual =
          std::find(kUsualHybrids.begin(), kUsualHybrids.end(), law.name) != kUsualHybrids.end()};
}

[[noreturn]] void throw_unknown(std::string_view name, const std::string& where) {
  throw Error(where, "unknown model '" + std::string(name) + "'",
              suggest(name, model_names(), more_model_names()));
}

}  // namespace

std::span<const Law* const> laws() { return kLaws; }

std::span<const NetworkPreset> network_presets() { return presets(); }

std::span<const StateNetworkPreset> state_network_presets() { return kStateNetworks; }

std::span<const StateSpacePreset> state_space_presets() { return kStateSpaces; }

std::span<const FuzzyPreset> fuzzy_presets() { return grids(); }

std::string hybrid_name(std::string_view law) { return std::string(law) + "+network"; }

std::span<const HybridPreset> hybrid_presets() {
  static const std::vector<HybridPreset> kHybrids = [] {
    std::vector<HybridPreset> hybrids;
    for (const Law* law : laws()) hybrids.push_back(hybrid_of(*law));
    return hybrids;
  }();
  return kHybrids;
}

bool ModelInfo::needs_displacement() const {
  return std::find(inputs.begin(), inputs.end(), "displacement") != inputs.end();
}

ModelInfo model_info(std::string_view name, const std::string& where) {
  const auto inputs_of = [](const Law& law) {
    return law.needs_displacement ? std::vector<std::string>{"displacement", "velocity", "current"}
                                  : std::vector<std::string>{"velocity", "current"};
  };
  if (const Law* law = law_named(name))
    return {law->name,   "law",        law->title,     law->equation,
            law->source, law->remarks, inputs_of(*law)};
  for (const HybridPreset& p : hybrid_presets())
    if (p.name == name)
      return {p.name, "hybrid", p.title, p.equation, p.source, p.remarks, inputs_of(*p.law)};
  for (const NetworkPreset& p : network_presets())
    if (p.name == name)
      return {p.name, p.kind(), p.title, p.equation, p.source, p.remarks, p.inputs};
  for (const StateNetworkPreset& p : state_network_presets())
    if (p.name == name)
      return {p.name,    "state_network",        p.title, p.equation, p.source,
              p.remarks, {"velocity", "current"}};
  for (const StateSpacePreset& p : state_space_presets())
    if (p.name == name)
      return {p.name,    "state_space",          p.title, p.equation, p.source,
              p.remarks, {"velocity", "current"}};
  for (const FuzzyPreset& p : fuzzy_presets())
    if (p.name == name)
      return {p.name, "fuzzy", p.title, p.equation, p.source, p.remarks, p.inputs};
  const FamilyPreset& p = find_family_preset(name, where);
  const std::vector<std::string> inputs =
      p.inputs.empty() ? std::vector<std::string>{"velocity", "current"} : p.inputs;
  return {p.name, "family", p.title, p.equation, p.source, p.remarks, inputs};
}

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const Law* law : laws()) names.emplace_back(law->name);
  for (const NetworkPreset& preset : network_presets()) names.emplace_back(preset.name);
  for (const StateNetworkPreset& preset : state_network_presets()) names.emplace_back(preset.name);
  for (const StateSpacePreset& preset : state_space_presets()) names.emplace_back(preset.name);
  for (const FuzzyPreset& preset : fuzzy_presets()) names.emplace_back(preset.name);
  for (const HybridPreset& preset : hybrid_presets())
    if (preset.usual) names.push_back(preset.name);
  for (const FamilyPreset& preset : family_presets()) names.emplace_back(preset.name);
  return names;
}

std::vector<std::string> more_model_names() {
  std::vector<std::string> names;
  for (const HybridPreset& preset : hybrid_presets())
    if (!preset.usual) names.push_back(preset.name);
  return names;
}

const Law& find_law(std::string_view name, const std::string& where) {
  if (const Law* law = law_named(name)) return *law;
  throw_unknown(name, where);
}

const NetworkPreset& find_network_preset(std::string_view name, const std::string& where) {
  for (const NetworkPreset& preset : network_presets())
    if (preset.name == name) return preset;
  throw_unknown(name, where);
}

const StateNetworkPreset& find_state_network_preset(std::string_view name,
                                                    const std::string& where) {
  for (const StateNetworkPreset& preset : state_network_presets())
    if (preset.name == name) return preset;
  throw_unknown(name, where);
}

const StateSpacePreset& find_state_space_preset(std::string_view name, const std::string& where) {
  for (const StateSpacePreset& preset : state_space_presets())
    if (preset.name == name) return preset;
  throw_unknown(name, where);
}

const FuzzyPreset& find_fuzzy_preset(std::string_view name, const std::string& where) {
  for (const FuzzyPreset& preset : fuzzy_presets())
    if (preset.name == name) return preset;
  throw_unknown(name, where);
}

const FamilyPreset& find_family_preset(std::string_view name, const std::string& where) {
  for (const FamilyPreset& preset : family_presets())
    if (preset.name == name) return preset;
  throw_unknown(name, where);
}

const HybridPreset& find_hybrid_preset(std::string_view name, const std::string& where) {
  for (const HybridPreset& preset : hybrid_presets())
    if (preset.name == name) return preset;
  throw_unknown(name, where);
}

bool is_law(std::string_view name) { return law_named(name) != nullptr; }

const Law* law_inside(std::string_view name) {
  for (const HybridPreset& preset : hybrid_presets())
    if (preset.name == name) return preset.law;
  return law_named(name);
}

}  // namespace dashpot
