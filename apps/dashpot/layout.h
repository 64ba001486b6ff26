#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace dashpot::cli {

/// Columns that UTF-8 text takes on a terminal (one per code point).
std::size_t columns_of(std::string_view text);

/// The text up to so many columns.
std::string first_columns(std::string_view text, std::size_t columns);

/// Lines of at most `width` columns, broken at spaces; the text's own line breaks stand.
std::vector<std::string> wrap(std::string_view text, std::size_t width);

/// Wrapped text with every line behind `indent` spaces; ends with a line break.
std::string paragraph(std::string_view text, std::size_t width, std::size_t indent = 0);

/// A table for a terminal. The last column gives way, line by line, when the terminal is narrow.
class Table {
 public:
  /// A title that begins with '>' stands over a column of numbers, set flush right.
  explicit Table(const std::vector<std::string>& titles);
  void row(std::vector<std::string> cells);
  std::string text(std::size_t width, std::size_t indent = 0) const;

 private:
  std::vector<bool> right_;
  std::vector<std::vector<std::string>> rows_;  // the first holds the titles
};

}  // namespace dashpot::cli
