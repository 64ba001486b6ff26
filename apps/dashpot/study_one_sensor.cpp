#include <filesystem>
#include <memory>
#include <ranges>

#include <fmt/core.h>

#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/identify/rank/fit_store.h"
#include "ranking_run.h"
#include "studies.h"
#include "studies/one_sensor/one_sensor_document.h"
#include "study_results.h"

namespace dashpot::cli {
namespace {

struct StudyOneSensorSettings {
  DataSettings data;
  std::string leave_out;
  StudyResults results = {.folder = "dashpot-one-sensor"};
  OneSensorOptions options;
  int most_neurons = 20;
};

constexpr std::string_view kStudyOneSensorExample =
    "# The paper's experiments on two virtual dampers; interrupted, the same command goes on:\n"
    "dashpot study one-sensor --figures --output one-sensor\n"
    "\n"
    "# The same questions to recordings of your own:\n"
    "dashpot study one-sensor recordings/ --leave-out condition";

std::vector<StudiedDamper> studied_dampers(const StudyOneSensorSettings& settings,
                                           Console& console) {
  if (settings.data.paths.empty()) return virtual_dampers(settings.options.seed);
  const std::optional<LeaveOut> stated = stated_leave_out(settings.leave_out);
  const Dataset dataset = load_recordings(settings.data, console);
  const LeaveOut leave_out = stated ? *stated : default_leave_out(dataset);
  console.talk("judged by leaving out: " + format_leave_out(leave_out) + '\n');
  return {measured_damper(dataset, leave_out)};
}

std::vector<std::string> row_names() {
  std::vector<std::string> names;
  for (const StudiedModel& model : one_sensor_models()) names.push_back(model.key);
  return names;
}

int run_study_one_sensor(const StudyOneSensorSettings& settings, Console& console) {
  constexpr int kMostNeurons = 1000;  // each number up to it is trained by itself
  if (settings.most_neurons > kMostNeurons)
    throw UsageError("--neurons", std::to_string(settings.most_neurons) + " is too large",
                     "at most " + std::to_string(kMostNeurons));
  prepare_study(settings.results);

  OneSensorOptions options = settings.options;
  options.most_neurons = static_cast<std::size_t>(settings.most_neurons);
  options.monitor = console.monitor();

  // Finished fits are kept, so that an interrupted study goes on.
  std::unique_ptr<FitStore> store;
  if (!settings.results.fresh) {
    store = kept_fits(settings.results.folder, console);
    options.store = store.get();
  }

  const OneSensorStudy study = study_one_sensor(studied_dampers(settings, console), options);
  write_study(one_sensor_document(study), one_sensor_json(study), settings.results, console);
  if (study.kept_fits > 0) console.note(counted(study.kept_fits, "fit") + " kept from before");
  return kDone;
}

}  // namespace

Command one_sensor_study() {
  auto settings = std::make_shared<StudyOneSensorSettings>();
  Command command{
      .name = "study one-sensor",
      .title = "The one-sensor paper's tables and figures, on virtual dampers or your recordings",
      .description =
          "Repeats the paper that identifies a damper with a small static network and one sensor: "
          "feed-forward against recurrent, one sensor or two, delayed samples, the number of "
          "neurons, five experiments on two dampers, and the comparison with laws, each with the "
          "paper's figure beside ours, and with the hysteresis network, which needs the same one "
          "sensor. Without DATA on two virtual dampers shaped after the paper's words. Finished "
          "fits are kept in DIR/fits.sqlite: the same command goes on where it was interrupted.",
      .options = data_options(settings->data),
      .example = std::string(kStudyOneSensorExample),
      .run = [settings](Console& console) { return run_study_one_sensor(*settings, console); }};

  // Recordings are optional: the study has dampers of its own, which need no words.
  const std::string recordings = command.options.front().long_name();
  command.options.front().required = false;
  command.options.front().default_text = "two virtual dampers";
  for (Option& option : command.options | std::views::drop(1)) option.needs = recordings;
  Option leave_out = leave_out_option(settings->leave_out);
  leave_out.needs = recordings;

  append(command.options, study_result_options(settings->results, "fits"));
  append(command.options, {leave_out,
                           {.names = "--models",
                            .target = &settings->options.keys,
                            .help = "rows to fit, separated by commas",
                            .value = "LIST",
                            .choices = row_names(),
                            .noun = "row",
                            .default_text = "all"},
                           {.names = "--neurons",
                            .target = &settings->most_neurons,
                            .help = "the largest network of the size choice",
                            .value = "N",
                            .minimum = 1},
                           seed_option(settings->options.seed),
                           threads_option(settings->options.threads)});
  return command;
}

}  // namespace dashpot::cli
