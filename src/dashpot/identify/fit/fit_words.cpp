#include "dashpot/identify/fit/fit_words.h"

#include <algorithm>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/network_design.h"
#include "dashpot/identify/fit/parameter_choice.h"
#include "dashpot/identify/judge/extrapolation.h"

namespace dashpot {
namespace {

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

std::vector<std::shared_ptr<const DamperModel>> first_starts(const FitWords& words,
                                                             const std::vector<std::string>& models,
                                                             const Dataset& dataset) {
  std::vector<std::shared_ptr<const DamperModel>> starts;
  for (const std::string& path : words.from) {
    ModelFile file = load_model(path);
    const std::string name = file.model->name();
    if (file.model->kind() != ModelKind::Law)
      throw Error(path, "is a " + name + ", which is no law",
                  "a law's file: its parameters are where the fit starts");
    if (std::ranges::find(models, name) == models.end())
      throw Error(path, "is a " + name + ", which is not among the models to fit",
                  "those are " + join(models, ", "));
    if (std::ranges::any_of(starts, [&](const auto& other) { return other->name() == name; }))
      throw Error(path, "is a " + name + ", as another of the files to start from is",
                  "one file for each law");
    require_same_drive(file, dataset, path);
    starts.push_back(std::move(file.model));
  }
  return starts;
}

}  // namespace dashpot
