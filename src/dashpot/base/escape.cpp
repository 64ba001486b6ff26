#include "dashpot/base/escape.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

namespace dashpot {
namespace {

/// Bytes of the well-formed UTF-8 sequence at the start of `text`; 0 when there is none.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
  // Overlong forms, surrogates and what lies beyond U+10FFFF.
  if ((lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xED && byte(1) > 0x9F)) return 0;
  if ((lead == 0xF0 && byte(1) < 0x90) || (lead == 0xF4 && byte(1) > 0x8F)) return 0;
  return length;
}

/// What a well-formed UTF-8 sequence stands for.
std::uint32_t code_point(std::string_view sequence) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(sequence[i]); };
  if (sequence.size() == 1) return byte(0);
  std::uint32_t code = byte(0) & (0x7FU >> sequence.size());
  for (std::size_t i = 1; i < sequence.size(); ++i) code = (code << 6) | (byte(i) & 0x3FU);
  return code;
}

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

bool is_control(char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7F; }

/// Signs that are not seen and change the order of what is (U+200E, U+200F, U+202A ... U+202E,
/// U+2066 ... U+2069, U+061C), and line ends beyond ASCII (U+0085, U+2028, U+2029).
bool rearranges(std::string_view sign) {
  if (sign.size() == 2) return sign == "\xD8\x9C" || sign == "\xC2\x85";
  if (sign.size() != 3 || !sign.starts_with("\xE2")) return false;
  const auto third = static_cast<unsigned char>(sign[2]);
  if (sign[1] == '\x81') return third >= 0xA6 && third <= 0xA9;
  return sign[1] == '\x80' && (third == 0x8E || third == 0x8F || (third >= 0xA8 && third <= 0xAE));
}

/// The text as one line of code shows it: valid UTF-8, spaces for control characters, nothing that
/// rearranges the line.
std::string one_line(std::string_view text) {
  std::string result;
  const std::string valid = valid_utf8(text);
  for (std::string_view left = valid; !left.empty();) {
    const std::string_view sign = left.substr(0, sequence_length(left));
    if (rearranges(sign))
      result += kReplacement;
    else if (is_control(sign[0]))
      result += ' ';
    else
      result += sign;
    left.remove_prefix(sign.size());
  }
  return result;
}

/// Each `pair` of signs with a space between them.
std::string apart(std::string text, std::string_view pair) {
  for (std::size_t at = 0; (at = text.find(pair, at)) != std::string::npos; ++at)
    text.insert(at + 1, " ");
  return text;
}

/// A backslash at the end would draw the next line into this one.
std::string without_open_end(std::string text) {
  const std::size_t last = text.find_last_not_of(' ');
  if (last != std::string::npos && text[last] == '\\') text.insert(last + 1, ".");
  return text;
}

/// The signs that HTML gives a meaning, as what it shows for them.
std::string in_html(std::string_view text) {
  std::string result;
  for (const char c : valid_utf8(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string doubled(std::string_view text, char which) {
  std::string result;
  for (const char c : text) {
    if (c == which) result += c;
    result += c;
  }
  return result;
}

template <class Text>
std::string fill_in(std::string_view text,
                    const std::vector<std::pair<std::string, Text>>& values) {
  std::string result;
  for (std::size_t open; (open = text.find('@')) != std::string_view::npos;) {
    const std::size_t close = text.find('@', open + 1);
    const auto value = close == std::string_view::npos
                           ? values.end()
                           : std::ranges::find(values, text.substr(open + 1, close - open - 1),
                                               &std::pair<std::string, Text>::first);
    result += text.substr(0, open);
    if (value == values.end()) {
      result += '@';
      text.remove_prefix(open + 1);
    } else {
      result += value->second.text();
      text.remove_prefix(close + 1);
    }
  }
  return result.append(text);
}

}  // namespace

CText c_comment(std::string_view text) {
  std::string line = one_line(text);
  for (const std::string_view pair : {"*/", "/*", "??"}) line = apart(std::move(line), pair);
  return CText::own(without_open_end(std::move(line)));
}

CText c_string(std::string_view text) {
  // Other bytes than letters of ASCII in octal, of three digits always, so that none of the next
  // joins them; no question mark, so no trigraph.
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = !is_control(c) && byte < 0x80 && c != '"' && c != '\\' && c != '?';
    if (is_plain) {
      result += c;
    } else {
      result += '\\';
      for (const int shift : {6, 3, 0}) result += static_cast<char>('0' + ((byte >> shift) & 7));
    }
  }
  return CText::own(result + '"');
}

std::string filled(std::string_view text,
                   const std::vector<std::pair<std::string, CText>>& values) {
  return fill_in(text, values);
}

std::string filled(std::string_view text,
                   const std::vector<std::pair<std::string, ModelicaText>>& values) {
  return fill_in(text, values);
}

ModelicaText modelica_comment(std::string_view text) {
  return ModelicaText::own(without_open_end(one_line(text)));
}

ModelicaText modelica_markup(std::string_view text) {
  std::string result;
  for (const char c : in_html(one_line(text)))
    result += c == '\\' ? std::string("&#92;") : std::string(1, c);
  return ModelicaText::own(result);
}

GnuplotText gnuplot_string(std::string_view text) {
  // A quote is written twice, but gnuplot 5.4 misreads two such, and one at the beginning.
  std::string line = apart(one_line(text), "''");
  if (line.starts_with('\'')) line.insert(0, " ");
  return GnuplotText::own('\'' + doubled(line, '\'') + '\'');
}

GnuplotText gnuplot_label(std::string_view text) { return gnuplot_string(doubled(text, '%')); }

HtmlText html_text(std::string_view text) { return HtmlText::own(in_html(text)); }

HtmlText script_json(const Value& value) {
  // In JSON a '<' can only stand inside a string, where \u003c means the same.
  std::string result;
  for (const char c : format_json(value, false)) {
    if (c == '<')
      result += "\\u003c";
    else
      result += c;
  }
  return HtmlText::own(result);
}

JsText js_value(const Value& value) {
  // Beyond ASCII, too, signs stand inside strings alone: they become units of UTF-16.
  std::string result;
  const auto unit = [&](unsigned code) { result += fmt::format("\\u{:04x}", code); };
  const std::string json = format_json(presentable(value), false);
  for (std::string_view left = json; !left.empty();) {
    const std::string_view sign = left.substr(0, sequence_length(left));
    const std::uint32_t code = code_point(sign);
    if (code >= 0x10000) {
      unit(0xD7C0 + (code >> 10));
      unit(0xDC00 + (code & 0x3FF));
    } else if (code >= 0x7F || code == '<') {
      unit(code);
    } else {
      result += sign;
    }
    left.remove_prefix(sign.size());
  }
  return JsText::own(result);
}

std::string xml_text(std::string_view text) {
  std::string result = valid_utf8(text);
  std::ranges::replace_if(
      result, [](char c) { return is_control(c) && c != '\n' && c != '\t'; }, ' ');
  // U+FFFE and U+FFFF are no characters.
  for (const std::string_view none : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})
    for (std::size_t at = 0; (at = result.find(none, at)) != std::string::npos;)
      result.replace(at, none.size(), kReplacement);
  return result;
}

std::string markdown_cell(std::string_view text) {
  std::string result;
  for (const char c : valid_utf8(text)) {
    if (c == '\n' || c == '\r') {
      result += ' ';
      continue;
    }
    if (std::string_view("\\`*_[]|<>#").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string markdown_prose(std::string_view text) {
  std::string result;
  const std::string valid = valid_utf8(text);
  for (std::size_t k = 0; k < valid.size(); ++k) {
    const char c = valid[k], next = k + 1 < valid.size() ? valid[k + 1] : ' ';
    const bool opens = c == '<' && (next == '/' || next == '!' || next == '?' ||
                                    (next >= 'a' && next <= 'z') || (next >= 'A' && next <= 'Z'));
    if (opens || (c == ']' && (next == '(' || next == '['))) result += '\\';
    result += c;
  }
  return result;
}

std::string markdown_code(std::string_view text) {
  // More backticks around it than are within.
  const std::string line = one_line(text);
  std::string mark = "`";
  while (line.find(mark) != std::string::npos) mark += '`';
  const std::string space = mark.size() > 1 ? " " : "";
  return mark + space + line + space + mark;
}

std::string markdown_block(std::string_view lines) {
  const std::string valid = valid_utf8(lines);
  std::string mark = "```";
  while (valid.find(mark) != std::string::npos) mark += '`';
  return mark + "\n" + valid + mark + "\n";
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + markdown_cell(cell) + " |";
  return row + "\n";
}

std::string yaml_string(std::string_view text) {
  // YAML reads texts that are quoted as in JSON.
  return format_json(Value(valid_utf8(text)), false);
}

std::string yaml_comment(std::string_view text) { return one_line(text); }

std::string csv_field(std::string_view text) {
  const char first = text.empty() ? ' ' : text[0];
  const bool is_formula =
      first == '=' || first == '@' || first == '\t' || first == '\r' ||
      ((first == '+' || first == '-') && text.find_first_of("(|!") != std::string_view::npos);
  const std::string field = (is_formula ? "'" : "") + std::string(text);
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  return '"' + doubled(field, '"') + '"';
}

std::string valid_utf8(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = sequence_length(text);
    if (length)
      result += text.substr(0, length);
    else
      result += "\xEF\xBF\xBD";
    text.remove_prefix(length ? length : 1);
  }
  return result;
}

std::string terminal_text(std::string_view text) {
  std::string result = valid_utf8(text);
  for (std::size_t k = 0; k < result.size(); ++k) {
    const auto c = static_cast<unsigned char>(result[k]);
    if ((c >= ' ' && c != 0x7F) || c == '\n' || c == '\t') continue;
    const std::size_t end = result.find_first_not_of("0123456789;", k + 2);
    const bool colour = c == 0x1B && result.substr(k + 1, 1) == "[" && end != std::string::npos &&
                        result[end] == 'm';
    if (!colour) result[k] = '?';
  }
  return result;
}

Value presentable(const Value& value) {
  // Numbers and texts are mended, all else is looked into.
  switch (value.kind()) {
    case Value::Kind::Number:
      return std::isfinite(value.as_number()) ? value : Value();
    case Value::Kind::String:
      return valid_utf8(value.as_string());
    case Value::Kind::Array: {
      Value result = Value::array();
      for (const Value& item : value.items()) result.push_back(presentable(item));
      return result;
    }
    case Value::Kind::Object: {
      Value result = Value::object();
      for (const auto& [key, member] : value.members())
        result.add(valid_utf8(key), presentable(member));
      return result;
    }
    default:
      return value;
  }
}

}  // namespace dashpot
