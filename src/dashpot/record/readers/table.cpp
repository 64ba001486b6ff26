#include "dashpot/record/readers/table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dashpot/base/text.h"

namespace dashpot {

bool RawTable::named() const {
  return std::any_of(columns.begin(), columns.end(),
                     [](const RawColumn& c) { return !c.name.empty(); });
}

void RawTable::append_row(std::span<const std::string_view> cells, std::size_t line, char decimal) {
  const std::size_t row = rows();
  if (lines.empty() || lines.back().second + row - lines.back().first != line)
    lines.emplace_back(row, line);

  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::string_view cell = k < cells.size() ? cells[k] : std::string_view();
    const auto value = parse_number(cell, decimal);
    const bool good = value && std::isfinite(*value);
    RawColumn& column = columns[k];
    if (!good && !column.bad) column.bad = BadCell{row, std::string(cell.substr(0, 40))};
    column.values.push_back(good ? *value : std::numeric_limits<double>::quiet_NaN());
  }
}

std::string RawTable::place() const { return part.empty() ? file : file + ", " + part; }

std::string RawTable::at_line(std::size_t line) const {
  return (part_name.empty() ? file : place()) + ":" + std::to_string(line);
}

std::string RawTable::where(std::size_t row) const {
  if (lines.empty()) return place() + ", row " + std::to_string(row + 1);
  auto jump = std::upper_bound(lines.begin(), lines.end(), row,
                               [](std::size_t r, const auto& line) { return r < line.first; });
  if (jump != lines.begin()) --jump;
  return at_line(jump->second + row - jump->first);
}

std::string RawTable::column_list() const {
  if (!named()) return std::to_string(columns.size()) + " columns without names";
  std::vector<std::string> names;
  for (const RawColumn& column : columns) names.push_back("'" + column.name + "'");
  if (names.size() > 24) names.resize(24), names.push_back("...");
  return join(names, ", ") + passed_over();
}

std::string RawTable::passed_over() const {
  constexpr std::size_t kTold = 3;
  std::string told;
  std::size_t count = 0;
  for (const std::string& note : notes)
    if (note.find(" passed over: ") != std::string::npos && count++ < kTold) told += "; " + note;
  return count > kTold ? told + "; and " + std::to_string(count - kTold) + " more" : told;
}

}  // namespace dashpot
