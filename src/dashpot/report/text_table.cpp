#include "dashpot/report/text_table.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "dashpot/report/safe_text.h"

namespace dashpot {

namespace {

constexpr std::size_t kGap = 2, kShortest = 20;

/// Characters, not bytes: continuation bytes of UTF-8 take no room.
std::size_t shown_width(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string shortened(const std::string& text, std::size_t width) {
  if (shown_width(text) <= width) return text;
  std::size_t end = 0;
  for (std::size_t characters = 0; end < text.size(); ++end)
    if ((static_cast<unsigned char>(text[end]) & 0xC0) != 0x80 && ++characters == width - 1) break;
  return text.substr(0, end) + "..";
}

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string space(width - std::min(width, shown_width(text)), ' ');
  return right ? space + text : text + space;
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

/// Shortens elastic columns, then drops the least important ones.
Layout lay_out(const std::vector<TextColumn>& columns, std::vector<std::size_t> widths,
               std::size_t room) {
  Layout layout{std::vector<std::size_t>(columns.size()), std::move(widths)};
  std::iota(layout.shown.begin(), layout.shown.end(), std::size_t{0});
  for (const std::size_t column : layout.shown) {
    const std::size_t excess = layout.total() > room ? layout.total() - room : 0;
    std::size_t& width = layout.widths[column];
    if (columns[column].elastic && width > kShortest)
      width = std::max(kShortest, width - std::min(width, excess));
  }
  while (layout.total() > room) {
    const auto last = std::ranges::max_element(
        layout.shown, {}, [&](std::size_t column) { return columns[column].priority; });
    if (columns[*last].priority == 0) break;
    layout.shown.erase(last);
  }
  return layout;
}

}  // namespace

std::string text_table(const std::vector<TextColumn>& columns,
                       const std::vector<std::vector<std::string>>& rows, int width) {
  std::vector<std::size_t> widths;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    widths.push_back(shown_width(columns[k].title));
    for (const auto& row : rows) widths[k] = std::max(widths[k], shown_width(row[k]));
  }
  const Layout layout =
      lay_out(columns, std::move(widths), static_cast<std::size_t>(std::max(width, 20)));

  std::string text;
  const auto add_line = [&](const auto& cell) {
    std::string line;
    for (const std::size_t k : layout.shown) {
      if (!line.empty()) line.append(kGap, ' ');
      line += padded(shortened(cell(k), layout.widths[k]), layout.widths[k], columns[k].numeric);
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
  std::vector<std::string> titles;
  std::string rule = "|";
  for (const TextColumn& column : columns) {
    titles.push_back(column.title);
    rule += column.numeric ? "---:|" : "---|";
  }
  std::string text = markdown_row(titles) + rule + "\n";
  for (const auto& row : rows) text += markdown_row(row);
  return text;
}

}  // namespace dashpot
