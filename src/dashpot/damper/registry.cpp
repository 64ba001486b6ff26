#include "dashpot/damper/registry.h"

#include <algorithm>
#include <array>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"

namespace dashpot {

extern const Law kArctan, kBingham, kBiviscous, kBoucWen, kChebyshev, kCompressibleChambers, kDahl,
    kElastoplastic, kExtendedBingham, kFieldChain, kHystereticBiviscous, kLandauSurrogate, kLargeScaleBoucWen,
    kLookupMap, kModifiedBoucWen, kModifiedLugre, kNormalisedBoucWen, kPlateBingham, kPlateBinghamMixed,
    kPlateBinghamShear, kPlateHerschelBulkley, kPolynomial, kSemiPhenomenological, kSigmoid,
    kTanhAcceleration, kTanhGuo, kTanhKwok, kViscousDahl;

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
    "Tudon-Martinez et al., the one-sensor paper: static network 8.22 % and 4.38 % (rms / half span)";

const std::array<NetworkPreset, 2>& presets() {
  static const std::array<NetworkPreset, 2> kPresets{{
      {.name = "mlp_one_sensor",
       .title = "Static network, one sensor",
       .equation = "F = w2 . tanh(W1 [v, i] + b1) + b2",
       .source = kOneSensorPaper,
       .remarks =
           "41 parameters; no state and no displacement, so no hysteresis. The activation is not stated in "
           "the source; tanh with a linear output is assumed.",
       .inputs = {"velocity", "current"},
       .hidden = {10}},
      {.name = "mlp_two_sensors",
       .title = "Static network, two sensors",
       .equation = "F = w2 . tanh(W1 [x, v, i] + b1) + b2",
       .source = kOneSensorPaper,
       .remarks =
           "51 parameters; displacement tells the branches of a loop apart, for motions like those it was "
           "trained on.",
       .inputs = {"displacement", "velocity", "current"},
       .hidden = {10}},
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
     .remarks =
         "Velocity and current only. States that nothing feeds back to, so the force is bounded for bounded "
         "inputs. Weights and logarithms of rates are learnt together in free run over whole records, by "
         "Levenberg-Marquardt with exact derivatives; the price of weights is the one with which trials "
         "foretell best what was held back from them: conditions, inner levels of the current, or the ends "
         "of the training records. The four members differ in their random start. Where the current is "
         "steady within each record, one current lag stays at 10 ms, which such data do not tell. Fitted to "
         "at most 8 000 samples, every k-th.",
     .path_states = 5,
     .velocity_lags = 2,
     .current_lags = 3,
     .hidden = 10,
     .members = 4},
}};

const std::array<FuzzyPreset, 2>& grids() {
  static const std::array<FuzzyPreset, 2> kPresets{{
      {.name = "anfis",
       .title = "ANFIS (adaptive neuro-fuzzy)",
       .equation = "F = sum_r w_r (p_r v + q_r d + s_r i + t_r) / sum_r w_r,  d = v - v_past,\n"
                   "w_r = product of bells 1 / (1 + |(u - c) / a|^2b) over u = v, d",
       .source = "Jang, IEEE Trans. Systems, Man, and Cybernetics 23 (1993) 665; for MR dampers Schurter and "
                 "Roschke, FUZZ-IEEE (2000) 122",
       .remarks =
           "Hybrid learning: consequents by least squares, bells by Levenberg-Marquardt on what that leaves, "
           "instead of the source's steepest descent. The past velocity is that after a first-order lag, not "
           "a sample ago, so that the model does not hang on the sample time; where the current changes, the "
           "coil lags too. Rules are linear in the current and not split by it, so that nothing is invented "
           "between the levels of steady currents. Fitted to at most 20 000 samples, every k-th.",
       .shape = Membership::Shape::Bell,
       .inputs = {"velocity", "velocity_change", "current"},
       .sets = {5, 2, 1}},
      {.name = "takagi_sugeno",
       .title = "Takagi-Sugeno, static",
       .equation = "F = sum_r w_r (p_r v + q_r i + s_r) / sum_r w_r,  w_r = exp(-((v - c_r) / a_r)^2 / 2)",
       .source = "Takagi and Sugeno, IEEE Trans. Systems, Man, and Cybernetics 15 (1985) 116",
       .remarks =
           "Local straight lines over the velocity; learnt as anfis is. No displacement and, at steady "
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

[[noreturn]] void throw_unknown(std::string_view name, const std::string& where) {
  throw Error(where, "unknown model '" + std::string(name) + "'", suggest(name, model_names()));
}

}  // namespace

std::span<const Law* const> laws() { return kLaws; }

std::span<const NetworkPreset> network_presets() { return presets(); }

std::span<const StateNetworkPreset> state_network_presets() { return kStateNetworks; }

std::span<const FuzzyPreset> fuzzy_presets() { return grids(); }

bool ModelInfo::needs_displacement() const {
  return std::find(inputs.begin(), inputs.end(), "displacement") != inputs.end();
}

ModelInfo model_info(std::string_view name, const std::string& where) {
  if (const Law* law = law_named(name)) {
    ModelInfo info{law->name, "law", law->title, law->equation, law->source, law->remarks, {}};
    if (law->needs_displacement) info.inputs.push_back("displacement");
    info.inputs.insert(info.inputs.end(), {"velocity", "current"});
    return info;
  }
  for (const NetworkPreset& p : network_presets())
    if (p.name == name) return {p.name, "network", p.title, p.equation, p.source, p.remarks, p.inputs};
  for (const StateNetworkPreset& p : state_network_presets())
    if (p.name == name)
      return {p.name, "state_network", p.title, p.equation, p.source, p.remarks, {"velocity", "current"}};
  for (const FuzzyPreset& p : fuzzy_presets())
    if (p.name == name) return {p.name, "fuzzy", p.title, p.equation, p.source, p.remarks, p.inputs};
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
  for (const FuzzyPreset& preset : fuzzy_presets()) names.emplace_back(preset.name);
  for (const FamilyPreset& preset : family_presets()) names.emplace_back(preset.name);
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

const StateNetworkPreset& find_state_network_preset(std::string_view name, const std::string& where) {
  for (const StateNetworkPreset& preset : state_network_presets())
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

bool is_law(std::string_view name) { return law_named(name) != nullptr; }

}  // namespace dashpot
