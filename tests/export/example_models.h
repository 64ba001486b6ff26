#pragma once
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "damper/kinds/family/example_family.h"
#include "damper/kinds/hybrid/hybrid_model_example.h"
#include "damper/kinds/hysteresis_network/hysteresis_network_example.h"
#include "damper/kinds/law/example_law_text.h"
#include "damper/kinds/narx/narx_example.h"
#include "damper/kinds/passive_hybrid/passive_hybrid_example.h"
#include "damper/kinds/passive_network/passive_network_example.h"
#include "damper/kinds/state_space/state_space_example.h"
#include "dashpot/damper/kinds/fuzzy/fuzzy_model.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/mean/mean_model.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/damper/law_side.h"
#include "dashpot/damper/registry.h"
#include "dashpot/drive.h"
#include "dashpot/export.h"

struct ExampleModel {
  std::string name;  ///< a name in C
  std::shared_ptr<const dashpot::DamperModel> model;
};

/// A law each of whose parameters depends on the current as it does by default, behind a lag of 100
/// 1/s.
inline dashpot::LawModel example_law(const dashpot::Law& law) {
  dashpot::Dependence d;
  for (const dashpot::ParamInfo& info : law.params) {
    d.forms.push_back(info.form);
    d.coefficients.emplace_back(dashpot::coefficient_count(info.form), 0.2 * info.value).front() =
        info.value;
    if (info.form == dashpot::Form::Exponential)
      d.coefficients.back() = {info.value, 1.5 * info.value, 0.7};
    if (info.fit == dashpot::Fit::Drive) d.coefficients.back() = {0, 1};
  }
  return dashpot::LawModel(law, d, dashpot::DriveUnit::Ampere, 100);
}

/// Velocity and current, ten tanh neurons, random weights; a force of some 1 kN.
inline dashpot::Mlp example_mlp(std::uint64_t seed) {
  dashpot::Mlp mlp;
  mlp.layers = {2, 10, 1};
  mlp.input_mean = {0, 1};
  mlp.input_scale = {0.1, 1};
  mlp.output_scale = 1000;
  initialise(mlp, seed);
  return mlp;
}

inline dashpot::FuzzyModel example_fuzzy() {
  using Shape = dashpot::Membership::Shape;
  const dashpot::Sugeno sugeno{
      .inputs = {{0, 0.1}, {0, 0.1}, {1}},
      .memberships = {{Shape::Bell, 0}, {Shape::Gaussian, 1}, {Shape::Sigmoid, 2}},
      .rules = {{0, 1}, {1, 2}},
      .consequents = {1, 2, 3, 4, 5, 6, 7, 8},
      .output_scale = 100};
  return {"takagi_sugeno",
          dashpot::FuzzyInputs({"velocity", "velocity_change", "current"}, {0.01, 0.02}, "test"),
          sugeno};
}

/// The same network with narrow ranges, so that motions go beyond them, and this gain of the
/// velocity in place of its own.
inline dashpot::GatedNetwork narrowed(dashpot::GatedNetwork network, double gain) {
  for (std::size_t k = 0; k < network.motions(); ++k) {
    network.signals[k].low = -0.4;
    network.signals[k].high = 0.5;
  }
  double* const row = &network.gates[network.gate_count()];
  std::fill_n(row, network.gate_count(), 0.0);
  *row = gain;
  return network;
}

/// Two members of a kind, one whose velocity goes on beyond its range and one whose does not.
template <class Member>
std::vector<Member> beyond_their_ranges(std::vector<Member> two) {
  two[0].network = narrowed(two[0].network, 0.6);
  two[1].network = narrowed(two[1].network, -0.6);
  return two;
}

/// Their mean, each weighted by its place, moved by 2 N.
template <class... Models>
dashpot::MeanModel mean_of(const Models&... models) {
  std::vector<dashpot::MeanModel::Member> members;
  const auto add = [&](const auto& model) {
    constexpr auto kCount = static_cast<double>(sizeof...(models));
    const auto place = static_cast<double>(members.size() + 1);
    members.push_back({std::shared_ptr<const dashpot::DamperModel>(model.with_offset(0)),
                       place / (kCount * (kCount + 1) / 2)});
  };
  (add(models), ...);
  return dashpot::MeanModel(std::move(members), 2);
}

/// Every law, laws from files, and every other kind of model.
inline std::vector<ExampleModel> example_models() {
  using namespace dashpot;
  std::vector<ExampleModel> models;
  const auto add = [&](const std::string& name, auto model) {
    models.push_back({name, std::make_shared<const decltype(model)>(std::move(model))});
  };
  for (const Law* law : laws()) add(std::string(law->name), example_law(*law));
  for (const char* law : {"bingham", "bouc_wen"})
    add(std::string(law) + "_apart", example_law(with_side(find_law(law))));
  add("law_of_file", example_law(example_law_text()->law()));
  add("law_of_file_apart", example_law(with_side(example_law_text()->law())));
  add("law_of_file_travels", example_law(travelling_law_text()->law()));
  const std::vector<std::string> inputs{"velocity", "current"};
  add("mlp", NetworkModel("mlp_one_sensor", inputs, {example_mlp(1)}));
  add("mlp_ensemble", NetworkModel("mlp_one_sensor", inputs, {example_mlp(1), example_mlp(2)}, 3));
  const Regressors regressors = example_regressors();
  add("narx",
      NarxModel("narx_one_sensor", regressors,
                {example_narx_network(regressors), example_narx_network(regressors, 2)}, 4));
  add("hysteresis_network",
      HysteresisNetworkModel("hysteresis_network",
                             {example_hysteresis_network(1), example_hysteresis_network(2)}, 2));
  add("state_space",
      StateSpaceModel("neural_state_space", {example_state_space(1), example_state_space(2)}, 2));
  add("hysteresis_network_beyond",
      HysteresisNetworkModel("hysteresis_network",
                             beyond_their_ranges(std::vector{example_hysteresis_network(1),
                                                             example_hysteresis_network(2)})));
  add("state_space_beyond",
      StateSpaceModel("neural_state_space", beyond_their_ranges(std::vector{
                                                example_state_space(1), example_state_space(2)})));
  add("passive_network",
      PassiveNetworkModel("passive_network",
                          {example_passive_network(1), example_passive_network(2)}, 2));
  add("fuzzy", example_fuzzy());
  add("hybrid", example_hybrid());
  add("passive_hybrid", example_passive_hybrid());
  add("mean_of_laws", mean_of(example_law(find_law("bouc_wen")), example_law(find_law("bouc_wen")),
                              example_law(find_law("tanh_kwok"))));
  add("mean_of_networks",
      mean_of(
          HysteresisNetworkModel("hysteresis_network",
                                 {example_hysteresis_network(1), example_hysteresis_network(2)}, 2),
          StateSpaceModel("neural_state_space", {example_state_space(1)}),
          PassiveNetworkModel("passive_network", {example_passive_network(1)}),
          NetworkModel("mlp_one_sensor", inputs, {example_mlp(1)})));
  add("mean_of_hybrids", mean_of(example_hybrid(), example_passive_hybrid(), example_fuzzy(),
                                 example_law(example_law_text()->law())));
  add("family_gated", example_family());
  add("family_residual", example_family(FamilyTarget::Residual));
  add("family_network", example_family_network());
  add("family_physics", example_family_physics());
  add("family_lag", example_family_lag());
  return models;
}

inline dashpot::ExportedModel exported(const dashpot::DamperModel& model) {
  return {.model = model, .domain = {-0.02, 0.02, -0.3, 0.3, 0, 2}, .origin = "made up for a test"};
}
