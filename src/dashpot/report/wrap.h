#pragma once
#include <string>
#include <string_view>
#include <vector>

// Text within the columns of a terminal; each code point of UTF-8 takes one.
namespace dashpot {

/// Columns that a text takes.
std::size_t columns_of(std::string_view text);

/// The text up to so many columns.
std::string first_columns(std::string_view text, std::size_t columns);

/// The text with spaces behind it, or before it when `right`, to fill `width` columns.
std::string padded(const std::string& text, std::size_t width, bool right);

/// Lines of at most `width` columns, broken at spaces; the text's own line breaks stay.
std::vector<std::string> wrap(std::string_view text, std::size_t width);

/// Wrapped text with every line behind `indent` spaces; ends with a line break.
std::string paragraph(std::string_view text, std::size_t width, std::size_t indent = 0);

}  // namespace dashpot
