#include "dashpot/report/safe_text.h"

#include <cmath>

namespace dashpot {

std::string escape_html(std::string_view text) {
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

std::string script_json(const Value& value) {
  // In JSON a '<' can only stand inside a string, where \u003c means the same.
  std::string result;
  for (const char c : format_json(value, false)) {
    if (c == '<')
      result += "\\u003c";
    else
      result += c;
  }
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

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + markdown_cell(cell) + " |";
  return row + "\n";
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

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

}  // namespace

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
