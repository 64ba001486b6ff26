#include "dashpot/export/c_subset/c_directives.h"

#include <algorithm>
#include <map>
#include <string>

#include "dashpot/error.h"

namespace dashpot {
namespace {

using Kind = CToken::Kind;
using Tokens = std::span<const CToken>;

bool is_blank(const CToken& token) {
  return token.kind == Kind::Space || token.kind == Kind::Comment || token.text == "\\";
}

class Preprocessor {
 public:
  std::vector<CToken> all(Tokens tokens) {
    for (std::size_t at = 0; at < tokens.size();) {
      // The tokens of a directive stand together.
      if (tokens[at].in_directive) {
        const auto begin = tokens.begin() + static_cast<std::ptrdiff_t>(at);
        const auto end = std::find_if(begin, tokens.end(),
                                      [](const CToken& token) { return !token.in_directive; });
        directive({begin, end});
        at += static_cast<std::size_t>(end - begin);
      } else {
        if (is_kept() && !is_blank(tokens[at])) append(tokens[at], out_);
        ++at;
      }
    }
    if (!conditions_.empty()) fail(tokens.back(), "ends within #ifdef or #ifndef", "#endif");
    return std::move(out_);
  }

 private:
  [[noreturn]] static void fail(const CToken& at, const std::string& what,
                                const std::string& right) {
    throw Error("C text:" + std::to_string(at.line), what, right);
  }

  bool is_kept() const {
    return std::ranges::all_of(conditions_, [](bool condition) { return condition; });
  }

  void append(const CToken& token, std::vector<CToken>& to) const {
    const auto macro = macros_.find(token.text);
    if (token.kind != Kind::Word || macro == macros_.end()) return to.push_back(token);
    for (CToken part : macro->second) {
      part.line = token.line;
      to.push_back(part);
    }
  }

  /// `line`: the tokens of one directive, of which the first is #.
  void directive(Tokens line) {
    const auto next_word = [&] {
      line = line.subspan(1);
      while (!line.empty() && is_blank(line.front())) line = line.subspan(1);
      return line.empty() ? CToken{.kind = Kind::Mark} : line.front();
    };
    const CToken hash = line.front(), name = next_word();

    // Conditions are counted even inside of what is left out, so that each #endif finds its own.
    if (name.is("ifdef")) return conditions_.push_back(macros_.contains(next_word().text));
    if (name.is("ifndef")) return conditions_.push_back(!macros_.contains(next_word().text));
    if (name.is("endif") && !conditions_.empty()) return conditions_.pop_back();

    if (!is_kept() || name.is("include")) return;
    if (!name.is("define"))
      fail(hash, "has the directive '#" + std::string(name.text) + "'",
           "#include, #define NAME VALUE, #ifdef, #ifndef or #endif");
    const CToken defined = next_word();
    define(defined, line.subspan(std::min<std::size_t>(1, line.size())));
  }

  void define(const CToken& name, Tokens value) {
    if (name.kind != Kind::Word) fail(name, "has a #define without a name", "#define NAME VALUE");
    if (!value.empty() && value.front().is("("))
      fail(name, "has the macro '" + std::string(name.text) + "' with arguments", "a function");
    std::vector<CToken>& meaning = macros_[name.text];
    for (const CToken& token : value)
      if (!is_blank(token)) append(token, meaning);
  }

  std::map<std::string_view, std::vector<CToken>> macros_;
  std::vector<bool> conditions_;  ///< of the #ifdef and #ifndef that are open
  std::vector<CToken> out_;
};

}  // namespace

std::vector<CToken> c_preprocessed(std::span<const CToken> tokens) {
  return Preprocessor().all(tokens);
}

}  // namespace dashpot
