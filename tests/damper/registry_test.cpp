#include "dashpot/damper/registry.h"

#include <algorithm>

#include "dashpot/damper/kinds/family/family_force.h"
#include "dashpot/damper/kinds/family/presets.h"
#include "dashpot/damper/kinds/fuzzy/presets.h"
#include "dashpot/damper/kinds/hybrid/presets.h"
#include "dashpot/damper/kinds/hysteresis_network/presets.h"
#include "dashpot/damper/kinds/narx/presets.h"
#include "dashpot/damper/kinds/network/presets.h"
#include "dashpot/damper/kinds/passive_hybrid/presets.h"
#include "dashpot/damper/kinds/passive_network/presets.h"
#include "dashpot/damper/kinds/state_space/presets.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("laws stand in alphabetical order, the other kinds follow in theirs") {
  const std::vector<std::string> names = model_names();
  const auto others = names.begin() + static_cast<std::ptrdiff_t>(laws().size());
  CHECK(std::is_sorted(names.begin(), others));
  CHECK(std::vector<std::string>(others, names.end()) ==
        std::vector<std::string>{
            "mlp_one_sensor", "mlp_two_sensors", "narx_one_sensor", "narx_two_sensors",
            "hysteresis_network", "neural_state_space", "passive_network",
            "passive_network_one_sensor", "anfis", "takagi_sugeno", "large_scale_bouc_wen+network",
            "modified_bouc_wen+network", "large_scale_bouc_wen+passive_network", "family_gated",
            "family_h3x15", "family_h3x15_residual", "family_h3x15_total", "family_line",
            "family_physics"});
  for (const Law* law : laws()) {
    CHECK(&find_law(law->name) == law);
    CHECK(is_law(law->name));
  }
  CHECK_FALSE(is_law("mlp_one_sensor"));
}

TEST_CASE("titles are names, which may stand anywhere in a sentence") {
  for (const std::string& name : model_names()) {
    const std::string title(model_info(name).title);
    CHECK_MESSAGE(!title.starts_with("The "), title);
    CHECK_MESSAGE(!title.starts_with("A "), title);
  }
}

TEST_CASE("the one-sensor paper's networks") {
  // 41, 51 and, recurrent, 61 parameters: TC-12c
  const auto parameters = [](const NarxPreset& p) {
    return p.hidden[0] * (p.inputs.size() * (p.delays + 1) + p.feedback + 1) + p.hidden[0] + 1;
  };
  const auto of_network = [&](std::string_view name) {
    return parameters(narx_preset(find_preset(network_presets(), name)));
  };
  CHECK(of_network("mlp_one_sensor") == 41);
  CHECK(of_network("mlp_two_sensors") == 51);
  CHECK(parameters(find_preset(narx_presets(), "narx_two_sensors")) == 61);
}

TEST_CASE("hysteresis networks say their kind and need one sensor") {
  for (const HysteresisNetworkPreset& preset : hysteresis_network_presets()) {
    const ModelInfo info = model_info(preset.name);
    CHECK(info.kind == ModelKind::HysteresisNetwork);
    CHECK(info.inputs == std::vector<std::string>{"velocity", "current"});
    CHECK(&find_preset(hysteresis_network_presets(), preset.name) == &preset);
  }
}

TEST_CASE("state spaces say their kind and need one sensor") {
  for (const StateSpacePreset& preset : state_space_presets()) {
    const ModelInfo info = model_info(preset.name);
    CHECK(info.kind == ModelKind::StateSpace);
    CHECK(info.inputs == std::vector<std::string>{"velocity", "current"});
    CHECK(&find_preset(state_space_presets(), preset.name) == &preset);
  }
}

TEST_CASE("passive networks say their kind and which sensors they read") {
  for (const PassiveNetworkPreset& preset : passive_network_presets()) {
    const ModelInfo info = model_info(preset.name);
    CHECK(info.kind == ModelKind::PassiveNetwork);
    CHECK(info.needs_displacement() == preset.displacement);
    CHECK(&find_preset(passive_network_presets(), preset.name) == &preset);
  }
}

TEST_CASE(
    "a law that dissipates by its bounds has a passive hybrid, which needs the network's sensors") {
  for (const Law* law : laws()) {
    CAPTURE(law->name);
    // What its table says of where it dissipates.
    const std::string_view set = law->dissipates;
    const bool by_bounds =
        set.starts_with("Within the bounds") || set.find(", as bounded") != std::string_view::npos;
    CHECK(is_law_of_passive_hybrids(law->name) == by_bounds);
  }
  REQUIRE(passive_hybrid_presets().size() == 20);
  for (const PassiveHybridPreset& preset : passive_hybrid_presets()) {
    const ModelInfo info = model_info(preset.name);
    CHECK(info.kind == ModelKind::PassiveHybrid);
    CHECK(info.inputs == model_info("passive_network").inputs);
    CHECK(preset.name == passive_hybrid_name(preset.law->name));
    CHECK(law_inside(preset.name) == preset.law);
    CHECK_FALSE(is_law(preset.name));
  }
}

TEST_CASE("every law has a hybrid, which needs the law's sensors") {
  REQUIRE(hybrid_presets().size() == laws().size());
  std::size_t named = 0;
  for (const HybridPreset& preset : hybrid_presets()) {
    const ModelInfo info = model_info(preset.name), of_law = model_info(preset.law->name);
    CHECK(info.kind == ModelKind::Hybrid);
    CHECK(info.inputs == of_law.inputs);
    CHECK(preset.name == hybrid_name(preset.law->name));
    CHECK(law_inside(preset.name) == preset.law);
    CHECK_FALSE(is_law(preset.name));
    named += preset.usual;
  }
  for (const PassiveHybridPreset& preset : passive_hybrid_presets()) named += preset.usual;
  // The mean of others is beside them. Other tests may have read laws from files, which have none.
  CHECK(more_model_names().size() ==
        laws().size() + passive_hybrid_presets().size() - named + 1 + laws_of_files().size());
  CHECK(law_inside("bingham") == &find_law("bingham"));
  CHECK(law_inside("anfis") == nullptr);
  CHECK(message_of([] { model_info("arctan+netwrk"); }).find("did you mean 'arctan+network'") !=
        std::string::npos);
}

TEST_CASE("fuzzy models say their kind and inputs, and have sets for each") {
  for (const FuzzyPreset& preset : fuzzy_presets()) {
    const ModelInfo info = model_info(preset.name);
    CHECK(info.kind == ModelKind::Fuzzy);
    CHECK(info.inputs == preset.inputs);
    CHECK(preset.sets.size() == preset.inputs.size());
    CHECK_FALSE(info.needs_displacement());
  }
}

TEST_CASE("families say their kind and inputs; the paper's network has its eight") {
  for (const FamilyPreset& preset : family_presets()) {
    const ModelInfo info = model_info(preset.name);
    CHECK(info.kind == ModelKind::Family);
    CHECK(info.needs_displacement() ==
          (preset.form == FamilyForm::Network || preset.form == FamilyForm::Line));
    CHECK(&find_preset(family_presets(), preset.name) == &preset);
    for (const std::string& input : preset.inputs) CHECK_NOTHROW(family_input_named(input, ""));
  }
  CHECK(find_preset(family_presets(), "family_h3x15").inputs.size() == 8);
}

TEST_CASE("an unknown name is answered with the near one") {
  const std::string message = message_of([] { find_law("bingam", "model.json, law"); });
  CHECK(message.find("model.json, law: unknown model 'bingam'; did you mean 'bingham'?") == 0);
  CHECK(message_of([] {
          find_preset(network_presets(), "bingham");
        }).find("unknown model 'bingham'; known: mlp_one_sensor, mlp_two_sensors") !=
        std::string::npos);
  CHECK(message_of([] { find_law("bingham").index_of("c9"); }).find("known: c0, f_c, f0, v_s") !=
        std::string::npos);
}
