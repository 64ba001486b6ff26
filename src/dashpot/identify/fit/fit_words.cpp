#include "dashpot/identify/fit/fit_words.h"

#include "dashpot/error.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/network_design.h"
#include "dashpot/identify/fit/parameter_choice.h"

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

}  // namespace dashpot
