#include <memory>

#include "console.h"
#include "dashpot/report/ride_document.h"
#include "studies.h"
#include "studies/suspension/own_damper_study.h"
#include "studies/suspension/suspension_study_document.h"
#include "study_results.h"
#include "vehicle_options.h"

namespace dashpot::cli {
namespace {

struct StudySuspensionSettings {
  StudyResults results = {.folder = "dashpot-suspension"};
  SuspensionStudyOptions options;
  OwnDamper own;
  std::string controllers = "mix1;skyhook;sh_add;add;groundhook";
};

constexpr std::string_view kStudySuspensionExample =
    "# Figures 12 and 13 and table 8 of the paper beside ours, and what is possible at best:\n"
    "dashpot study suspension --figures --output suspension\n"
    "\n"
    "# The same questions of a damper, a passive one and a car of one's own:\n"
    "dashpot study suspension results/models/tanh_kwok.json --passive viscous,damping=1500 \\\n"
    "    --plant savaresi_spelta --controllers \"mix1;skyhook\"";

int run_own_damper(const StudySuspensionSettings& settings, Console& console) {
  OwnDamper own = settings.own;
  own.controllers = words_between(settings.controllers);
  own.road_duration = settings.options.road_duration;
  own.seed = settings.options.seed;
  own.threads = settings.options.threads;
  own.monitor = console.monitor();
  const OwnDamperStudy study = study_own_damper(own);
  write_study(own_damper_document(study), ride_json(study.ride), settings.results, console);
  return kDone;
}

/// The paper's own hardware has no choice of car, controllers and passive damper.
void require_own_damper(const StudySuspensionSettings& settings) {
  const StudySuspensionSettings usual;
  const auto refuse = [](const char* option) {
    throw UsageError(option, "asks for hardware of one's own, and no damper is named",
                     "dashpot study suspension DAMPER ...");
  };
  if (settings.own.passive != usual.own.passive) refuse("--passive");
  if (settings.own.plant != usual.own.plant) refuse("--plant");
  if (settings.controllers != usual.controllers) refuse("--controllers");
}

int run_study_suspension(const StudySuspensionSettings& settings, Console& console) {
  if (settings.own.damper.empty()) require_own_damper(settings);
  prepare_study(settings.results);
  if (!settings.own.damper.empty()) return run_own_damper(settings, console);

  SuspensionStudyOptions options = settings.options;
  options.monitor = console.monitor();
  const SuspensionStudy study = study_suspension(options);
  write_study(suspension_study_document(study), suspension_study_json(study), settings.results,
              console);
  return kDone;
}

}  // namespace

Command suspension_study() {
  auto settings = std::make_shared<StudySuspensionSettings>();
  Command command{
      .name = "study suspension",
      .title = "The one-sensor paper's suspension, and what is possible at best",
      .description =
          "Drives the one-sensor paper's quarter car with its identified damper, a virtual one, "
          "under Mix-1-sensor and other controllers, against a passive damper identified by the "
          "same network: over its chirp, its step and a road. Beside each controller stands the "
          "clairvoyant bound: what no force of that damper can beat, and what a controller that "
          "knew the road would reach. Says which of the paper's claims follow, and which least "
          "damping they would need. With a DAMPER it asks the paper's questions of that hardware: "
          "the same chirp, step and road, each figure beside the paper's.",
      .options = {{.names = "DAMPER",
                   .target = &settings->own.damper,
                   .help = "a model file, or a damper's words; none: the paper's study",
                   .takes = Takes::File}},
      .example = std::string(kStudySuspensionExample),
      .run = [settings](Console& console) { return run_study_suspension(*settings, console); }};

  // This study keeps nothing between runs that --fresh could ignore.
  for (Option& option : study_result_options(settings->results, "data"))
    if (option.names != "--fresh") command.options.push_back(std::move(option));

  append(command.options,
         {{.names = "--passive",
           .target = &settings->own.passive,
           .help = "the passive damper beside DAMPER: a damper's words, or current=A",
           .value = "WORDS",
           .default_text = "DAMPER at half of its current"},
          {.names = "--plant",
           .target = &settings->own.plant,
           .help = "the car that DAMPER is in",
           .value = "PLANT"},
          {.names = "--controllers",
           .target = &settings->controllers,
           .help = "control laws of DAMPER, ';' between",
           .value = "LIST"}});
  append(command.options, {{.names = "--duration",
                            .target = &settings->options.road_duration,
                            .help = "duration of the road, s",
                            .value = "S",
                            .minimum = 1},
                           seed_option(settings->options.seed),
                           threads_option(settings->options.threads)});
  return command;
}

}  // namespace dashpot::cli
