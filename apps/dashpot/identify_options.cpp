#include "identify_options.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>

#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/registry.h"
#include "dashpot/identify/fit/network_design.h"

namespace dashpot::cli {
namespace {

std::vector<std::string> names_and_groups() {
  std::vector<std::string> words = model_names();
  words.insert(words.end(), {"usual", "all", "family"});
  return words;
}

std::string network_help() {
  std::vector<std::string> parts;
  for (const NetworkSetting& setting : network_settings())
    parts.push_back(std::string(setting.name) + " (" + std::string(setting.meaning) + "; as " +
                    std::string(setting.value) + ')');
  return "how networks are built and trained, as hidden=15-15,trainer=adam: " + join(parts, ", ");
}

/// Lines for a program that draws the progress, not more often than an eye follows.
auto parameter_lines(Console& console) {
  using Clock = std::chrono::steady_clock;
  struct Said {
    std::mutex guard;
    Clock::time_point last;
  };
  return
      [&console, said = std::make_shared<Said>()](
          const std::string& stage, const std::vector<std::pair<std::string, double>>& parameters) {
        constexpr auto kPause = std::chrono::milliseconds(50);
        const std::lock_guard lock(said->guard);
        if (Clock::now() - said->last < kPause) return;
        said->last = Clock::now();

        // A value that is not finite, on the way, has no place in JSON.
        Value values = Value::array();
        for (const auto& [name, value] : parameters)
          if (std::isfinite(value)) values.push_back(Value::array({Value(name), Value(value)}));
        const Value line = Value::object({{"stage", stage}, {"parameters", std::move(values)}});
        console.talk(format_json(line, false) + "\n");
      };
}

}  // namespace

std::vector<Option> fit_options(FitSettings& settings) {
  return {
      // The models, and the force zero that they are fitted beside.
      {.names = "--models",
       .target = &settings.models,
       .help = "the models to fit, separated by commas, a law of your own by its file "
               "(docs/laws-from-a-file.md), or 'usual', 'all' or 'family' for a group of them",
       .value = "NAMES",
       .choices = names_and_groups(),
       .more_choices = more_model_names(),
       .noun = "model",
       .takes = Takes::File,
       .meaning = model_named,
       .default_text = join(settings.models, ","),
       .details = "; 'usual' stands for " + join(usual_models(), ", ") +
                  " (passive_network_one_sensor where the records have no displacement), as far "
                  "as the time allows; 'all' for every model of one damper that 'dashpot models' "
                  "lists, 'family' for those of a family of dampers; 'mean' beside others for the "
                  "weighted mean of the best of them"},
      {.names = "--force-offset",
       .target = &settings.force_offset,
       .help = "the force zero (gas, load cell): a free offset per record, or none beside the "
               "model's own",
       .value = "MODE",
       .choices = {"record", "none"}},

      // The parameters of laws: shape over current, fixed or free, bounds, prior knowledge.
      {.names = "--form",
       .target = &settings.forms,
       .help = "how parameters depend on current, as alpha=exponential or bouc_wen.alpha=linear: "
               "constant, linear, quadratic, cubic or exponential",
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
       .help = "what is known of parameters beforehand at every current, value and standard "
               "deviation, as k1=500+-100",
       .value = "LIST",
       .default_text = "nothing"},
      {.names = "--allow-active",
       .target = &settings.options.allow_active,
       .help =
           "keep models as they fit best, also those that feed energy into some motions; "
           "without it, such a law is fitted again with parameters that dissipate, and a bank or "
           "state space is trained on until it does"},

      {.names = "--asymmetric",
       .target = &settings.options.asymmetric,
       .help = "take rebound and compression of laws apart where training records that are held "
               "back ask for it"},

      // The design and training of networks.
      {.names = "--network",
       .target = &settings.network,
       .help = network_help(),
       .value = "LIST",
       .default_text = "as each network's preset says"},

      // The effort of the fit, and the random numbers in it.
      {.names = "--starts",
       .target = &settings.options.starts,
       .help = "number of starting points of each fit",
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

std::string budget_of_groups() {
  return format_number(kUsualBudget) + " for 'usual', no limit for 'all'";
}

Option budget_option(FitSettings& settings, const std::string& default_text) {
  return {.names = "--budget",
          .target = &settings.budget,
          .help =
              "minutes on two cores, by estimated cost, that the models of a group ('usual', "
              "'all') may take",
          .value = "MINUTES",
          .minimum = 0,
          .default_text = default_text,
          .details =
              ": cheap ones are tried first, and what is not tried is said; models that are "
              "named themselves are always fitted; 0: no limit"};
}

ChosenModels chosen_models(const FitSettings& settings, const Dataset& dataset,
                           const LeaveOut& leave_out, Console& console) {
  ChosenModels chosen = choose_models(settings, dataset, leave_out, "--budget");
  if (!chosen.passed_over.empty())
    console.note("left out, since not every record has a displacement, which they need: " +
                 join(chosen.passed_over, ", "));
  return chosen;
}

IdentifyOptions identify_options(const FitSettings& settings,
                                 const std::vector<std::string>& models, Console& console) {
  try {
    IdentifyOptions options = dashpot::identify_options(settings, models, "--");
    options.monitor = console.monitor();
    if (console.progress == "json") options.on_parameters = parameter_lines(console);
    return options;
  } catch (const Error& error) {
    throw UsageError({}, error.what());
  }
}

}  // namespace dashpot::cli
