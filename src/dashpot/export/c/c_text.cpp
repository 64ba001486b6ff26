#include "dashpot/export/c/c_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <limits>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Where the number that begins at `at` ends: 1, 0.5, 1e-9.
std::size_t end_of_number(std::string_view code, std::size_t at) {
  const auto goes_on = [&](std::size_t k) {
    return is_word(code[k]) || code[k] == '.' ||
           ((code[k] == '-' || code[k] == '+') && std::tolower(code[k - 1]) == 'e');
  };
  while (at < code.size() && goes_on(at)) ++at;
  return at;
}

std::size_t end_of_word(std::string_view code, std::size_t at) {
  while (at < code.size() && is_word(code[at])) ++at;
  return at;
}

std::size_t end_of_comment(std::string_view code, std::size_t at) {
  const std::size_t end = code.find("*/", at + 2);
  return end == std::string_view::npos ? code.size() : end + 2;
}

/// What becomes of names and numbers; quotes and the rest stay.
struct Rewriting {
  std::function<std::string(std::string_view)> word, number;
  bool comments = false;  ///< also there
};

std::string rewritten(std::string_view code, const Rewriting& rewriting) {
  std::string out;
  for (std::size_t at = 0; at < code.size();) {
    std::size_t end = at + 1;
    if (!rewriting.comments && code.substr(at, 2) == "/*") {
      out += code.substr(at, (end = end_of_comment(code, at)) - at);
    } else if (code[at] == '"') {
      end = std::min(code.find('"', at + 1), code.size() - 1) + 1;
      out += code.substr(at, end - at);
    } else if (is_digit(code[at])) {
      out += rewriting.number(code.substr(at, (end = end_of_number(code, at)) - at));
    } else if (is_word(code[at])) {
      out += rewriting.word(code.substr(at, (end = end_of_word(code, at)) - at));
    } else {
      out += code[at];
    }
    at = end;
  }
  return out;
}

std::string single_word(std::string_view word) {
  static constexpr std::array kFunctions{
      "acos",     "acosh", "asin",  "asinh", "atan",  "atan2", "atanh", "cbrt",  "ceil",
      "copysign", "cos",   "cosh",  "exp",   "exp2",  "expm1", "fabs",  "floor", "fmax",
      "fmin",     "fmod",  "hypot", "log",   "log10", "log1p", "log2",  "pow",   "round",
      "sin",      "sinh",  "sqrt",  "tan",   "tanh",  "trunc"};
  if (word == "double") return "float";
  return std::string(word) + (std::ranges::find(kFunctions, word) != kFunctions.end() ? "f" : "");
}

/// Where it is too small for a float, the smallest normal one.
std::string single_number(std::string_view number) {
  if (number.find_first_of(".e") == std::string_view::npos) return std::string(number);
  const double value =
      parse_number(number.ends_with('.') ? number.substr(0, number.size() - 1) : number).value();
  if (value > std::numeric_limits<float>::max())
    throw Error("single precision", "cannot hold " + std::string(number),
                "export in double precision");
  if (value > 0 && value < std::numeric_limits<float>::min()) return "1.17549435e-38F";
  return std::string(number) + "F";
}

/// With what iterations stop at, `<= 1e-8`, as near as floats come: their next step would move by
/// its square.
std::string with_single_tolerances(std::string code) {
  constexpr std::string_view kStop = "<= 1e-";
  for (std::size_t at = 0; (at = code.find(kStop, at)) != std::string::npos; ++at) {
    const std::size_t number = at + 3, end = end_of_number(code, number);
    if (parse_number(std::string_view(code).substr(number, end - number)).value_or(1) < 1e-6)
      code.replace(number, end - number, "1e-5");
  }
  return code;
}

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

std::string in_precision(std::string_view code, CPrecision precision) {
  if (precision == CPrecision::Double) return std::string(code);
  return rewritten(with_single_tolerances(std::string(code)), {single_word, single_number});
}

std::string with_prefix(std::string_view code, std::string_view prefix) {
  std::string upper(prefix);
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const auto word = [&](std::string_view name) {
    if (name.starts_with("damper_")) return std::string(prefix) + std::string(name.substr(6));
    if (name.starts_with("DAMPER_")) return upper + std::string(name.substr(6));
    return std::string(name);
  };
  return rewritten(code, {word, [](std::string_view number) { return std::string(number); }, true});
}

void require_free_names(const std::string& prefix, const std::string& code) {
  for (const char* part : {"input", "model", "init", "reset", "step", "advance", "rest", "move",
                           "force", "derivatives"}) {
    const std::string word = prefix + '_' + part;
    for (std::size_t at = 0; (at = code.find(word, at)) != std::string::npos; ++at)
      if ((at == 0 || !is_word(code[at - 1])) && !is_word(code[at + word.size()]))
        throw Error("name", "'" + prefix + "' begins names that the code has inside",
                    "say '" + prefix + "_damper'");
  }
}

std::string_view c_deviations() {
  // What cppcheck's MISRA add-on says; a test holds the list complete.
  return R"(2.2, 2.5 (a product with a size that is 1; a macro for who calls);
 * 8.7, 8.9 (interface and tables of numbers stand at file scope); 10.3, 10.4,
 * 10.6, 12.1 (equations mix reals with whole numbers, and have no more brackets than in print); 11.8 (a const pointer
 * in a const struct, which the add-on takes for a cast); 12.3 (several variables in one declaration); 15.5, 15.6, 17.8
 * (in laws: early returns, single statements without braces, arguments that change).)";
}

std::string in_comment(std::string text) {
  for (std::size_t at = 0; (at = text.find("*/", at)) != std::string::npos;)
    text.insert(at + 1, " ");
  return text;
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
