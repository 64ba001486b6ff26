#include "document_text.h"

#include "dashpot/base/file.h"

namespace dashpot::cli {

void print_document(const Document& document, Console& console) {
  console.print(document_text(document, console.width(),
                              [&](std::string_view text) { return console.bold(text); }));
}

std::string write_document(const Document& document, const std::filesystem::path& folder,
                           const std::string& name, bool figures, const std::string& csv) {
  const std::filesystem::path page = folder / (name + ".html");
  write_file(page, html_document(document));
  write_file(folder / (name + ".json"), format_json(document_json(document)));
  if (figures) write_document_figures(document, folder / "figures");
  write_file(folder / (name + ".md"), markdown_document(document, figures ? "figures" : ""));
  if (!csv.empty()) write_file(folder / (name + ".csv"), csv);
  return "Report   " + page.string() + " (also .json, .md" + (csv.empty() ? "" : ", .csv") + ")\n" +
         (figures ? "Figures  " + (folder / "figures").string() + "/\n" : "");
}

}  // namespace dashpot::cli
