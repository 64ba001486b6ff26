#include "layout.h"

#include <algorithm>

namespace dashpot::cli {
namespace {

constexpr std::size_t kGap = 2;
constexpr std::size_t kNarrowest = 18;  // with less left, the last column goes below its row
constexpr std::size_t kBelow = 4;       // and is indented by this

std::string without_trailing_space(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace

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
  // Each column is as wide as its widest cell; the last one takes what is left of the line.
  const std::size_t last = right_.size() - 1;
  std::vector<std::size_t> widths(right_.size(), 0);
  for (const std::vector<std::string>& cells : rows_)
    for (std::size_t c = 0; c <= last; ++c) widths[c] = std::max(widths[c], columns_of(cells[c]));
  std::size_t before = indent;
  for (std::size_t c = 0; c < last; ++c) before += widths[c] + kGap;
  const bool is_beside =
      last == 0 || right_[last] || width >= before + std::min(widths[last], kNarrowest);
  const std::size_t start = is_beside ? before : indent + kBelow;
  widths[last] = std::min(widths[last], width > start + kNarrowest ? width - start : kNarrowest);

  // A cell of the last column that needs several lines goes on below its first.
  std::string result;
  for (const std::vector<std::string>& cells : rows_) {
    std::string line(indent, ' ');
    for (std::size_t c = 0; c < last; ++c)
      line += padded(cells[c], widths[c], right_[c]) + std::string(kGap, ' ');
    if (!is_beside) {
      result += without_trailing_space(line) + '\n';
      if (cells[last].empty() || &cells == &rows_.front()) continue;
      line.assign(start, ' ');
    }
    for (const std::string& part : wrap(cells[last], widths[last])) {
      line += padded(part, widths[last], right_[last]);
      result += without_trailing_space(line) + '\n';
      line.assign(start, ' ');
    }
  }
  return result;
}

}  // namespace dashpot::cli
