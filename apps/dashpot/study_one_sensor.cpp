#include <filesystem>
#include <memory>

#include <fmt/core.h>

#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/identify/fit_store.h"
#include "dashpot/output/one_sensor_document.h"
#include "dashpot/output/safe_text.h"
#include "dashpot/output/words.h"
#include "document_text.h"
#include "ranking_run.h"
#include "studies.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

struct Settings {
  DataSettings data;
  std::string leave_out;
  std::string folder = "dashpot-one-sensor";
  OneSensorOptions options;
  int most_neurons = 20;
  bool figures = false;
  bool fresh = false;
};

constexpr std::string_view kExample =
    "# The paper's experiments on two virtual dampers; interrupted, the same command goes on:\n"
    "dashpot study one-sensor --figures --output one-sensor\n"
    "\n"
    "# The same questions to recordings of your own:\n"
    "dashpot study one-sensor recordings/ --leave-out condition";

std::vector<StudiedDamper> studied_dampers(const Settings& settings, Console& console) {
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

void write_study(const Document& document, const Settings& settings, Console& console) {
  const fs::path folder = settings.folder;
  write_file(folder / "report.html", html_document(document));
  if (settings.figures) write_document_figures(document, folder / "figures");
  write_file(folder / "report.md", markdown_document(document, settings.figures ? "figures" : ""));
  std::string where = "\nReport   " + (folder / "report.html").string() + " (also .json, .md)\n";
  if (settings.figures) where += "Figures  " + (folder / "figures").string() + "/\n";
  console.print(where);
}

int run(const Settings& settings, Console& console) {
  if (settings.folder.empty()) throw UsageError("--output", "the name of the folder is empty");
  make_folder(settings.folder);
  OneSensorOptions options = settings.options;
  options.most_neurons = static_cast<std::size_t>(settings.most_neurons);
  options.monitor = console.monitor();
  const FitStore store(fs::path(settings.folder) / "fits", program_id());
  if (!settings.fresh) options.store = &store;
  const OneSensorStudy study = study_one_sensor(studied_dampers(settings, console), options);
  Document document = one_sensor_document(study);
  document.command = console.command_line();
  document.version = DASHPOT_VERSION;
  document.date = date_now();
  print_document(document, console);
  const Value data = presentable(one_sensor_json(study));
  write_file(fs::path(settings.folder) / "report.json", format_json(data));
  write_study(document, settings, console);
  if (study.kept_fits > 0) console.note(counted(study.kept_fits, "fit") + " kept from before");
  if (console.json) console.print_json(data);
  return kDone;
}

}  // namespace

Command one_sensor_study() {
  auto settings = std::make_shared<Settings>();
  Command command{
      .name = "study one-sensor",
      .title = "The one-sensor paper's tables and figures, on virtual dampers or your recordings",
      .description =
          "Repeats the paper that identifies a damper with a small static network and one sensor: "
          "feed-forward "
          "against recurrent, one sensor or two, delayed samples, the number of neurons, five experiments on "
          "two "
          "dampers, and the comparison with laws, each with the paper's figure beside ours, and with the "
          "hysteresis "
          "network, which needs the same one sensor. Without DATA on two virtual dampers shaped after the "
          "paper's words. Finished fits are kept in DIR/fits: the same command goes on where it was "
          "interrupted.",
      .options = data_options(settings->data),
      .example = std::string(kExample),
      .run = [settings](Console& console) { return run(*settings, console); }};
  command.options.front().required = false;
  command.options.front().default_text = "two virtual dampers";
  append(command.options,
         {leave_out_option(settings->leave_out),
          {.names = "-o,--output",
           .target = &settings->folder,
           .help = "folder for the page and the fits",
           .value = "DIR",
           .takes = Takes::Folder},
          {.names = "--figures",
           .target = &settings->figures,
           .help = "also draw the figures as SVG and PDF (needs gnuplot)"},
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
          {.names = "--fresh", .target = &settings->fresh, .help = "neither use nor keep finished fits"},
          {.names = "--seed",
           .target = &settings->options.seed,
           .help = "seed of all random numbers: the same seed gives the same result",
           .value = "N",
           .minimum = 0},
          {.names = "--threads",
           .target = &settings->options.threads,
           .help = "threads to use; the result does not depend on it",
           .value = "N",
           .minimum = 0,
           .default_text = "all cores"}});
  return command;
}

}  // namespace dashpot::cli
