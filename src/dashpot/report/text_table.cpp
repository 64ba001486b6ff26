#include "dashpot/report/text_table.h"

#include <algorithm>
#include <map>

#include "dashpot/base/escape.h"
#include "dashpot/report/wrap.h"

namespace dashpot {

namespace {

constexpr std::size_t kGap = 2, kShortest = 20;

/// The beginning of the text, or, to tell texts of one beginning apart, its beginning and its end.
std::string shortened(const std::string& text, std::size_t width, bool with_end) {
  if (columns_of(text) <= width) return text;
  const std::size_t end = with_end ? (width - 2) / 2 : 0;
  const std::string before_end = first_columns(text, columns_of(text) - end);
  return first_columns(text, width - 2 - end) + ".." + text.substr(before_end.size());
}

/// Whether unlike cells of a column have the same beginning of that width.
bool begin_alike(const std::vector<std::vector<std::string>>& rows, std::size_t column,
                 std::size_t width) {
  std::map<std::string, std::string> seen;
  return std::ranges::any_of(rows, [&](const std::vector<std::string>& row) {
    const std::string& cell = row[column];
    return seen.emplace(shortened(cell, width, false), cell).first->second != cell;
  });
}

struct Layout {
  std::vector<std::size_t> shown;   ///< columns, in order
  std::vector<std::size_t> widths;  ///< of every column

  std::size_t total() const {
    std::size_t sum = kGap * (shown.empty() ? 0 : shown.size() - 1);
    for (const std::size_t column : shown) sum += widths[column];
    return sum;
  }
};

/// Shortens the elastic columns of a terminal, then drops the least important ones.
Layout lay_out(const std::vector<TextColumn>& columns, std::vector<std::size_t> widths,
               std::size_t room) {
  Layout layout{columns_for(columns, Audience::Terminal), std::move(widths)};

  // Shorten from the left, each column by no more than is needed.
  for (const std::size_t column : layout.shown) {
    const std::size_t excess = layout.total() > room ? layout.total() - room : 0;
    std::size_t& width = layout.widths[column];
    if (columns[column].elastic && width > kShortest)
      width = std::max(kShortest, width - std::min(width, excess));
  }

  // Drop whole columns until the rest has room, or only those that must stay are left. Those of one
  // title, one beside each of several others, go together: the last of them would seem to be of
  // all.
  while (layout.total() > room) {
    const auto last = std::ranges::max_element(
        layout.shown, {}, [&](std::size_t column) { return columns[column].priority; });
    const TextColumn& least = columns[*last];
    if (least.priority == 0) break;
    std::erase_if(layout.shown, [&](std::size_t column) {
      return columns[column].title == least.title && columns[column].priority == least.priority;
    });
  }
  return layout;
}

}  // namespace

bool reaches(Audience audience, Audience medium) {
  return audience == Audience::Everyone || audience == medium ||
         (audience == Audience::Text && medium != Audience::Page) ||
         (audience == Audience::Files && medium != Audience::Terminal);
}

std::vector<std::size_t> columns_for(const std::vector<TextColumn>& columns, Audience medium) {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (reaches(columns[k].audience, medium)) places.push_back(k);
  return places;
}

std::string text_table(const std::vector<TextColumn>& columns,
                       const std::vector<std::vector<std::string>>& rows, int width) {
  // The widest cell of each column says how wide it would like to be.
  std::vector<std::size_t> widths;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    widths.push_back(columns_of(columns[k].title));
    for (const auto& row : rows) widths[k] = std::max(widths[k], columns_of(row[k]));
  }
  const Layout layout =
      lay_out(columns, std::move(widths), static_cast<std::size_t>(std::max(width, 20)));

  std::vector<bool> with_end(columns.size(), false);
  for (const std::size_t k : layout.shown) with_end[k] = begin_alike(rows, k, layout.widths[k]);

  std::string text;
  const auto add_line = [&](const auto& cell) {
    std::string line;
    for (const std::size_t k : layout.shown) {
      if (!line.empty()) line.append(kGap, ' ');
      const std::string part = shortened(cell(k), layout.widths[k], with_end[k]);
      line += padded(part, layout.widths[k], columns[k].numeric);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  };
  add_line([&](std::size_t k) { return columns[k].title; });
  text += std::string(layout.total(), '-') + "\n";
  for (const auto& row : rows) add_line([&](std::size_t k) { return row[k]; });
  return text;
}

std::string markdown_table(const std::vector<TextColumn>& columns,
                           const std::vector<std::vector<std::string>>& rows) {
  const std::vector<std::size_t> shown = columns_for(columns, Audience::Markdown);
  const auto line = [&](const auto& cell) {
    std::vector<std::string> cells;
    for (const std::size_t k : shown) cells.push_back(cell(k));
    return markdown_row(cells);
  };
  std::string rule = "|";
  for (const std::size_t k : shown) rule += columns[k].numeric ? "---:|" : "---|";

  std::string text = line([&](std::size_t k) { return columns[k].title; }) + rule + "\n";
  for (const auto& row : rows) text += line([&](std::size_t k) { return row[k]; });
  return text;
}

}  // namespace dashpot
