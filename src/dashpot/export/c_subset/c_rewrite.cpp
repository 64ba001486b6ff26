#include "dashpot/export/c_subset/c_rewrite.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <set>
#include <vector>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/export/c_subset/c_tokens.h"

namespace dashpot {
namespace {

using Kind = CToken::Kind;

constexpr std::string_view kSingleMark = "/* single precision: ";

/// The functions of math.h that have a form for float with an f behind their name.
constexpr std::array<std::string_view, 32> kMathFunctions{
    "acos",  "acosh", "asin", "asinh", "atan",  "atan2", "atanh", "cbrt", "ceil", "copysign", "cos",
    "cosh",  "exp",   "exp2", "expm1", "fabs",  "floor", "fmax",  "fmin", "fmod", "hypot",    "log",
    "log10", "log1p", "log2", "pow",   "round", "sin",   "sinh",  "sqrt", "tan",  "trunc"};

constexpr std::string_view kMathInclude = "#include <math.h>\n";
/// tanh in single precision within 4e-7: on a Cortex-M4F some 60 instructions fewer than newlib's,
/// and networks spend their time in it. The coefficients make the largest
/// relative error of x P(x^2) / Q(x^2) least up to where a float's tanh is 1.
constexpr std::string_view kSingleTanh = R"(
/* tanh, within 4e-7: x P(x^2) / Q(x^2), on a small processor quicker than newlib's. */
static inline float tanh_single(float x) {
  const float most = 9.02F;
  const float y = (x > most) ? most : ((x < -most) ? -most : x), z = y * y;
  const float p =
      0.99999998F +
      (z * (0.133797183F + (z * (3.49403491e-3F + (z * (2.05834856e-5F + (z * 1.3319076e-8F)))))));
  const float q =
      1.0F +
      (z * (0.467130335F + (z * (2.58710747e-2F + (z * (3.28309334e-4F + (z * 7.76202148e-7F)))))));
  const float t = y * (p / q);
  return (t > 1.0F) ? 1.0F : ((t < -1.0F) ? -1.0F : t);
}
)";

std::string single_word(std::string_view word) {
  if (word == "double") return "float";
  if (word == "tanh") return "tanh_single";
  const bool is_function = std::ranges::find(kMathFunctions, word) != kMathFunctions.end();
  return std::string(word) + (is_function ? "f" : "");
}

std::string single_number(std::string_view number) {
  // A whole number is an int, in either precision.
  if (number.find_first_of(".e") == std::string_view::npos) return std::string(number);

  const double value =
      parse_number(number.ends_with('.') ? number.substr(0, number.size() - 1) : number).value();
  if (value > std::numeric_limits<float>::max())
    throw Error("single precision", "cannot hold " + std::string(number),
                "export in double precision");
  if (value > 0 && value < std::numeric_limits<float>::min()) return "1.17549435e-38F";
  return std::string(number) + "F";
}

[[noreturn]] void refuse_mark(const CToken& mark, const std::string& what) {
  throw Error("C text:" + std::to_string(mark.line), what,
              "const double name = 1e-9; " + std::string(kSingleMark) + "1e-5 */");
}

/// The place of the number that the mark at `mark` speaks of: in front of it but for blanks and one
/// semicolon.
std::size_t marked_number(const std::vector<CToken>& tokens, std::size_t mark) {
  std::size_t at = mark;
  const auto skip_space = [&] {
    while (at > 0 && tokens[at - 1].kind == Kind::Space) --at;
  };
  skip_space();
  if (at > 0 && tokens[at - 1].is(";")) --at;
  skip_space();
  if (at == 0 || tokens[at - 1].kind != Kind::Number)
    refuse_mark(tokens[mark], "has a mark behind no number");
  return at - 1;
}

/// The number that a mark gives.
std::string_view number_of_mark(const CToken& mark) {
  const std::string_view number =
      mark.text.substr(kSingleMark.size(), mark.text.size() - kSingleMark.size() - 3);
  if (!parse_number(number))
    refuse_mark(mark, "marks no number for single precision but '" + std::string(number) + "'");
  return number;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string out;
  for (const std::string& part : parts) out += part;
  return out;
}

std::string in_single(const std::vector<CToken>& tokens) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < tokens.size(); ++k) {
    const CToken& token = tokens[k];
    out.emplace_back(token.text);
    if (token.kind == Kind::Word) out[k] = single_word(token.text);
    if (token.kind == Kind::Number) out[k] = single_number(token.text);
    if (token.kind != Kind::Comment || !token.text.starts_with(kSingleMark)) continue;

    // Exchange the number and its mark: the text then says what it was in double precision.
    const std::size_t number = marked_number(tokens, k);
    out[number] = single_number(number_of_mark(token));
    out[k] = "/* double precision: " + std::string(tokens[number].text) + " */";
  }
  return joined(out);
}

/// Code in single precision with the tanh that it calls, behind what that stands in for.
std::string with_single_tanh(std::string code) {
  const std::size_t include = code.find(kMathInclude);
  if (include != std::string::npos && code.find("tanh_single(") != std::string::npos)
    code.insert(include + kMathInclude.size(), kSingleTanh);
  return code;
}

/// `comment` with its words, which are no tokens, replaced.
template <class Replace>
std::string with_words(std::string_view comment, Replace&& replaced) {
  std::string out;
  for (std::size_t at = 0; at < comment.size();) {
    std::size_t end = at;
    while (end < comment.size() && is_word(comment[end])) ++end;
    out += end > at ? replaced(comment.substr(at, end - at)) : std::string(1, comment[at]);
    at = std::max(end, at + 1);
  }
  return out;
}

/// The names that stand, outside of all brackets, before what ends a declarator or opens a body,
/// those behind #define, and those within the braces of an enumeration.
std::set<std::string_view> defined_names(std::vector<CToken> tokens) {
  std::erase_if(tokens,
                [](const CToken& t) { return t.kind == Kind::Space || t.kind == Kind::Comment; });

  std::set<std::string_view> names;
  int depth = 0;
  bool enumerates = false;
  for (std::size_t k = 0; k + 1 < tokens.size(); ++k) {
    const CToken& token = tokens[k];
    const CToken& next = tokens[k + 1];
    if (token.in_directive) {
      if (token.is("define")) names.insert(next.text);
      continue;
    }

    // Within how many brackets it stands, and whether in those of an enumeration.
    if (token.is("enum")) enumerates = true;
    if (token.is("{") || token.is("(") || token.is("[")) ++depth;
    if (token.is("}") || token.is(")") || token.is("]")) --depth;
    if (token.is("}")) enumerates = false;

    // A name of its own.
    if (token.kind != Kind::Word) continue;
    const bool ends = next.is("(") || next.is("[") || next.is("=") || next.is(";") || next.is("{");
    if ((depth == 0 && ends) || (depth == 1 && enumerates)) names.insert(token.text);
  }
  return names;
}

}  // namespace

std::string in_precision(std::string_view code, CPrecision precision) {
  return precision == CPrecision::Double ? std::string(code)
                                         : with_single_tanh(in_single(c_tokens(code)));
}

std::string with_prefix(std::string_view code, std::string_view prefix) {
  std::string upper(prefix);
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const auto renamed = [&](std::string_view name) {
    if (name.starts_with("damper_")) return std::string(prefix) + std::string(name.substr(6));
    if (name.starts_with("DAMPER_")) return upper + std::string(name.substr(6));
    return std::string(name);
  };

  std::string out;
  for (const CToken& token : c_tokens(code)) {
    const bool is_comment = token.kind == Kind::Comment;
    out += is_comment                 ? with_words(token.text, renamed)
           : token.kind == Kind::Word ? renamed(token.text)
                                      : std::string(token.text);
  }
  return out;
}

std::string with_own_names(std::string_view code, std::string_view before) {
  const std::set<std::string_view> own = defined_names(c_tokens(code));
  std::string out;
  for (const CToken& token : c_tokens(code)) {
    if (token.kind == Kind::Word && own.contains(token.text)) out += before;
    out += token.text;
  }
  return out;
}

void require_free_names(const std::string& prefix, std::string_view code) {
  constexpr std::array<std::string_view, 10> kParts{
      "input", "model", "init", "reset", "step", "advance", "rest", "move", "force", "derivatives"};
  for (const CToken& token : c_tokens(code)) {
    if (token.kind != Kind::Word || !token.text.starts_with(prefix + '_')) continue;
    const std::string_view part = token.text.substr(prefix.size() + 1);
    if (std::ranges::find(kParts, part) != kParts.end())
      throw Error("name", "'" + prefix + "' begins names that the code has inside",
                  "say '" + prefix + "_damper'");
  }
}

}  // namespace dashpot
