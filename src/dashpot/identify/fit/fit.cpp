#include "dashpot/identify/fit/fit.h"

#include <algorithm>
#include <array>

#include "dashpot/damper/kinds/family/presets.h"
#include "dashpot/damper/kinds/fuzzy/presets.h"
#include "dashpot/damper/kinds/hybrid/presets.h"
#include "dashpot/damper/kinds/hysteresis_network/presets.h"
#include "dashpot/damper/kinds/narx/presets.h"
#include "dashpot/damper/kinds/network/presets.h"
#include "dashpot/damper/kinds/passive_hybrid/presets.h"
#include "dashpot/damper/kinds/passive_network/presets.h"
#include "dashpot/damper/kinds/state_space/presets.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/network_design.h"

namespace dashpot {
namespace {

using Settings = std::span<const std::string_view>;

FitReport fit_law_named(std::string_view model, const std::vector<Record>& training,
                        DriveUnit drive_unit, const IdentifyOptions& options) {
  return fit_law(find_law(model), training, drive_unit, options);
}

FitReport refuse_mean(std::string_view model, const std::vector<Record>&, DriveUnit,
                      const IdentifyOptions&) {
  throw Error(
      std::string(model), "is made of other models",
      "rank it together with two or more of these: --models tanh_kwok,passive_network,mean");
}

template <auto presets, auto fit>
FitReport fit_preset(std::string_view model, const std::vector<Record>& training,
                     DriveUnit drive_unit, const IdentifyOptions& options) {
  return fit(find_preset(presets(), model), training, drive_unit, options);
}

constexpr std::array<std::string_view, 0> kNone{};
constexpr std::array<std::string_view, 4> kOfStates{"hidden", "epochs", "l2", "members"};
constexpr std::array<std::string_view, 4> kOfPassive{"hidden", "rate", "epochs", "members"};
constexpr std::array<std::string_view, 12> kOfNarx{"hidden",  "activation", "trainer", "epochs",
                                                   "l2",      "members",    "delays",  "feedback",
                                                   "spacing", "training",   "window",  "output"};
constexpr std::array<std::string_view, 13> kOfNetworks{
    "hidden", "activation", "trainer",  "rate",    "schedule", "batch",  "epochs",
    "l1",     "l2",         "patience", "members", "delays",   "spacing"};
/// Those of a static network that stays one: the last two of the above make it a NARX model.
constexpr Settings kOfStaticNetworks = Settings(kOfNetworks).first(kOfNetworks.size() - 2);

template <const auto& settings>
Settings always(std::string_view) {
  return settings;
}

/// Of the families, those with networks alone follow settings of networks.
Settings settings_of_family(std::string_view model) {
  return find_preset(family_presets(), model).form == FamilyForm::Network ? kOfStaticNetworks
                                                                          : Settings{};
}

constexpr std::array kFits{
    KindFit{ModelKind::Law, fit_law_named, always<kNone>},
    KindFit{ModelKind::Network, fit_preset<network_presets, fit_network>, always<kOfNetworks>},
    KindFit{ModelKind::Narx, fit_preset<narx_presets, fit_narx>, always<kOfNarx>},
    KindFit{ModelKind::HysteresisNetwork,
            fit_preset<hysteresis_network_presets, fit_hysteresis_network>, always<kOfStates>},
    KindFit{ModelKind::StateSpace, fit_preset<state_space_presets, fit_state_space>,
            always<kOfStates>},
    KindFit{ModelKind::PassiveNetwork, fit_preset<passive_network_presets, fit_passive_network>,
            always<kOfPassive>},
    KindFit{ModelKind::Fuzzy, fit_preset<fuzzy_presets, fit_fuzzy>, always<kNone>},
    KindFit{ModelKind::Hybrid, fit_preset<hybrid_presets, fit_hybrid>, always<kNone>},
    KindFit{ModelKind::PassiveHybrid, fit_preset<passive_hybrid_presets, fit_passive_hybrid>,
            always<kOfPassive>},
    KindFit{ModelKind::Family, fit_preset<family_presets, fit_family>, settings_of_family,
            Trainer::Adam},
    KindFit{ModelKind::Mean, refuse_mean, always<kNone>},
};

}  // namespace

const KindFit& fit_of(ModelKind kind) { return row_of<kFits>(kind); }

std::span<const std::string_view> network_settings_of(const std::string& model) {
  return fit_of(model_info(model).kind).settings(model);
}

void require_design(const NetworkDesign& design, const std::vector<std::string>& models) {
  const auto follows = [](const std::string& model, std::string_view setting) {
    return std::ranges::count(network_settings_of(model), setting) > 0;
  };

  // Every setting must make a difference to one model at least.
  for (const NetworkSetting& setting : network_settings()) {
    if (setting.format(design).empty()) continue;
    if (std::ranges::none_of(models, [&](auto& model) { return follows(model, setting.name); }))
      throw Error("--network", "none of the models follows '" + std::string(setting.name) + "'",
                  "choose a network with --models; 'dashpot models NAME' tells what it follows");
  }

  // And every trainer that it meets must have a use for it.
  for (const std::string& model : models)
    if (follows(model, "trainer")) require_trainer(design, fit_of(model_info(model).kind).trainer);
}

}  // namespace dashpot
