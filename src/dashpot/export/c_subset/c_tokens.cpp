#include "dashpot/export/c_subset/c_tokens.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "dashpot/error.h"

namespace dashpot {
namespace {

using Kind = CToken::Kind;

/// The marks of more than one character, the longest first.
constexpr std::array<std::string_view, 22> kLongMarks{
    "<<=", ">>=", "...", "->", "++", "--", "+=", "-=", "*=", "/=", "%=",
    "&=",  "|=",  "^=",  "<=", ">=", "==", "!=", "&&", "||", "<<", ">>"};
constexpr std::string_view kMarks = "+-*/%<>=!&|^~?:;,.()[]{}#\\";

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

class Scanner {
 public:
  explicit Scanner(std::string_view code) : code_(code) {}

  std::vector<CToken> all() {
    while (at_ < code_.size()) scan();
    tokens_.push_back({.line = line_});
    return std::move(tokens_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& right) const {
    throw Error("C text:" + std::to_string(line_), what, right);
  }

  /// The character `ahead` of the place where the scanner is; 0 behind the end.
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < code_.size() ? code_[at_ + ahead] : '\0';
  }

  void scan() {
    const char first = peek();
    if (is_space(first)) return space();
    if (first == '/' && peek(1) == '*') return comment();
    if (first == '"' || first == '\'') return quoted(first);
    if (is_digit(first)) return number();
    if (is_word(first)) return word();
    mark();
  }

  /// A run of blanks; in a directive it stops before the line's end, which ends the directive.
  void space() {
    std::size_t size = 0;
    for (; is_space(peek(size)); ++size) {
      if (peek(size) != '\n') continue;
      if (in_directive_ && size > 0) break;
      in_directive_ = in_directive_ && continues();
    }
    add(Kind::Space, size);
  }

  /// Whether a backslash joins the line that ends here to the next one.
  bool continues() const { return !tokens_.empty() && tokens_.back().text == "\\"; }

  void comment() {
    const std::size_t end = code_.find("*/", at_ + 2);
    if (end == std::string_view::npos) fail("has a comment that does not end", "*/");
    add(Kind::Comment, end + 2 - at_);
  }

  void quoted(char quote) {
    std::size_t size = 1;
    for (; peek(size) != quote; size += peek(size) == '\\' ? 2 : 1)
      if (peek(size) == '\n' || peek(size) == '\0')
        fail("has a string that does not end on its line", std::string(1, quote));
    add(Kind::Quoted, size + 1);
  }

  void number() {
    const auto is_exponent_sign = [&](std::size_t k) {
      return (peek(k) == '-' || peek(k) == '+') && std::tolower(peek(k - 1)) == 'e';
    };
    std::size_t size = 1;
    while (is_word(peek(size)) || peek(size) == '.' || is_exponent_sign(size)) ++size;
    add(Kind::Number, size);
  }

  void word() {
    std::size_t size = 1;
    while (is_word(peek(size))) ++size;
    add(Kind::Word, size);
  }

  void mark() {
    if (peek() == '/' && peek(1) == '/') fail("has a comment of C++", "/* ... */");
    if (peek() == '.' && is_digit(peek(1))) fail("has a number that begins with a point", "0.5");
    if (kMarks.find(peek()) == std::string_view::npos)
      fail("has '" + std::string(1, peek()) + "'", "characters that C has");

    if (peek() == '#' && begins_line()) in_directive_ = true;
    const auto found = std::ranges::find_if(
        kLongMarks, [&](std::string_view mark) { return code_.substr(at_).starts_with(mark); });
    add(Kind::Mark, found == kLongMarks.end() ? 1 : found->size());
  }

  bool begins_line() const {
    const std::size_t line_end = code_.substr(0, at_).rfind('\n');
    const std::size_t begin = line_end == std::string_view::npos ? 0 : line_end + 1;
    return std::ranges::all_of(code_.substr(begin, at_ - begin), is_space);
  }

  void add(Kind kind, std::size_t size) {
    const std::string_view text = code_.substr(at_, size);
    tokens_.push_back({kind, text, line_, in_directive_});
    line_ += static_cast<std::size_t>(std::ranges::count(text, '\n'));
    at_ += size;
  }

  std::string_view code_;
  std::size_t at_ = 0, line_ = 1;
  bool in_directive_ = false;
  std::vector<CToken> tokens_;
};

}  // namespace

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::vector<CToken> c_tokens(std::string_view code) { return Scanner(code).all(); }

bool has_c(std::string_view code, std::string_view piece) {
  const auto texts = [](std::string_view of) {
    std::vector<std::string_view> out;
    for (const CToken& token : c_tokens(of))
      if (token.kind != Kind::Space && token.kind != Kind::Comment && token.kind != Kind::End)
        out.push_back(token.text);
    return out;
  };
  const auto all = texts(code), wanted = texts(piece);
  return !std::ranges::search(all, wanted).empty();
}

}  // namespace dashpot
