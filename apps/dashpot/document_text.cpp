#include "document_text.h"

#include "dashpot/base/file.h"
#include "dashpot/report/printed_page.h"

namespace dashpot::cli {

void print_document(const Document& document, Console& console) {
  console.print(document_text(document, console.width(),
                              [&](std::string_view text) { return console.bold(text); }));
}

void add_doubts(std::vector<std::string> doubts, Document& document) {
  if (doubts.empty()) return;
  document.sections.push_back({.name = "doubts",
                               .title = "In doubt",
                               .paragraphs = {},
                               .remarks = std::move(doubts),
                               .audience = Audience::Files});
}

namespace {

bool is_pdf(const std::string& path) { return path.ends_with(".pdf"); }

}  // namespace

void require_output(const std::string& path) {
  if (!path.empty()) require_writable(path);
}

void require_page(const std::string& path) {
  require_output(path);
  if (is_pdf(path)) require_browser();
}

void write_page(const Document& document, const std::string& path) {
  const std::string page = html_document(document);
  write_file(path, is_pdf(path) ? pdf_of_page(page) : page);
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
