#include <memory>

#include "commands.h"
#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/report/inspection.h"
#include "data.h"
#include "document_text.h"
#include "results.h"

namespace dashpot::cli {
namespace {

struct InspectSettings {
  DataSettings data;
  std::string folder;
};

constexpr std::string_view kInspectExample =
    "# Which column is what, in which unit, under which conditions?\n"
    "dashpot inspect recordings/\n"
    "\n"
    "# The same with plots of every record, to look for flaws:\n"
    "dashpot inspect recordings/ --output look\n"
    "\n"
    "# Something wrong? State it in a dataset file and look again:\n"
    "dashpot inspect recordings/ --dataset recordings.yaml";

int run_inspect(const InspectSettings& settings, Console& console) {
  LoadOptions options = settings.data.load;
  options.monitor = console.monitor();
  const Dataset dataset =
      load_dataset({settings.data.paths.begin(), settings.data.paths.end()}, options);
  console.files_unread = !dataset.unread.empty();

  // A measured velocity is compared with the derived one: a wrong sign or unit shows there.
  const std::vector<VelocityCheck> checks = check_velocities(dataset, options.velocity_cutoff_hz);
  const Document document =
      inspection_document({dataset, checks, console.command_line(), DASHPOT_VERSION, date_now()});

  print_document(document, console);

  // Plots need a page; the terminal has tables alone.
  if (!settings.folder.empty()) {
    const std::string page = settings.folder + "/inspect.html";
    write_file(page, html_document(document));
    console.print("\nPlots  " + page + '\n');
  }

  if (console.json) console.print_json(document_json(document));
  return kDone;
}

}  // namespace

Command inspect_command() {
  auto settings = std::make_shared<InspectSettings>();
  Command command{
      .name = "inspect",
      .title = "Show what is understood of recordings",
      .description =
          "Reads recordings as 'identify' would and prints what each column was taken for, its "
          "unit, the conditions of each record, and what was inferred or passed over. Where "
          "velocity was measured, also compares it with the velocity derived from displacement.",
      .options = data_options(settings->data),
      .example = std::string(kInspectExample),
      .run = [settings](Console& console) { return run_inspect(*settings, console); }};

  // Everything is printed here, so --verbose would do nothing.
  std::erase_if(command.options,
                [](const Option& option) { return option.names == "-v,--verbose"; });

  command.options.push_back({.names = "-o,--output",
                             .target = &settings->folder,
                             .help = "also write DIR/inspect.html with plots of every record",
                             .value = "DIR",
                             .takes = Takes::Folder});
  return command;
}

}  // namespace dashpot::cli
