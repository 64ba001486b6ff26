#pragma once

// Text from outside (names, titles and remarks in files, file names, options) on its way into code
// or markup. It gets there through the escapers below alone, one place for each language: code and
// markup are values of Escaped, to which a std::string does not convert. JSON and XML are written
// by their libraries, which escape; xml_text drops what XML cannot hold.

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dashpot/value.h"

namespace dashpot {

/// Code or markup of one language in which text from outside, if any, stays text.
template <class Language>
class Escaped {
 public:
  Escaped() = default;
  /// A constant of the program. NOLINTNEXTLINE(google-explicit-constructor)
  template <std::size_t size>
  Escaped(const char (&constant)[size]) : text_(constant) {}
  /// What Dashpot itself has written: numbers, names of its own tables, code made of them. Never
  /// what a file or an option says.
  static Escaped own(std::string text) {
    Escaped made;
    made.text_ = std::move(text);
    return made;
  }

  const std::string& text() const { return text_; }
  Escaped& operator+=(const Escaped& more) {
    text_ += more.text_;
    return *this;
  }
  friend Escaped operator+(Escaped first, const Escaped& second) { return first += second; }

 private:
  std::string text_;
};

using CText = Escaped<struct CLanguage>;
using ModelicaText = Escaped<struct ModelicaLanguage>;
using GnuplotText = Escaped<struct GnuplotLanguage>;
using HtmlText = Escaped<struct HtmlLanguage>;
using JsText = Escaped<struct JsLanguage>;

/// The inside of a comment of C: one line that neither ends nor begins a comment, holds no trigraph
/// and no sign that changes the order in which a reader sees the rest.
CText c_comment(std::string_view text);
/// A string of C with its quotes.
CText c_string(std::string_view text);

/// `text` with each @name@ that is among `values` replaced, once: what is filled in is not looked
/// at again.
std::string filled(std::string_view text, const std::vector<std::pair<std::string, CText>>& values);
std::string filled(std::string_view text,
                   const std::vector<std::pair<std::string, ModelicaText>>& values);

/// The inside of a comment of Modelica that ends with its line.
ModelicaText modelica_comment(std::string_view text);
/// HTML inside a string of Modelica, as its documentation is.
ModelicaText modelica_markup(std::string_view text);

/// A string of gnuplot with its quotes, in one line.
GnuplotText gnuplot_string(std::string_view text);
/// The same as the label of a tic, in which gnuplot would take a percent sign for a format.
GnuplotText gnuplot_label(std::string_view text);

/// Text that stands in HTML, between tags or in a quoted attribute.
HtmlText html_text(std::string_view text);
/// JSON that may stand inside a <script> element: no '<' remains, so no text can end the element.
HtmlText script_json(const Value& value);

/// A value as an expression of JavaScript, in a file of its own or inside a <script> element: ASCII
/// alone, without '<'.
JsText js_value(const Value& value);

/// Text as XML can hold it, before the library escapes it: valid UTF-8 without control characters.
std::string xml_text(std::string_view text);

/// One cell of a Markdown table: no pipe, no line end, no markup of its own.
std::string markdown_cell(std::string_view text);
/// Sentences of Markdown that may name things from outside: markup of Dashpot's own stays, no
/// element of HTML begins and no text becomes a link.
std::string markdown_prose(std::string_view text);
/// Code within a line of Markdown, and lines of it, with the marks around them.
std::string markdown_code(std::string_view text);
std::string markdown_block(std::string_view lines);
/// "| a | b |" and a line end.
std::string markdown_row(const std::vector<std::string>& cells);

/// A text of YAML with its quotes, and the inside of a comment that ends with its line.
std::string yaml_string(std::string_view text);
std::string yaml_comment(std::string_view text);

/// One field of a CSV line, quoted when it must be. What a spreadsheet would take for a formula
/// begins with an apostrophe.
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
