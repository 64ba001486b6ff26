#include "results.h"

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <unistd.h>

#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/export/js/js.h"
#include "dashpot/report/parameter_files.h"
#include "document_text.h"
#include "traces.h"
#include "units.h"

namespace dashpot::cli {
namespace {

namespace fs = std::filesystem;

void write_models(const ReportInput& input, const fs::path& folder, Console& console) {
  for (const RankedModel& ranked : input.ranking.models) {
    console.check_stop();
    if (!ranked.fit.model) continue;
    ModelFile file = to_model_file(ranked, input.dataset, input.command);
    file.provenance.created = input.date;
    save_model(file, folder / (ranked.name + ".json"));
  }
}

}  // namespace

std::vector<Option> result_options(ResultSettings& settings) {
  return {
      {.names = "-o,--output",
       .target = &settings.folder,
       .help = "folder for the report and the model files",
       .value = "DIR",
       .takes = Takes::Folder},
      units_option(settings.units),
      figures_option(settings.figures),
      {.names = "--pdf",
       .target = &settings.pdf,
       .help = "also print the report as report.pdf (needs chromium)"},
      {.names = "--no-report", .target = &settings.report, .help = "write the model files only"}};
}

std::string program_id() { return DASHPOT_VERSION " " + sha256_of_file("/proc/self/exe"); }

fs::path kept_file(const fs::path& folder, const std::string& what, Console& console) {
  const fs::path file = folder / (what + ".sqlite"), older = folder / "fits";
  if (fs::is_directory(older) && !fs::exists(file))
    console.note(older.string() + " holds " + what +
                 " of an older version of Dashpot; they stay as they are and are not used. New " +
                 what + " are kept in " + file.string());
  return file;
}

std::unique_ptr<FitStore> kept_fits(const fs::path& folder, Console& console) {
  const fs::path file = kept_file(folder, "fits", console);
  auto store = std::make_unique<FitStore>(file, program_id());
  tell_dropped(store->dropped(), file, console);
  return store;
}

void tell_dropped(std::size_t count, const fs::path& file, Console& console) {
  if (count == 0) return;
  console.warn(
      file.string() + ": " + counted(count, "kept result") +
      (count == 1 ? " was damaged and is made again" : " were damaged and are made again") +
      "; is the disk sound?");
}

void tell_kept(std::size_t count, Console& console) {
  if (count > 0)
    console.note(counted(count, "fit") + " kept from before; with --fresh they are made again");
}

ReportInput report_input(const Dataset& dataset, const Ranking& ranking, const std::string& units,
                         const Console& console) {
  return {.dataset = dataset,
          .ranking = ranking,
          .command = console.command_line(),
          .version = DASHPOT_VERSION,
          .date = date_now(),
          .program =
              [](const ModelFile& file) {
                return js_program(exported_model(file), {.version = DASHPOT_VERSION});
              },
          .units = page_units(units),
          .file_units = file_units(units)};
}

void print_results(const Document& report, const Ranking& ranking, Console& console) {
  print_document(report, console);
  for (const RankedModel& ranked : ranking.models)
    for (const std::string& warning : ranked.fit.warnings)
      console.warn(ranked.name + ": " + warning);
}

void prepare_results(const ResultSettings& settings) {
  if (settings.folder.empty()) throw UsageError("--output", "the name of the folder is empty");
  if (settings.pdf) require_page("report.pdf");
  page_units(settings.units);
  const fs::path models = fs::path(settings.folder) / "models";
  make_folder(models);
  for (const fs::path& folder : {fs::path(settings.folder), models})
    if (access(folder.c_str(), W_OK | X_OK) != 0)
      throw Error(folder.string(),
                  "no file can be written there: " + std::generic_category().message(errno),
                  "give a folder of your own with --output");
}

void write_results(const ReportInput& input, const Document& report, const ResultSettings& settings,
                   Console& console, Say say) {
  const fs::path folder = settings.folder;
  write_models(input, folder / "models", console);

  // The page and the figures can be left out or added; the models always come.
  std::string where = "\n";
  if (settings.report) {
    console.check_stop();
    where += write_document(report, folder, "report", false, csv_report(input));
  }
  if (settings.pdf) {
    console.check_stop();
    const std::string printed = (folder / "report.pdf").string();
    write_page(report, printed);
    where += "Printed  " + printed + '\n';
  }
  where += "Models   " + (folder / "models").string() + "/\n";
  if (settings.figures) {
    write_figures(input, folder / "figures");
    where += "Figures  " + (folder / "figures").string() + "/\n";
  }

  say == Say::Result ? console.print(where) : console.talk(where);
}

std::vector<Option> kit_options(KitSettings& settings) {
  return {
      traces_option(settings.traces),
      {.names = "--covariance",
       .target = &settings.covariance,
       .help = "also write the parameters of every law with their 95 % intervals and covariance "
               "matrix",
       .value = "FORMAT",
       .choices = {"csv", "mat", "json"}}};
}

void write_kit(const ReportInput& input, const KitSettings& kit, const ResultSettings& settings,
               Console& console) {
  const fs::path folder = settings.folder;
  std::string where;

  // Each model on the records that a page shows, apart by what the model knows of them.
  std::size_t written = 0;
  for (const RankedModel& ranked : input.ranking.models) {
    if (kit.traces.empty()) break;
    for (const auto& [part, records] : {std::pair{"left-out", &ranked.left_out.records},
                                        std::pair{"validation", &ranked.validation.records},
                                        std::pair{"training", &ranked.training.records}}) {
      console.check_stop();
      if (std::ranges::any_of(*records, [](const RecordResult& r) { return !r.time.empty(); }))
        written += write_traces(*records, input.dataset.drive_unit, kit.traces, input.file_units,
                                folder / "traces" / ranked.name / part);
    }
  }
  if (!kit.traces.empty())
    where +=
        "Traces   " + (folder / "traces").string() + "/ (" + counted(written, "record") + ")\n";

  // The laws' numbers; other models have none with a meaning of their own.
  std::size_t laws = 0;
  for (const RankedModel& ranked : input.ranking.models) {
    if (kit.covariance.empty() || ranked.fit.covariance.empty()) continue;
    write_file(folder / "parameters" / (ranked.name + '.' + kit.covariance),
               parameter_file(ranked.fit, kit.covariance));
    ++laws;
  }
  if (laws > 0)
    where += "Numbers  " + (folder / "parameters").string() + "/ (" + counted(laws, "law") + ")\n";
  if (!kit.covariance.empty() && laws == 0)
    console.note("no law was fitted: the numbers of other models have no covariance");
  console.print(where);
}

int exit_code_of(const Ranking& ranking, Console& console) {
  if (std::ranges::any_of(ranking.models, is_usable)) return kDone;
  console.error(
      "no model gave a usable force on the records left out; the table and the warnings say why");
  return kNotUsable;
}

}  // namespace dashpot::cli
