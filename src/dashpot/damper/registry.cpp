#include "dashpot/damper/registry.h"

#include <algorithm>
#include <array>

#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/damper/kinds/family/presets.h"
#include "dashpot/damper/kinds/fuzzy/fuzzy_model.h"
#include "dashpot/damper/kinds/fuzzy/presets.h"
#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/kinds/hybrid/presets.h"
#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"
#include "dashpot/damper/kinds/hysteresis_network/presets.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/law/law_text.h"
#include "dashpot/damper/kinds/mean/mean_model.h"
#include "dashpot/damper/kinds/narx/narx_model.h"
#include "dashpot/damper/kinds/narx/presets.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/damper/kinds/network/presets.h"
#include "dashpot/damper/kinds/passive_hybrid/passive_hybrid_model.h"
#include "dashpot/damper/kinds/passive_hybrid/presets.h"
#include "dashpot/damper/kinds/passive_network/passive_network_model.h"
#include "dashpot/damper/kinds/passive_network/presets.h"
#include "dashpot/damper/kinds/state_space/presets.h"
#include "dashpot/damper/kinds/state_space/state_space_model.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// A kind of model, as this layer knows it.
struct KindRow {
  ModelKind kind;
  void (*list)(std::vector<ModelInfo>& models);  ///< adds its registered models
  std::unique_ptr<DamperModel> (*read)(const Value& value);
};

void list_laws(std::vector<ModelInfo>& models) {
  for (const Law* law : laws()) models.push_back(info_of(*law));
}

void list_mean(std::vector<ModelInfo>& models) { models.push_back(mean_info()); }

std::unique_ptr<DamperModel> read_mean(const Value& value) {
  return mean_model_from_json(value, read_model);
}

template <auto presets>
void list(std::vector<ModelInfo>& models) {
  for (const auto& preset : presets()) models.push_back(preset.info());
}

template <auto from_json>
std::unique_ptr<DamperModel> read(const Value& value) {
  return from_json(value);
}

constexpr std::array kKinds{
    KindRow{ModelKind::Law, list_laws, read<law_model_from_json>},
    KindRow{ModelKind::Network, list<network_presets>, read<network_model_from_json>},
    KindRow{ModelKind::Narx, list<narx_presets>, read<narx_model_from_json>},
    KindRow{ModelKind::HysteresisNetwork, list<hysteresis_network_presets>,
            read<hysteresis_network_model_from_json>},
    KindRow{ModelKind::StateSpace, list<state_space_presets>, read<state_space_model_from_json>},
    KindRow{ModelKind::PassiveNetwork, list<passive_network_presets>,
            read<passive_network_model_from_json>},
    KindRow{ModelKind::Fuzzy, list<fuzzy_presets>, read<fuzzy_model_from_json>},
    KindRow{ModelKind::Hybrid, list<hybrid_presets>, read<hybrid_model_from_json>},
    KindRow{ModelKind::PassiveHybrid, list<passive_hybrid_presets>,
            read<passive_hybrid_model_from_json>},
    KindRow{ModelKind::Family, list<family_presets>, read<family_model_from_json>},
    KindRow{ModelKind::Mean, list_mean, read_mean},
};

const std::vector<ModelInfo>& models() {
  static const std::vector<ModelInfo> kModels = [] {
    std::vector<ModelInfo> all;
    for (const KindRow& row : kKinds) row.list(all);
    return all;
  }();
  return kModels;
}

const ModelInfo* info_named(std::string_view name) {
  const auto found = std::ranges::find(models(), name, &ModelInfo::name);
  return found == models().end() ? file_law_info(name) : &*found;
}

std::vector<std::string> names(bool usual) {
  std::vector<std::string> names;
  for (const ModelInfo& model : models())
    if (model.usual == usual) names.emplace_back(model.name);
  return names;
}

}  // namespace

const ModelInfo& model_info(std::string_view name, const std::string& where) {
  if (const ModelInfo* info = info_named(name)) return *info;
  throw_unknown_model(name, where, model_names(), more_model_names());
}

std::vector<std::string> model_names() { return names(true); }

std::vector<std::string> more_model_names() {
  std::vector<std::string> more = names(false);
  for (const std::string& law : laws_of_files()) more.push_back(law);
  return more;
}

std::string model_named(const std::string& word) {
  if (!is_law_file(word)) {
    if (word.find_first_of("./") == std::string::npos) return word;
    throw Error(word, "is neither a model nor the file of a law",
                "such a file's name ends in .yaml, .yml or .json");
  }
  const std::string name(know_law(word).name);
  if (std::ranges::find(models(), name, &ModelInfo::name) != models().end())
    throw Error(word, "'" + name + "' is a model of Dashpot's own", "give the law another name");
  return name;
}

ModelInfo info_of(const DamperModel& model) {
  const auto* law = model_as<LawModel>(model);
  return law ? info_of(law->law()) : model_info(model.name());
}

const Law* law_inside(std::string_view name) {
  const ModelInfo* info = info_named(name);
  return info ? info->law : nullptr;
}

std::unique_ptr<DamperModel> read_model(ModelKind kind, const Value& value) {
  return row_of<kKinds>(kind).read(value);
}

}  // namespace dashpot
