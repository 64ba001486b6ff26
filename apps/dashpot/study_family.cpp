#include <filesystem>
#include <memory>

#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/family/presets.h"
#include "data.h"
#include "results.h"
#include "studies.h"
#include "studies/family/family_document.h"
#include "studies/family/training_store.h"
#include "study_results.h"

namespace dashpot::cli {
namespace {

struct StudyFamilySettings {
  DataSettings data;
  StudyResults results = {.folder = "dashpot-family"};
  FamilyStudyOptions options;
  int seeds = 10;
};

constexpr std::string_view kStudyFamilyExample =
    "# The paper's experiments on its published recordings; interrupted, the same command goes "
    "on:\n"
    "dashpot study family recordings/family-dnn --figures --output family\n"
    "\n"
    "# A first look: two seeds, a tenth of the training:\n"
    "dashpot study family recordings/family-dnn --seeds 2 --effort 0.1";

int run_study_family(const StudyFamilySettings& settings, Console& console) {
  prepare_study(settings.results);
  const Dataset recordings = load_recordings(settings.data, console);
  const bool of_paper = recordings.name == "family-dnn";
  FamilySamples family = family_samples(recordings);

  // Finished trainings are kept, so that an interrupted study goes on.
  std::optional<TrainingStore> store;
  if (!settings.results.fresh) {
    const std::filesystem::path file = kept_file(settings.results.folder, "trainings", console);
    store.emplace(file, program_id(), family.cycles);
    tell_dropped(store->dropped(), file, console);
  }

  // Beside the paper's networks stand Dashpot's own models of a family.
  FamilyStudyOptions options = settings.options;
  options.monitor = console.monitor();
  for (const FamilyPreset& preset : family_presets()) options.models.emplace_back(preset.name);
  options.models.emplace_back(kBlindLaw);
  if (store) options.store = &*store;

  const FamilyStudy study = study_family(
      std::move(family), family_experiments(static_cast<std::size_t>(settings.seeds)), options);
  write_study(family_document(study, of_paper), family_json(study), settings.results, console);
  if (study.kept > 0) console.note(counted(study.kept, "training") + " kept from before");
  return kDone;
}

}  // namespace

Command family_study() {
  auto settings = std::make_shared<StudyFamilySettings>();
  Command command{
      .name = "study family",
      .title = "The family paper's figures, on its published recordings",
      .description =
          "Repeats the paper that teaches one network the force of a family of dampers from "
          "geometry, fluid and field: architectures for one damper and for all, regularisation, "
          "learning rate and batch size, the error while learning, lengths, gaps, fluids and "
          "fields compared, R2; each with the paper's figure and those of its published networks "
          "beside ours. Beyond the paper, each geometry and each fluid is left out in turn: what "
          "the networks, and Dashpot's own models of a family, know of a damper that they have not "
          "seen. Finished trainings are kept in DIR/trainings.sqlite: the same command goes on "
          "where it was interrupted.",
      .options = data_options(settings->data),
      .example = std::string(kStudyFamilyExample),
      .run = [settings](Console& console) { return run_study_family(*settings, console); }};

  append(command.options, study_result_options(settings->results, "trainings"));

  // The full study takes long; both options make it smaller.
  append(command.options,
         {{.names = "--seeds",
           .target = &settings->seeds,
           .help = "trainings of each network, from other first weights; half of them where "
                   "something is left out, three at most of large networks and in grids",
           .value = "N",
           .minimum = 1},
          {.names = "--effort",
           .target = &settings->options.effort,
           .help = "share of each training's epochs",
           .value = "SHARE",
           .minimum = 0},
          threads_option(settings->options.threads)});
  return command;
}

}  // namespace dashpot::cli
