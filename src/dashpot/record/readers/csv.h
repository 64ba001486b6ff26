#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "dashpot/record/readers/table.h"

namespace dashpot {

/// Any text table: separators, decimal sign, names, units and junk lines are found by csv_dialect.
bool is_csv(const std::filesystem::path& path, std::string_view extension, std::string_view head);

/// Streams the file: memory is what the columns need. Throws Error when it is no table, or when a
/// line has another number of cells than the table.
std::vector<RawTable> read_csv(const std::filesystem::path& path);

/// A small table of texts, such as a manifest: the names of the first line, then rows of cells.
struct TextTable {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> lines;  ///< of each row in the file
};
TextTable read_text_table(const std::filesystem::path& path);

}  // namespace dashpot
