#include "damper_choice.h"

#include <algorithm>
#include <filesystem>

#include "console.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/identify/judge/track.h"
#include "dashpot/model_file.h"

namespace dashpot::cli {

std::vector<Option> damper_options(DamperChoice& choice) {
  return {{.names = "MODEL",
           .target = &choice.model,
           .help = "a model file that 'dashpot identify' wrote",
           .takes = Takes::File},
          {.names = "--parameters",
           .target = &choice.parameters,
           .help = "instead of a file: a damper by the publication of its parameters",
           .value = "NAME",
           .choices = parameter_set_names(),
           .noun = "parameter set"}};
}

Option current_max_option(double& current_max) {
  return {.names = "--current-max",
          .target = &current_max,
          .help = "greatest current, A (or V)",
          .value = "A",
          .minimum = 0,
          .default_text = "that of the damper's data"};
}

Option lag_rate_option(double& lag_rate) {
  return {.names = "--lag-rate",
          .target = &lag_rate,
          .help = "rate of the coil's lag, 1/s; 0: no lag",
          .value = "1/S",
          .minimum = 0,
          .default_text = "the damper's own"};
}

std::vector<Option> coil_options(DamperChoice& choice) {
  return {current_max_option(choice.current_max), lag_rate_option(choice.lag_rate)};
}

void refuse_published(const std::string& model, const std::string& command,
                      const std::string& right) {
  const std::vector<std::string> published = parameter_set_names();
  if (std::ranges::find(published, model) != published.end() && !std::filesystem::exists(model))
    throw UsageError(command, "'" + model + "' is a published damper, and no file", right);
}

ModelFile load_damper_file(const DamperChoice& choice, const std::string& command,
                           Console& console) {
  if (choice.model.empty() == choice.parameters.empty())
    throw UsageError(command, "needs one damper", "give a model file, or --parameters NAME");

  refuse_published(choice.model, command, "--parameters " + choice.model);

  ModelFile file;
  if (!choice.model.empty()) {
    file = load_model(choice.model);
  } else {
    const ParameterSet set = load_parameter_set(choice.parameters);
    if (!set.verified) console.note("these parameters are an example: " + set.reason);
    file = to_model_file(set);
  }
  if (const std::string active = activity(dissipation_of(file), file.drive_unit); !active.empty())
    console.warn(file.model->name() + ": " + active + "; what swings with it may never rest");
  return file;
}

Damper damper_of(ModelFile file, const DamperChoice& choice) {
  Damper damper{.name = choice.parameters,
                .drive_unit = file.drive_unit,
                .model = std::move(file.model),
                .drive_min = file.domain.current_min,
                .drive_max = file.domain.current_max};
  if (choice.model.empty()) return damper;
  damper.name = damper.model->name();
  damper.drive_min = std::max(0.0, damper.drive_min);
  damper.domain = file.domain;
  return damper;
}

Damper load_damper(const DamperChoice& choice, const std::string& command, Console& console) {
  return damper_of(load_damper_file(choice, command, console), choice);
}

DriverOptions driver_of(const Damper& damper, const DamperChoice& choice, DriverOptions options) {
  options.current_min = damper.drive_min;
  options.current_max = choice.current_max > 0 ? choice.current_max : damper.drive_max;
  if (!(options.current_min < options.current_max))
    throw Error(damper.name, "its data lie at one current only",
                "state the greatest with --current-max");
  options = driver_of(*damper.model, options);
  if (choice.lag_rate >= 0) options.lag_rate = choice.lag_rate;
  return options;
}

}  // namespace dashpot::cli
