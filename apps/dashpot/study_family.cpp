#include <filesystem>
#include <memory>

#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/identify/training_store.h"
#include "dashpot/output/family_document.h"
#include "dashpot/output/safe_text.h"
#include "dashpot/output/words.h"
#include "data.h"
#include "document_text.h"
#include "results.h"
#include "studies.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

struct Settings {
  DataSettings data;
  std::string folder = "dashpot-family";
  FamilyStudyOptions options;
  int seeds = 10;
  bool figures = false;
  bool fresh = false;
};

constexpr std::string_view kExample =
    "# The paper's experiments on its published recordings; interrupted, the same command goes on:\n"
    "dashpot study family recordings/family-dnn --figures --output family\n"
    "\n"
    "# A first look: two seeds, a tenth of the training:\n"
    "dashpot study family recordings/family-dnn --seeds 2 --effort 0.1";

void write_study(const FamilyStudy& study, const Document& document, const Settings& settings,
                 Console& console) {
  const fs::path folder = settings.folder;
  const Value data = presentable(family_json(study));
  write_file(folder / "report.json", format_json(data));
  write_file(folder / "report.html", html_document(document));
  if (settings.figures) write_document_figures(document, folder / "figures");
  write_file(folder / "report.md", markdown_document(document, settings.figures ? "figures" : ""));
  std::string where = "\nReport   " + (folder / "report.html").string() + " (also .json, .md)\n";
  if (settings.figures) where += "Figures  " + (folder / "figures").string() + "/\n";
  console.print(where);
  if (console.json) console.print_json(data);
}

int run(const Settings& settings, Console& console) {
  if (settings.folder.empty()) throw UsageError("--output", "the name of the folder is empty");
  make_folder(settings.folder);
  FamilySamples family = family_samples(load_recordings(settings.data, console));
  const TrainingStore store(fs::path(settings.folder) / "fits", program_id(), family.cycles);
  FamilyStudyOptions options = settings.options;
  options.monitor = console.monitor();
  if (!settings.fresh) options.store = &store;
  const FamilyStudy study =
      study_family(std::move(family), family_experiments(static_cast<std::size_t>(settings.seeds)), options);
  Document document = family_document(study);
  document.command = console.command_line();
  document.version = DASHPOT_VERSION;
  document.date = date_now();
  print_document(document, console);
  write_study(study, document, settings, console);
  if (study.kept > 0) console.note(counted(study.kept, "training") + " kept from before");
  return kDone;
}

}  // namespace

Command family_study() {
  auto settings = std::make_shared<Settings>();
  Command command{.name = "study family",
                  .title = "The family paper's figures, on its published recordings",
                  .description =
                      "Repeats the paper that teaches one network the force of a family of dampers from "
                      "geometry, fluid and "
                      "field: architectures for one damper and for all, regularisation, learning rate and "
                      "batch size, the "
                      "error while learning, lengths, gaps, fluids and fields compared, R2; each with the "
                      "paper's figure and "
                      "those of its published networks beside ours. Beyond the paper, each geometry and each "
                      "fluid is left "
                      "out in turn: what the networks know of a damper that they have not seen. Finished "
                      "trainings are kept "
                      "in DIR/fits: the same command goes on where it was interrupted.",
                  .options = data_options(settings->data),
                  .example = std::string(kExample),
                  .run = [settings](Console& console) { return run(*settings, console); }};
  append(command.options,
         {{.names = "-o,--output",
           .target = &settings->folder,
           .help = "folder for the page and the trainings",
           .value = "DIR",
           .takes = Takes::Folder},
          {.names = "--figures",
           .target = &settings->figures,
           .help = "also draw the figures as SVG and PDF (needs gnuplot)"},
          {.names = "--seeds",
           .target = &settings->seeds,
           .help = "trainings of each network, from other first weights; half of them where something is "
                   "left out, three at most of large networks and in grids",
           .value = "N",
           .minimum = 1},
          {.names = "--effort",
           .target = &settings->options.effort,
           .help = "share of each training's epochs",
           .value = "SHARE",
           .minimum = 0},
          {.names = "--fresh", .target = &settings->fresh, .help = "neither use nor keep finished trainings"},
          {.names = "--threads",
           .target = &settings->options.threads,
           .help = "threads to use; the result does not depend on it",
           .value = "N",
           .minimum = 0,
           .default_text = "all cores"}});
  return command;
}

}  // namespace dashpot::cli
