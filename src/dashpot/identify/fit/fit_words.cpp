#include "dashpot/identify/fit/fit_words.h"

#include <algorithm>

#include "dashpot/base/text.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/network_design.h"
#include "dashpot/identify/fit/parameter_choice.h"

namespace dashpot {
namespace {

/// The models that one word stands for.
std::vector<std::string> models_of(const std::string& word) {
  // Models of a family need what recordings of one damper do not have: each word stands for one of
  // both.
  if (word == "all" || word == "family") {
    std::vector<std::string> names = model_names();
    std::erase_if(names, [&](const std::string& name) {
      return (model_info(name).kind == ModelKind::Family) != (word == "family");
    });
    return names;
  }
  return word == "usual" ? usual_models() : std::vector{word};
}

std::vector<ParameterChoice> parameter_choices(const FitWords& words,
                                               const std::vector<std::string>& models,
                                               const std::string& prefix) {
  // One row per option: its texts, and the function that parses one of them.
  const struct {
    const char* option;
    const std::vector<std::string>& texts;
    ParameterChoice (*parse)(std::string_view, const std::string&, const ModelNames&);
  } sources[] = {{"form", words.forms, parse_form_choice},
                 {"fix", words.fixed, parse_fixed_choice},
                 {"free", words.freed, parse_free_choice},
                 {"bounds", words.bounds, parse_bounds_choice},
                 {"prior", words.priors, parse_prior_choice}};

  // Parse them all, then refuse what does not go together.
  std::vector<ParameterChoice> choices;
  for (const auto& source : sources)
    for (const std::string& text : source.texts)
      choices.push_back(source.parse(text, prefix + source.option, models));
  require_choices(choices, models);
  return choices;
}

}  // namespace

const std::vector<std::string>& usual_models() {
  static const std::vector<std::string> names = {
      "bingham", "tanh_kwok",     "arctan", "modified_bouc_wen", "large_scale_bouc_wen",
      "anfis",   "mlp_one_sensor"};
  return names;
}

ChosenModels choose_models(const std::vector<std::string>& words,
                           const std::vector<Record>& records) {
  const bool has_displacement = std::ranges::all_of(
      records, [](const Record& r) { return r.find("displacement") != nullptr; });
  ChosenModels chosen;
  for (const std::string& word : words)
    for (const std::string& model : models_of(word)) {
      const bool fits =
          model == word || has_displacement || !model_info(model).needs_displacement();
      std::vector<std::string>& list = fits ? chosen.names : chosen.passed_over;
      if (std::ranges::find(list, model) == list.end()) list.push_back(model);
    }
  return chosen;
}

OffsetMode offset_mode(const std::string& word, const std::string& where) {
  if (word != "record" && word != "none") throw Error(where, "is '" + word + "'", "record or none");
  return word == "none" ? OffsetMode::None : OffsetMode::Record;
}

IdentifyOptions identify_options(const FitWords& words, const std::vector<std::string>& models,
                                 const std::string& prefix) {
  IdentifyOptions options = words.options;
  options.offset = offset_mode(words.force_offset, prefix + "force_offset");
  options.choices = parameter_choices(words, models, prefix);
  for (const std::string& text : words.network)
    parse_network_setting(text, prefix + "network", options.network);
  require_design(options.network, models);
  return options;
}

}  // namespace dashpot
