#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/damper/law_list.h"
#include "dashpot/damper/model_info.h"
#include "dashpot/damper_model.h"

// Every model that is known by name, laws first, then the presets of the other kinds.
namespace dashpot {

/// The description of the model of that name. Throws Error(where, "unknown model ...").
const ModelInfo& model_info(std::string_view name, const std::string& where = {});

/// The usual models, in the order of their kinds: all but the hybrids of most laws.
std::vector<std::string> model_names();
/// Models that are known beside model_names(), laws of files among them.
std::vector<std::string> more_model_names();

/// The model that a word of a user's means: the word itself, or the name of the law in the file
/// that it names (docs/laws-from-a-file.md), which is then known. Throws Error on what is wrong
/// with the file.
std::string model_named(const std::string& word);

/// The description of a model, also of one whose law came with its file and is known by no name.
ModelInfo info_of(const DamperModel& model);

/// The law itself, or the one inside a hybrid; null where there is none, as for a name that is
/// not known.
const Law* law_inside(std::string_view name);

/// Reads what DamperModel::to_json() of a model of that kind wrote. Throws Error with the key at
/// fault.
std::unique_ptr<DamperModel> read_model(ModelKind kind, const Value& value);

}  // namespace dashpot
