#include <memory>

#include "console.h"
#include "results.h"
#include "studies.h"
#include "studies/suspension/suspension_study_document.h"
#include "study_results.h"

namespace dashpot::cli {
namespace {

struct StudySuspensionSettings {
  StudyResults results = {.folder = "dashpot-suspension"};
  SuspensionStudyOptions options;
};

constexpr std::string_view kStudySuspensionExample =
    "# Figures 12 and 13 and table 8 of the paper beside ours, and what is possible at best:\n"
    "dashpot study suspension --figures --output suspension";

int run_study_suspension(const StudySuspensionSettings& settings, Console& console) {
  prepare_study(settings.results);
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
          "damping they would need.",
      .options = {},
      .example = std::string(kStudySuspensionExample),
      .run = [settings](Console& console) { return run_study_suspension(*settings, console); }};

  // This study keeps nothing between runs that --fresh could ignore.
  for (Option& option : study_result_options(settings->results, "data"))
    if (option.names != "--fresh") command.options.push_back(std::move(option));

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
