#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

namespace dashpot {

/// A piece of C code. The pieces of a text, one after the other, are that text byte for byte, so
/// that whoever rewrites some of them leaves the rest as it was.
struct CToken {
  enum class Kind {
    Space,    ///< blanks and line ends
    Comment,  ///< with its delimiters
    Word,     ///< a name or a keyword
    Number,   ///< 2, 0.5, 1e-9, 0.5F
    Quoted,   ///< a string or a character, with its quotes
    Mark,     ///< an operator or punctuation: ->, +=, {
    End       ///< stands behind the last piece, empty
  };
  Kind kind = Kind::End;
  std::string_view text;
  std::size_t line = 1;       ///< on which it begins, from 1
  bool in_directive = false;  ///< it stands in a line that begins with #

  bool is(std::string_view other) const { return kind != Kind::End && text == other; }
};

/// Whether `c` may stand in a name.
bool is_word(char c);

/// All of the code, which must outlive the tokens, and an End. Takes every C text of Dashpot, those
/// that are no part of the subset (docs/c-subset.md) included. Throws Error, with the line, at a
/// comment or string that does not end and at a character that C does not have.
std::vector<CToken> c_tokens(std::string_view code);

/// Whether the tokens of `piece` ("s->force") stand one behind the other in the code, blanks and
/// comments aside.
bool has_c(std::string_view code, std::string_view piece);

}  // namespace dashpot
