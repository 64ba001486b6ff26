#include "study_results.h"

#include <filesystem>

#include "console.h"
#include "dashpot/base/file.h"
#include "dashpot/report/safe_text.h"
#include "document_text.h"
#include "results.h"

namespace dashpot::cli {

namespace fs = std::filesystem;

std::vector<Option> study_result_options(StudyResults& results, const std::string& kept) {
  return {{.names = "-o,--output",
           .target = &results.folder,
           .help = "folder for the page and the " + kept,
           .value = "DIR",
           .takes = Takes::Folder},
          {.names = "--figures",
           .target = &results.figures,
           .help = "also draw the figures as SVG and PDF (needs gnuplot)"},
          {.names = "--fresh",
           .target = &results.fresh,
           .help = "neither use nor keep finished " + kept}};
}

void prepare_study(const StudyResults& results) {
  if (results.folder.empty()) throw UsageError("--output", "the name of the folder is empty");
  make_folder(results.folder);
}

void write_study(Document document, const Value& data, const StudyResults& results,
                 Console& console) {
  document.command = console.command_line();
  document.version = DASHPOT_VERSION;
  document.date = date_now();
  print_document(document, console);
  const fs::path folder = results.folder;
  const Value shown = presentable(data);
  write_file(folder / "report.json", format_json(shown));
  write_file(folder / "report.html", html_document(document));
  if (results.figures) write_document_figures(document, folder / "figures");
  write_file(folder / "report.md", markdown_document(document, results.figures ? "figures" : ""));
  std::string where = "\nReport   " + (folder / "report.html").string() + " (also .json, .md)\n";
  if (results.figures) where += "Figures  " + (folder / "figures").string() + "/\n";
  console.print(where);
  if (console.json) console.print_json(shown);
}

}  // namespace dashpot::cli
