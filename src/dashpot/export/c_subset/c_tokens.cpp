#include "dashpot/export/c_subset/c_tokens.h"

#include <array>
#include <cctype>
#include <map>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot::trace {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string without_comments(std::string_view code) {
  std::string out;
  for (std::size_t at = 0; at < code.size();) {
    const std::size_t begin = code.find("/*", at),
                      end = code.find("*/", begin == code.npos ? begin : begin + 2);
    out += code.substr(at, begin == code.npos ? code.npos : begin - at);
    if (begin == code.npos || end == code.npos) break;
    out += ' ';
    at = end + 2;
  }
  return out;
}

class Scanner {
 public:
  std::vector<CToken> all(const std::string& code) {
    bool is_foreign = false;
    for (const std::string& line : split(code, '\n')) {
      if (line.starts_with("#ifdef ")) is_foreign = true;  // of C++
      if (line.starts_with("#endif")) is_foreign = false;
      if (is_foreign) continue;
      if (line.starts_with("#define ")) define(line.substr(8));
      if (!line.starts_with("#")) scan(line, tokens_);
    }
    tokens_.push_back({});
    return std::move(tokens_);
  }

 private:
  void define(const std::string& line) {
    const std::size_t end = line.find(' ');
    if (end != std::string::npos) scan(line.substr(end), macros_[line.substr(0, end)]);
  }

  void scan(std::string_view line, std::vector<CToken>& out) {
    for (std::size_t at = 0; at < line.size();) {
      std::size_t end = at + 1;
      if (std::isspace(static_cast<unsigned char>(line[at]))) {
      } else if (is_digit(line[at])) {
        while (end < line.size() &&
               (is_word(line[end]) || line[end] == '.' || is_exponent_sign(line, end)))
          ++end;
        out.push_back({CToken::Kind::Number, std::string(line.substr(at, end - at))});
      } else if (is_word(line[at])) {
        while (end < line.size() && is_word(line[end])) ++end;
        word(std::string(line.substr(at, end - at)), out);
      } else {
        end = at + mark_size(line.substr(at));
        out.push_back({CToken::Kind::Mark, std::string(line.substr(at, end - at))});
      }
      at = end;
    }
  }

  static bool is_exponent_sign(std::string_view line, std::size_t at) {
    return (line[at] == '-' || line[at] == '+') && (line[at - 1] == 'e' || line[at - 1] == 'E');
  }

  static std::size_t mark_size(std::string_view rest) {
    static constexpr std::array<std::string_view, 13> kLong{
        "->", "++", "--", "+=", "-=", "*=", "/=", "<=", ">=", "==", "!=", "&&", "||"};
    for (const std::string_view mark : kLong)
      if (rest.starts_with(mark)) return 2;
    return 1;
  }

  void word(std::string name, std::vector<CToken>& out) const {
    const auto macro = macros_.find(name);
    if (macro == macros_.end())
      out.push_back({CToken::Kind::Word, std::move(name)});
    else
      out.insert(out.end(), macro->second.begin(), macro->second.end());
  }

  std::vector<CToken> tokens_;
  std::map<std::string, std::vector<CToken>> macros_;
};

}  // namespace

std::vector<CToken> c_tokens(std::string_view code) {
  return Scanner().all(without_comments(code));
}

}  // namespace dashpot::trace
