#include "identify_options.h"

#include <algorithm>

#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/registry.h"

namespace dashpot::cli {
namespace {

/// What an engineer tries first: few, quick, and good on measured dampers.
const std::vector<std::string> kUsualModels = {
    "bingham", "tanh_kwok", "arctan", "modified_bouc_wen", "large_scale_bouc_wen", "anfis", "mlp_one_sensor"};

std::vector<std::string> names_and_groups() {
  std::vector<std::string> words = model_names();
  words.insert(words.end(), {"usual", "all", "family"});
  return words;
}

/// The models that a word on the command line stands for.
std::vector<std::string> models_of(const std::string& word) {
  // Models of a family need what recordings of one damper do not have: each word stands for one of both.
  if (word == "all" || word == "family") {
    std::vector<std::string> names = model_names();
    std::erase_if(names, [&](const std::string& name) {
      return (model_info(name).kind == "family") != (word == "family");
    });
    return names;
  }
  return word == "usual" ? kUsualModels : std::vector{word};
}

std::vector<ParameterChoice> parameter_choices(const FitSettings& settings,
                                               const std::vector<std::string>& models) {
  const struct {
    const char* option;
    const std::vector<std::string>& texts;
    ParameterChoice (*parse)(std::string_view, const std::string&, const ModelNames&);
  } sources[] = {{"--form", settings.forms, parse_form_choice},
                 {"--fix", settings.fixed, parse_fixed_choice},
                 {"--free", settings.freed, parse_free_choice},
                 {"--bounds", settings.bounds, parse_bounds_choice},
                 {"--prior", settings.priors, parse_prior_choice}};
  try {
    std::vector<ParameterChoice> choices;
    for (const auto& source : sources)
      for (const std::string& text : source.texts)
        choices.push_back(source.parse(text, source.option, models));
    require_choices(choices, models);
    return choices;
  } catch (const Error& error) {
    throw UsageError({}, error.what());
  }
}

NetworkDesign network_design(const FitSettings& settings, const std::vector<std::string>& models) {
  try {
    NetworkDesign design;
    for (const std::string& text : settings.network) parse_network_setting(text, "--network", design);
    require_design(design, models);
    return design;
  } catch (const Error& error) {
    throw UsageError({}, error.what());
  }
}

std::string network_help() {
  std::vector<std::string> parts;
  for (const NetworkSetting& setting : network_settings())
    parts.push_back(std::string(setting.name) + " (" + std::string(setting.meaning) + "; as " +
                    std::string(setting.value) + ')');
  return "how networks are built and trained, as hidden=15-15,trainer=adam: " + join(parts, ", ");
}

}  // namespace

std::vector<Option> fit_options(FitSettings& settings) {
  return {
      {.names = "--models",
       .target = &settings.models,
       .help = "the models to fit, separated by commas; 'usual' stands for " + join(kUsualModels, ", ") +
               "; 'all' for every model of one damper that 'dashpot models' lists, 'family' for those of a "
               "family of dampers",
       .value = "NAMES",
       .choices = names_and_groups(),
       .more_choices = more_model_names(),
       .noun = "model",
       .default_text = join(settings.models, ",")},
      {.names = "--force-offset",
       .target = &settings.force_offset,
       .help = "the force zero (gas, load cell): a free offset per record, or none beside the model's own",
       .value = "MODE",
       .choices = {"record", "none"}},
      {.names = "--form",
       .target = &settings.forms,
       .help = "how parameters depend on current, as alpha=exponential or bouc_wen.alpha=linear: constant, "
               "linear, quadratic, cubic or exponential",
       .value = "LIST",
       .default_text = "as each law's table says"},
      {.names = "--fix",
       .target = &settings.fixed,
       .help = "parameters that keep a value, as n=2 or k1=5N/cm (without a unit: in SI)",
       .value = "LIST",
       .default_text = "as each law's table says"},
      {.names = "--free",
       .target = &settings.freed,
       .help = "parameters to be fitted that a law keeps fixed by itself, as n",
       .value = "LIST",
       .default_text = "none"},
      {.names = "--bounds",
       .target = &settings.bounds,
       .help = "narrower bounds for parameters at every current, as c0=0:5000",
       .value = "LIST",
       .default_text = "as each law's table says"},
      {.names = "--prior",
       .target = &settings.priors,
       .help = "what is known of parameters beforehand at every current, value and standard deviation, as "
               "k1=500+-100",
       .value = "LIST",
       .default_text = "nothing"},
      {.names = "--network",
       .target = &settings.network,
       .help = network_help(),
       .value = "LIST",
       .default_text = "as each network's preset says"},
      {.names = "--starts",
       .target = &settings.options.starts,
       .help = "starting points of each fit",
       .value = "N",
       .minimum = 1},
      {.names = "--search",
       .target = &settings.options.search,
       .help = "evaluations of a global search on a part of the data before the local fit; 0: none",
       .value = "N",
       .minimum = 0},
      seed_option(settings.options.seed),
      threads_option(settings.options.threads)};
}

std::vector<std::string> chosen_models(const FitSettings& settings, const Dataset& dataset,
                                       Console& console) {
  const bool has_displacement =
      std::ranges::all_of(dataset.records, [](const Record& r) { return r.find("displacement") != nullptr; });
  std::vector<std::string> models, passed_over;
  for (const std::string& word : settings.models)
    for (const std::string& model : models_of(word)) {
      const bool fits = model == word || has_displacement || !model_info(model).needs_displacement();
      std::vector<std::string>& list = fits ? models : passed_over;
      if (std::ranges::find(list, model) == list.end()) list.push_back(model);
    }
  if (!passed_over.empty())
    console.note("not every record has a displacement, which these models need: " + join(passed_over, ", "));
  return models;
}

IdentifyOptions identify_options(const FitSettings& settings, const std::vector<std::string>& models,
                                 Console& console) {
  IdentifyOptions options = settings.options;
  options.offset = settings.force_offset == "none" ? OffsetMode::None : OffsetMode::Record;
  options.choices = parameter_choices(settings, models);
  options.network = network_design(settings, models);
  options.monitor = console.monitor();
  return options;
}

}  // namespace dashpot::cli
