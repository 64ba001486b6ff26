#include "dashpot/export/c/c_text.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// What keeps a header from being read twice.
bool is_guard(const std::string& line) {
  return line.starts_with("#ifndef DASHPOT_") || line.starts_with("#endif") ||
         (line.starts_with("#define DASHPOT_") && line.ends_with("_H"));
}

/// A text without what only the library needs: guards, what it includes in <>, and, in its first
/// comment, where it is taken in and what must be declared before.
std::string shipped(std::string_view text) {
  std::string out;
  for (const std::string& line : split(text, '\n'))
    if (!line.starts_with("#include <") && !is_guard(line)) out += line + '\n';
  out = trim(out);
  if (!out.starts_with("/*")) return out + '\n';

  // In the first comment: from ", as C99 text ..." or "Declared before: ..." to its paragraph's
  // end.
  const std::size_t end = std::min(out.find("*/"), out.find("\n *\n"));
  std::size_t from = std::min(out.find(", as C99"), out.find(" Declared before:"));
  if (from < end) {
    if (out[from - 1] == '*' || out[from - 1] == '.') --from;  // it began a line, or a sentence
    while (out[from - 1] == ' ' || out[from - 1] == '\n') --from;
    out.replace(from, end - from, out.compare(end, 2, "*/") == 0 ? ". " : ".");
  }
  return out + '\n';
}

void expand(std::string_view code, std::vector<std::string>& done, std::string& out) {
  for (const std::string& line : split(code, '\n')) {
    if (!line.starts_with("#include \"")) {
      out += line + '\n';
      continue;
    }
    const std::string path = line.substr(10, line.size() - 11),
                      name = path.substr(path.rfind('/') + 1);
    if (std::ranges::find(done, name) != done.end()) continue;
    done.push_back(name);
    expand(shipped(c_text(name)), done, out);
  }
}

}  // namespace

bool has_c_text(std::string_view name) {
  return std::ranges::any_of(c_texts(), [&](const auto& text) { return text.first == name; });
}

std::string_view c_text(std::string_view name) {
  for (const auto& [known, text] : c_texts())
    if (known == name) return text;
  throw Error(std::string(name), "is no C text of Dashpot");
}

std::string with_texts(std::string_view code) {
  std::vector<std::string> done;
  std::string out;
  expand(code, done, out);
  for (std::size_t at = 0; (at = out.find("\n\n\n", at)) != std::string::npos;) out.erase(at, 1);
  return out;
}

std::string_view c_deviations() {
  // The findings of cppcheck's MISRA add-on; a test holds the list complete.
  return R"(2.2, 2.5 (a product with a size that is 1; a macro for who calls);
 * 8.7, 8.9 (interface and tables of numbers stand at file scope); 10.3, 10.4,
 * 10.6, 12.1 (equations mix reals with whole numbers, and have no more brackets than in
 * print); 11.8 (a const pointer in a const struct, which the add-on takes for a cast); 12.3
 * (several variables in one declaration); 15.5, 15.6,
 * 17.8 (in laws: early returns, single statements without braces, arguments that change).)";
}

std::string c_number(double value) {
  const std::string text = format_exact(value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string c_numbers(std::span<const double> values) {
  constexpr std::size_t kWidth = 100;
  std::string out = "{", line;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::string number = c_number(values[k]) + (k + 1 < values.size() ? "," : "");
    if (line.size() + number.size() > kWidth) {
      out += line + "\n ";
      line.clear();
    }
    line += (line.empty() && out.size() == 1 ? "" : " ") + number;
  }
  return out + line + "}";
}

std::string pascal_case(std::string_view name) {
  std::string out;
  for (const std::string& part : split(name, '_')) {
    std::string word = part;
    if (!word.empty())
      word[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
    out += word;
  }
  return out;
}

}  // namespace dashpot
