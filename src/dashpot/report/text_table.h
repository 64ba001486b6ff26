#pragma once
#include <string>
#include <vector>

namespace dashpot {

/// A column of a table for a terminal.
struct TextColumn {
  std::string title;
  bool numeric = false;  ///< right-aligned
  int priority = 0;      ///< the greatest go first when the table is too wide; 0 always stays
  bool elastic = false;  ///< may be shortened, to 20 characters
};

/// Aligned columns, two spaces apart, with a rule below the titles, within `width` characters where
/// leaving out and shortening columns can make it so.
std::string text_table(const std::vector<TextColumn>& columns,
                       const std::vector<std::vector<std::string>>& rows, int width);

/// All columns, as Markdown.
std::string markdown_table(const std::vector<TextColumn>& columns,
                           const std::vector<std::vector<std::string>>& rows);

}  // namespace dashpot
