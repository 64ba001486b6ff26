#include "results.h"

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <unistd.h>

#include <fmt/core.h>

#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/rank.h"
#include "dashpot/report/interval_table.h"
#include "dashpot/report/words.h"
#include "layout.h"

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

void write_reports(const ReportInput& input, const fs::path& folder, Console& console) {
  console.check_stop();
  write_file(folder / "report.html", html_report(input));
  write_file(folder / "report.json", format_json(json_report(input)));
  write_file(folder / "report.md", markdown_report(input));
  write_file(folder / "report.csv", csv_report(input));
}

}  // namespace

std::vector<Option> result_options(ResultSettings& settings) {
  return {
      {.names = "-o,--output",
       .target = &settings.folder,
       .help = "folder for the report and the model files",
       .value = "DIR",
       .takes = Takes::Folder},
      {.names = "--figures",
       .target = &settings.figures,
       .help = "also draw the figures as SVG and PDF, for a paper (needs gnuplot)"},
      {.names = "--no-report", .target = &settings.report, .help = "write the model files only"}};
}

std::string program_id() { return DASHPOT_VERSION " " + sha256_of_file("/proc/self/exe"); }

ReportInput report_input(const Dataset& dataset, const Ranking& ranking, const Console& console) {
  return {.dataset = dataset,
          .ranking = ranking,
          .command = console.command_line(),
          .version = DASHPOT_VERSION,
          .date = date_now()};
}

void print_results(const ReportInput& input, Console& console) {
  console.print('\n' + ranking_table(input.ranking, console.width()) + '\n' +
                paragraph(verdict(input.ranking), static_cast<std::size_t>(console.width())));
  if (std::ranges::any_of(input.ranking.models,
                          [](const RankedModel& m) { return m.left_out.one_step.has_value(); }))
    console.print(
        '\n' + paragraph(*one_step_note(input.ranking), static_cast<std::size_t>(console.width())));
  const RankedModel& best = input.ranking.models.front();
  if (!best.fit.parameters.empty())
    console.print('\n' + console.bold(best.name) + ", fitted on all training records\n" +
                  parameter_table(best.fit));
  console.print('\n' + interval_part(input.ranking, console));
  for (const RankedModel& ranked : input.ranking.models)
    for (const std::string& warning : ranked.fit.warnings)
      console.warn(ranked.name + ": " + warning);
}

std::string interval_part(const Ranking& ranking, const Console& console) {
  const std::string table = interval_table(ranking, console.width());
  return table.empty()
             ? ""
             : console.bold("90 % intervals of the force, on records that they were made without") +
                   '\n' + table + '\n';
}

void prepare_results(const ResultSettings& settings) {
  if (settings.folder.empty()) throw UsageError("--output", "the name of the folder is empty");
  const fs::path models = fs::path(settings.folder) / "models";
  make_folder(models);
  for (const fs::path& folder : {fs::path(settings.folder), models})
    if (access(folder.c_str(), W_OK | X_OK) != 0)
      throw Error(folder.string(),
                  "no file can be written there: " + std::generic_category().message(errno),
                  "give a folder of your own with --output");
}

void write_results(const ReportInput& input, const ResultSettings& settings, Console& console,
                   Say say) {
  const fs::path folder = settings.folder;
  write_models(input, folder / "models", console);
  if (settings.report) write_reports(input, folder, console);
  if (settings.figures) write_figures(input, folder / "figures");
  std::string where = "\n";
  if (settings.report)
    where += "Report   " + (folder / "report.html").string() + " (also .json, .md, .csv)\n";
  where += "Models   " + (folder / "models").string() + "/\n";
  if (settings.figures) where += "Figures  " + (folder / "figures").string() + "/\n";
  say == Say::Result ? console.print(where) : console.talk(where);
}

int exit_code_of(const Ranking& ranking, Console& console) {
  if (std::ranges::any_of(ranking.models, is_usable)) return kDone;
  console.error(
      "no model gave a usable force on the records left out; the table and the warnings say why");
  return kNotUsable;
}

}  // namespace dashpot::cli
