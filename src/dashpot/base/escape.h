#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/value.h"

namespace dashpot {

/// Text that stands in HTML, between tags or in a quoted attribute.
std::string escape_html(std::string_view text);

/// JSON that may stand inside a <script> element: no '<' remains, so no text can end the element.
std::string script_json(const Value& value);

/// One cell of a Markdown table: no pipe, no line end, no markup of its own.
std::string markdown_cell(std::string_view text);
/// "| a | b |" and a line end.
std::string markdown_row(const std::vector<std::string>& cells);

/// One field of a CSV line, quoted when it must be.
std::string csv_field(std::string_view text);

/// The text with every byte that is not UTF-8 replaced by U+FFFD: record names come from file
/// names.
std::string valid_utf8(std::string_view text);

/// Text for a terminal: valid UTF-8, and no control character but line ends, tabs and colours
/// becomes effective, since names come from files.
std::string terminal_text(std::string_view text);

/// The value as JSON can hold it: numbers that are not finite become null, text becomes valid
/// UTF-8.
Value presentable(const Value& value);

}  // namespace dashpot
