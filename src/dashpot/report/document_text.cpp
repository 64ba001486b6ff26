// A document for a terminal.
#include <algorithm>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/document.h"
#include "dashpot/report/wrap.h"

namespace dashpot {
namespace {

/// A table with its title and note; of many rows only those that a terminal has room for.
std::string table_text(const DocumentTable& table, int width) {
  const auto columns = static_cast<std::size_t>(width);
  std::string text = table.title.empty() ? "" : paragraph(table.title, columns);
  std::vector<std::vector<std::string>> rows;
  for (const std::size_t row : table.brief) rows.push_back(table.rows[row]);
  if (table.brief.empty()) rows = table.rows;
  text += text_table(table.columns, rows, width);

  // What there is no room for is told.
  if (const std::size_t more = table.rows.size() - rows.size())
    text += fmt::format("... and {} more; the report holds all\n", more);
  const std::vector<std::string> left_out = columns_without_room(table.columns, rows, width);
  if (!left_out.empty())
    text += paragraph("No room for the columns: " + join(left_out, ", "), columns);
  return table.note.empty() ? text : text + paragraph(table.note, columns);
}

/// Text with lines of its own: those that are too long go on below, further in than they began.
std::string plain_text_within(const std::string& text, std::size_t width) {
  constexpr std::size_t kFurtherIn = 4, kLeast = 20;
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    if (columns_of(line) <= width || indent + kFurtherIn + kLeast > width) {
      result += line + '\n';
      continue;
    }

    // Up to the last space that fits, with the spaces between the columns of a table kept.
    const std::string head = first_columns(line, width + 1);
    const std::size_t space = head.find_last_of(' ');
    if (space == std::string::npos || space <= indent) {
      result += line + '\n';
      continue;
    }
    result += line.substr(0, line.find_last_not_of(' ', space) + 1) + '\n' +
              paragraph(line.substr(space + 1), width, indent + kFurtherIn);
  }
  return result;
}

/// Nothing where only words would stand: these are left to Markdown and page.
std::string section_text(const Document& document, const DocumentSection& section, int width) {
  const auto is_shown = [&](const auto& part) {
    return reaches(part.audience, Audience::Terminal) && is_open(document, part.when);
  };
  std::string text = plain_text_within(section.plain, static_cast<std::size_t>(width));
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

std::string document_text(const Document& si, int width,
                          const std::function<std::string(std::string_view)>& bold) {
  const Document document = in_units(si);
  const auto title = [&](const std::string& text) {
    std::string lines;
    for (const std::string& line : wrap(text, static_cast<std::size_t>(width)))
      lines += (bold ? bold(line) : line) + '\n';
    return lines;
  };
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
