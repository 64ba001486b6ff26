#include <memory>

#include "commands.h"
#include "console.h"
#include "dashpot/base/date.h"
#include "dashpot/base/escape.h"
#include "dashpot/base/file.h"
#include "dashpot/error.h"
#include "dashpot/record/correction.h"
#include "dashpot/record/sample_columns.h"
#include "dashpot/record/statement_text.h"
#include "dashpot/report/inspection.h"
#include "data.h"
#include "document_text.h"
#include "units.h"

namespace fs = std::filesystem;

namespace dashpot::cli {
namespace {

struct InspectSettings {
  DataSettings data;
  std::string folder, statement, correct, set, samples, units;
};

constexpr std::string_view kInspectExample =
    "# Which column is what, in which unit, under which conditions?\n"
    "dashpot inspect recordings/\n"
    "\n"
    "# The same with plots of every record, to look for flaws:\n"
    "dashpot inspect recordings/ --output look\n"
    "\n"
    "# Something wrong? Have it written down, correct it and look again:\n"
    "dashpot inspect recordings/ --write-dataset recordings.yaml\n"
    "dashpot inspect recordings.yaml";

/// What was understood, as a dataset file to be corrected. One that is there holds somebody's work.
void write_statement(const InspectSettings& settings, const Dataset& dataset, Console& console) {
  if (settings.data.paths.size() != 1)
    throw UsageError("--write-dataset", "several folders or files",
                     "name one; each keeps a dataset file of its own");
  const fs::path given = settings.data.paths.front(), file = settings.statement;
  const fs::path folder = fs::is_directory(given) ? given : given.parent_path();
  write_file(file, statement_text(dataset, folder, file.parent_path()));
  console.print("\nWritten  " + file.string() + "; 'dashpot inspect " +
                shell_quoted(file.string()) + "' reads the recordings by it\n");
}

/// Writes a correction by hand into the dataset file of the folder, once the recordings can be read
/// by it.
void write_correction(const InspectSettings& settings, const Dataset& dataset, Console& console) {
  const fs::path folder = settings.data.paths.front(), file = folder / "dataset.yaml";
  if (settings.data.paths.size() != 1 || !fs::is_directory(folder))
    throw UsageError("--correct", "DATA is no folder", "name the folder that holds the recordings");
  const std::string text =
      corrected_statement(fs::exists(file) ? read_file(file) : "", dataset, folder,
                          settings.correct, parse_corrections(settings.set));

  // Read by a trial first: a wrong unit leaves the dataset file as it was.
  const fs::path trial = folder / ".dataset-trial.yaml";
  write_file(trial, text);
  try {
    LoadOptions options = settings.data.load;
    options.dataset_file = trial.string();
    options.monitor = console.monitor();
    const Dataset corrected = load_dataset({folder}, options);
    for (const PassedOver& unread : corrected.unread)
      if (unread.file == settings.correct) throw Error(unread.file, unread.why);
  } catch (const Error& error) {
    // The place in the trial is that in the file that it would have become.
    fs::remove(trial);
    std::string why = error.what();
    if (const std::size_t at = why.find(trial.string()); at != std::string::npos)
      why.replace(at, trial.string().size(), file.string());
    throw Error("", why);
  } catch (...) {
    fs::remove(trial);
    throw;
  }
  fs::remove(trial);
  write_file(file, text);
  console.print("\nCorrected  " + settings.correct + " in " + file.string() + '\n');
}

int run_inspect(const InspectSettings& settings, Console& console) {
  if (settings.correct.empty() != settings.set.empty())
    throw UsageError("--correct", "a file and --set belong together",
                     "as --correct run3.csv --set 'force.unit=kN; force.sign=-1'");
  if (!settings.statement.empty() && fs::exists(settings.statement))
    throw Error(settings.statement, "is there already, and may hold corrections",
                "write to another name, or remove it first");
  const PrintUnits units = page_units(settings.units);
  LoadOptions options = settings.data.load;
  options.monitor = console.monitor();
  const Dataset dataset =
      load_dataset({settings.data.paths.begin(), settings.data.paths.end()}, options);
  console.files_unread = !dataset.unread.empty();

  // A measured velocity is compared with the derived one: a wrong sign or unit shows there.
  const std::vector<VelocityCheck> checks = check_velocities(dataset, options.velocity_cutoff_hz);
  const Document document =
      inspection_document({dataset, checks, console.command_line(), DASHPOT_VERSION, date_now(),
                           units, !settings.folder.empty()});

  print_document(document, console);

  // Plots need a page; the terminal has tables alone.
  if (!settings.folder.empty()) {
    const std::string page = settings.folder + "/inspect.html";
    write_file(page, html_document(document));
    console.print("\nPlots  " + page + '\n');
  }

  if (!settings.statement.empty()) write_statement(settings, dataset, console);
  if (!settings.samples.empty()) write_sample_columns(dataset.records, settings.samples, &dataset);
  if (!settings.correct.empty()) write_correction(settings, dataset, console);
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
      .run = [settings](Console& console) { return run_inspect(*settings, console); },
      .likewise = {"import", "read", "load", "show"}};

  // Everything is printed here, so --verbose would do nothing.
  std::erase_if(command.options,
                [](const Option& option) { return option.names == "-v,--verbose"; });

  command.options.push_back({.names = "-o,--output",
                             .target = &settings->folder,
                             .help = "also write DIR/inspect.html with plots of every record",
                             .value = "DIR",
                             .takes = Takes::Folder});
  command.options.push_back(
      {.names = "--write-dataset",
       .target = &settings->statement,
       .help = "also write what was understood as a dataset file, to be corrected and used",
       .value = "FILE"});
  append(command.options,
         {units_option(settings->units),
          {.names = "--correct",
           .target = &settings->correct,
           .help = "write what --set says of this file of the folder DATA into DATA/dataset.yaml",
           .value = "FILE"},
          {.names = "--set",
           .target = &settings->set,
           .help = "corrections of that file, as 'force.unit=kN; force.sign=-1; level=0.5; "
                   "cut=0.5:3'",
           .value = "LIST"},
          {.names = "--samples",
           .target = &settings->samples,
           .help = "also write all samples as plain doubles, for programs that draw",
           .value = "DIR",
           .takes = Takes::Folder}});
  return command;
}

}  // namespace dashpot::cli
