#pragma once
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "dashpot/record/readers/line_source.h"
#include "dashpot/record/readers/table.h"

namespace dashpot {

/// Any text table: separators, decimal sign, names, units and junk lines are found by
/// csv_dialect.h. Comes last among the readers, since it takes any text with a usual extension.
bool is_csv(const std::filesystem::path& path, std::string_view extension, std::string_view head);

/// Reads one table. Streams the file: memory is what the columns need. Cells that are no finite
/// numbers become NaN and are an error only when their column is used. Throws Error when a line has
/// more cells than the table, and NoTable when no line holds numbers.
std::vector<RawTable> read_csv(const std::filesystem::path& path);

/// The same from lines of any origin, into a table that has its place and no columns yet.
/// `separator` is the cells' where it is known.
void read_lines(Lines& source, std::optional<char> separator, RawTable& table);

/// A small table of texts, such as a manifest: the names of the first line, then rows of cells,
/// each row at least as long as `names`. Throws Error(file:line, ...) on a shorter row.
struct TextTable {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> lines;  ///< of each row in the file
  char decimal = '.';              ///< ',' where numbers are written with it and none separates
};
TextTable read_text_table(const std::filesystem::path& path);

}  // namespace dashpot
