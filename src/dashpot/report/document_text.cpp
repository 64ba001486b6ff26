// A document for a terminal.
#include <algorithm>

#include <fmt/format.h>

#include "dashpot/report/document.h"
#include "dashpot/report/wrap.h"

namespace dashpot {
namespace {

/// A table with its title and note; of many rows only those that a terminal has room for.
std::string table_text(const DocumentTable& table, int width) {
  const auto columns = static_cast<std::size_t>(width);
  std::string text = table.title.empty() ? "" : paragraph(table.title, columns);
  if (table.brief.empty()) {
    text += text_table(table.columns, table.rows, width);
  } else {
    std::vector<std::vector<std::string>> rows;
    for (const std::size_t row : table.brief) rows.push_back(table.rows[row]);
    text += text_table(table.columns, rows, width);
    if (const std::size_t more = table.rows.size() - rows.size())
      text += fmt::format("... and {} more; the report holds all\n", more);
  }
  return table.note.empty() ? text : text + paragraph(table.note, columns);
}

/// Nothing where only words would stand: these are left to Markdown and page.
std::string section_text(const Document& document, const DocumentSection& section, int width) {
  const auto is_shown = [&](const auto& part) {
    return reaches(part.audience, Audience::Terminal) && is_open(document, part.when);
  };
  std::string text = section.plain;
  for (const DocumentTable& table : section.tables)
    if (is_shown(table)) text += (text.empty() ? "" : "\n") + table_text(table, width);
  if (text.empty()) return text;

  // Words stand below the tables, nearer to where the reader's eye rests.
  std::string words;
  for (const auto* lines : {&section.paragraphs, &section.remarks})
    for (const std::string& line : *lines)
      words += paragraph(line, static_cast<std::size_t>(width));
  return words.empty() ? text : text + '\n' + words;
}

}  // namespace

bool is_open(const Document& document, const When& when) {
  const auto chosen = [&](const std::string& name) -> std::size_t {
    for (const DocumentSection& section : document.sections)
      for (const DocumentChoice& choice : section.choices)
        if (choice.name == name) return choice.chosen;
    return 0;
  };
  return std::ranges::all_of(when, [&](const auto& one) {
    return std::ranges::find(one.second, chosen(one.first)) != one.second.end();
  });
}

std::string document_text(const Document& document, int width,
                          const std::function<std::string(std::string_view)>& bold) {
  const auto title = [&](const std::string& text) { return (bold ? bold(text) : text) + '\n'; };
  std::string text =
      '\n' + title(document.title) + paragraph(document.verdict, static_cast<std::size_t>(width));
  for (const DocumentSection& section : document.sections) {
    if (!reaches(section.audience, Audience::Terminal)) continue;
    if (const std::string part = section_text(document, section, width); !part.empty())
      text += '\n' + title(section.title) + part;
  }
  return text;
}

}  // namespace dashpot
