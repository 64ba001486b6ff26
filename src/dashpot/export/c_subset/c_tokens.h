#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace dashpot::trace {

struct CToken {
  enum class Kind { Word, Number, Mark, End };
  Kind kind = Kind::End;
  std::string text;
};

/// Tokens of C code without comments; a macro that stands for a number is replaced, other
/// directives are left out.
std::vector<CToken> c_tokens(std::string_view code);

}  // namespace dashpot::trace
