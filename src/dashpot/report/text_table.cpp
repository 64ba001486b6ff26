#include "dashpot/report/text_table.h"

#include <algorithm>
#include <map>
#include <ranges>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
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

std::size_t longest_word(const std::string& title) {
  std::size_t longest = 0;
  for (const std::string& word : split(title, ' ')) longest = std::max(longest, columns_of(word));
  return longest;
}

/// How wide a column would like to be for its title, and how wide it must be for its cells.
struct ColumnWidth {
  std::size_t wish, least;
};

std::vector<ColumnWidth> widths_of(const std::vector<TextColumn>& columns,
                                   const std::vector<std::vector<std::string>>& rows) {
  std::vector<ColumnWidth> widths;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    std::size_t least = longest_word(columns[k].title);
    for (const auto& row : rows) least = std::max(least, columns_of(row[k]));
    widths.push_back({std::max(least, columns_of(columns[k].title)), least});
  }
  return widths;
}

/// Puts titles onto several lines and shortens elastic columns, each by no more than is needed.
void fit(Layout& layout, const std::vector<TextColumn>& columns,
         const std::vector<ColumnWidth>& widths, std::size_t room) {
  layout.widths.clear();
  for (const ColumnWidth& width : widths) layout.widths.push_back(width.wish);
  const auto narrow = [&](std::size_t column, std::size_t least) {
    const std::size_t excess = layout.total() > room ? layout.total() - room : 0;
    std::size_t& own = layout.widths[column];
    own = std::max(std::min(own, least), own - std::min(own, excess));
  };

  // Titles from the right, what may be shortened from the left.
  for (const std::size_t column : std::views::reverse(layout.shown))
    narrow(column, widths[column].least);
  for (const std::size_t column : layout.shown)
    if (columns[column].elastic) narrow(column, kShortest);
}

/// Fits the columns of a terminal, and drops the least important ones until the rest has room.
Layout lay_out(const std::vector<TextColumn>& columns,
               const std::vector<std::vector<std::string>>& rows, int width) {
  const std::vector<ColumnWidth> widths = widths_of(columns, rows);
  const auto room = static_cast<std::size_t>(std::max(width, 20));
  Layout layout{columns_for(columns, Audience::Terminal), {}};
  fit(layout, columns, widths, room);

  // Or until only those that must stay are left. Those of one title, one beside each of several
  // others, go together: the last of them would seem to be of all.
  while (layout.total() > room) {
    const auto last = std::ranges::max_element(
        layout.shown, {}, [&](std::size_t column) { return columns[column].priority; });
    const TextColumn& least = columns[*last];
    if (least.priority == 0) break;
    std::erase_if(layout.shown, [&](std::size_t column) {
      return columns[column].title == least.title && columns[column].priority == least.priority;
    });
    fit(layout, columns, widths, room);
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
  const Layout layout = lay_out(columns, rows, width);
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

  // The titles stand on the rule, however many lines they take.
  std::vector<std::vector<std::string>> titles(columns.size());
  std::size_t lines = 1;
  for (const std::size_t k : layout.shown) {
    titles[k] = wrap(columns[k].title, layout.widths[k]);
    lines = std::max(lines, titles[k].size());
  }
  for (std::size_t line = 0; line < lines; ++line)
    add_line([&](std::size_t k) {
      const std::size_t above = lines - titles[k].size();
      return line < above ? std::string() : titles[k][line - above];
    });
  text += std::string(layout.total(), '-') + "\n";

  for (const auto& row : rows) add_line([&](std::size_t k) { return row[k]; });
  return text;
}

std::vector<std::string> columns_without_room(const std::vector<TextColumn>& columns,
                                              const std::vector<std::vector<std::string>>& rows,
                                              int width) {
  const Layout layout = lay_out(columns, rows, width);
  std::vector<std::string> titles;
  for (const std::size_t k : columns_for(columns, Audience::Terminal)) {
    const bool is_shown = std::ranges::find(layout.shown, k) != layout.shown.end();
    if (!is_shown && std::ranges::find(titles, columns[k].title) == titles.end())
      titles.push_back(columns[k].title);
  }
  return titles;
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
