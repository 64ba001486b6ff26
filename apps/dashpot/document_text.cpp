#include "document_text.h"

#include "layout.h"

namespace dashpot::cli {

void print_document(const Document& document, Console& console) {
  const auto width = static_cast<std::size_t>(console.width());
  std::string text =
      '\n' + console.bold(document.title) + '\n' + paragraph(document.verdict, width);
  for (const DocumentSection& section : document.sections) {
    if (section.tables.empty()) continue;
    text += '\n' + console.bold(section.title) + '\n';
    for (const DocumentTable& table : section.tables)
      text += paragraph(table.title, width) +
              text_table(table.columns, table.rows, console.width()) + '\n';
    for (const auto* lines : {&section.paragraphs, &section.remarks})
      for (const std::string& line : *lines) text += paragraph(line, width);
  }
  console.print(text);
}

}  // namespace dashpot::cli
