#include "layout.h"

#include <algorithm>

#include "dashpot/base/text.h"

namespace dashpot::cli {
namespace {

constexpr std::size_t kGap = 2;
constexpr std::size_t kNarrowest = 24;  // the last column gets at least this

std::string padded(const std::string& cell, std::size_t width, bool right) {
  const std::string space(width - std::min(width, columns_of(cell)), ' ');
  return right ? space + cell : cell + space;
}

void wrap_line(std::string_view line, std::size_t width, std::vector<std::string>& lines) {
  std::string current;
  for (const std::string& word : split(line, ' ')) {
    if (word.empty()) continue;
    if (!current.empty() && columns_of(current) + 1 + columns_of(word) > width) {
      lines.push_back(current);
      current.clear();
    }
    current += (current.empty() ? "" : " ") + word;
  }
  lines.push_back(current);
}

std::string without_trailing_space(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace

std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string first_columns(std::string_view text, std::size_t columns) {
  std::size_t end = 0;
  for (std::size_t seen = 0; end < text.size(); ++end)
    if ((static_cast<unsigned char>(text[end]) & 0xC0) != 0x80 && ++seen > columns) break;
  return std::string(text.substr(0, end));
}

std::vector<std::string> wrap(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  for (const std::string& line : split(text, '\n')) wrap_line(line, width, lines);
  return lines;
}

std::string paragraph(std::string_view text, std::size_t width, std::size_t indent) {
  std::string result;
  for (const std::string& line : wrap(text, width > indent ? width - indent : width))
    result += line.empty() ? "\n" : std::string(indent, ' ') + line + '\n';
  return result;
}

Table::Table(const std::vector<std::string>& titles) {
  std::vector<std::string> row;
  for (const std::string& title : titles) {
    const bool right = title.starts_with('>');
    right_.push_back(right);
    row.push_back(right ? title.substr(1) : title);
  }
  rows_.push_back(row);
}

void Table::row(std::vector<std::string> cells) {
  cells.resize(right_.size());
  rows_.push_back(std::move(cells));
}

std::string Table::text(std::size_t width, std::size_t indent) const {
  const std::size_t last = right_.size() - 1;
  std::vector<std::size_t> widths(right_.size(), 0);
  for (const std::vector<std::string>& cells : rows_)
    for (std::size_t c = 0; c <= last; ++c) widths[c] = std::max(widths[c], columns_of(cells[c]));
  std::size_t before = indent;
  for (std::size_t c = 0; c < last; ++c) before += widths[c] + kGap;
  widths[last] = std::min(widths[last], width > before + kNarrowest ? width - before : kNarrowest);

  std::string result;
  for (const std::vector<std::string>& cells : rows_) {
    std::string line(indent, ' ');
    for (std::size_t c = 0; c < last; ++c)
      line += padded(cells[c], widths[c], right_[c]) + std::string(kGap, ' ');
    for (const std::string& part : wrap(cells[last], widths[last])) {
      line += padded(part, widths[last], right_[last]);
      result += without_trailing_space(line) + '\n';
      line.assign(before, ' ');
    }
  }
  return result;
}

}  // namespace dashpot::cli
