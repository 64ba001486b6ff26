#include "study_results.h"

#include "console.h"
#include "dashpot/base/date.h"
#include "dashpot/base/file.h"
#include "document_text.h"

namespace dashpot::cli {

std::vector<Option> study_result_options(StudyResults& results, const std::string& kept) {
  return {{.names = "-o,--output",
           .target = &results.folder,
           .help = "folder for the page and the " + kept,
           .value = "DIR",
           .takes = Takes::Folder},
          figures_option(results.figures),
          {.names = "--fresh",
           .target = &results.fresh,
           .help = "neither use nor keep finished " + kept}};
}

void prepare_study(const StudyResults& results) {
  if (results.folder.empty()) throw UsageError("--output", "the name of the folder is empty");
  make_folder(results.folder);
}

void write_study(Document document, Value data, const StudyResults& results, Console& console) {
  document.command = console.command_line();
  document.version = DASHPOT_VERSION;
  document.date = date_now();
  document.data = std::move(data);
  print_document(document, console);
  console.print('\n' + write_document(document, results.folder, "report", results.figures));
  if (console.json) console.print_json(document_json(document));
}

}  // namespace dashpot::cli
