#include "dashpot/export/c_subset/c_tokens.h"

#include <algorithm>

#include "dashpot/export/c/c_text.h"
#include "support.h"

using namespace dashpot;
using Kind = CToken::Kind;

namespace {

std::string joined(const std::vector<CToken>& tokens) {
  std::string out;
  for (const CToken& token : tokens) out += token.text;
  return out;
}

}  // namespace

TEST_CASE("C tokens: the tokens of every C text, put together again, are the text byte for byte") {
  for (const auto& [name, text] : c_texts()) {
    CAPTURE(name);
    const std::vector<CToken> tokens = c_tokens(text);
    CHECK(joined(tokens) == text);
    CHECK(tokens.back().kind == Kind::End);
    CHECK(tokens.back().line == 1 + static_cast<std::size_t>(std::ranges::count(text, '\n')));
  }
  for (const char* code : {"", "a", "x", " \t\r\n", "#define A 1", "#define A \\\n  1\n#endif\n\n"})
    CHECK(joined(c_tokens(code)) == code);
}

TEST_CASE("C tokens: kinds, lines and directives") {
  const auto tokens = c_tokens("#define N 2 /* a\nb */\nx->y += 1e-9F; \"a\\\"b\"");
  std::vector<std::string> seen;
  for (const CToken& token : tokens)
    if (token.kind != Kind::Space)
      seen.push_back(std::to_string(token.line) + (token.in_directive ? "#" : " ") +
                     std::to_string(static_cast<int>(token.kind)) + " " + std::string(token.text));
  CHECK(seen == std::vector<std::string>{"1#5 #", "1#2 define", "1#2 N", "1#3 2", "1#1 /* a\nb */",
                                         "3 2 x", "3 5 ->", "3 2 y", "3 5 +=", "3 3 1e-9F", "3 5 ;",
                                         "3 4 \"a\\\"b\"", "3 6 "});
  CHECK(c_tokens("a<<=b")[1].text == "<<=");
}

TEST_CASE("C tokens: whether a piece of C stands in a text") {
  const std::string code = "a = s -> /* N */ force + t->force_max; /* s->speed */";
  CHECK(has_c(code, "s->force"));
  CHECK(has_c(code, "t"));
  CHECK_FALSE(has_c(code, "t->force"));
  CHECK_FALSE(has_c(code, "s->speed"));
}

TEST_CASE("C tokens: what C does not have is refused with its line and what would be right") {
  const auto refused = [](const char* code) { return message_of([&] { c_tokens(code); }); };
  CHECK(refused("int a;\n/* no end") == "C text:2: has a comment that does not end; */");
  CHECK(refused("a = \"no end\n\";") == "C text:1: has a string that does not end on its line; \"");
  CHECK(refused("int a; // b") == "C text:1: has a comment of C++; /* ... */");
  CHECK(refused("\n\nx = .5;") == "C text:3: has a number that begins with a point; 0.5");
  CHECK(refused("x = a @ b;") == "C text:1: has '@'; characters that C has");
}
