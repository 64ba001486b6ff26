#include "dashpot/export/c/c_model.h"

#include <array>

#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/damper/kinds/fuzzy/fuzzy_model.h"
#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/mean/mean_model.h"
#include "dashpot/damper/kinds/narx/narx_model.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/damper/kinds/passive_hybrid/passive_hybrid_model.h"
#include "dashpot/damper/kinds/passive_network/passive_network_model.h"
#include "dashpot/damper/kinds/state_space/state_space_model.h"
#include "dashpot/error.h"
#include "dashpot/model_kind.h"

namespace dashpot {
namespace {

/// A kind of model as C.
struct KindCode {
  ModelKind kind;
  CModel (*to_c)(const DamperModel& model, bool settable);
};

[[noreturn]] void throw_no_code(const DamperModel& model) {
  throw Error(model.name(), "has no C code: no model file holds it",
              "export a model that 'dashpot identify' wrote");
}

/// Throws Error where the model only wraps one of this kind.
template <class Model>
const Model& required(const DamperModel& model) {
  if (const auto* own = model_as<Model>(model)) return *own;
  throw_no_code(model);
}

template <class Model, CModel (*to_c)(const Model&)>
CModel code_of(const DamperModel& model, bool /*settable*/) {
  return to_c(required<Model>(model));
}

CModel code_of_law(const DamperModel& model, bool settable) {
  return c_law(required<LawModel>(model), "model", settable);
}

CModel code_of_passive_network(const DamperModel& model, bool /*settable*/) {
  return c_passive_network(required<PassiveNetworkModel>(model));
}

CModel code_of_family(const DamperModel& model, bool settable) {
  return c_family(required<FamilyModel>(model), settable);
}

constexpr std::array kCodes{
    KindCode{ModelKind::Law, code_of_law},
    KindCode{ModelKind::Network, code_of<NetworkModel, c_network>},
    KindCode{ModelKind::Narx, code_of<NarxModel, c_narx>},
    KindCode{ModelKind::HysteresisNetwork, code_of<HysteresisNetworkModel, c_hysteresis_network>},
    KindCode{ModelKind::StateSpace, code_of<StateSpaceModel, c_state_space>},
    KindCode{ModelKind::PassiveNetwork, code_of_passive_network},
    KindCode{ModelKind::Fuzzy, code_of<FuzzyModel, c_fuzzy>},
    KindCode{ModelKind::Hybrid, code_of<HybridModel, c_hybrid>},
    KindCode{ModelKind::PassiveHybrid, code_of<PassiveHybridModel, c_passive_hybrid>},
    KindCode{ModelKind::Family, code_of_family},
    KindCode{ModelKind::Mean, code_of<MeanModel, c_mean>},
};

}  // namespace

std::vector<CParameter> c_parameters(const DamperModel& model) {
  if (const auto* law = model_as<LawModel>(model)) return c_parameters(*law);
  if (const auto* family = model_as<FamilyModel>(model)) return c_parameters(*family);
  return {};
}

bool has_settable(const DamperModel& model) {
  return model_as<LawModel>(model) || !c_parameters(model).empty();
}

CModel c_model(const DamperModel& model, bool settable) {
  if (model.kind() == ModelKind::Other) throw_no_code(model);
  return row_of<kCodes>(model.kind()).to_c(model, settable);
}

}  // namespace dashpot
