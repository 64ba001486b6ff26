#include "dashpot/record/readers/table.h"

#include <algorithm>

#include "dashpot/base/text.h"

namespace dashpot {

bool RawTable::named() const {
  return std::any_of(columns.begin(), columns.end(),
                     [](const RawColumn& c) { return !c.name.empty(); });
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
