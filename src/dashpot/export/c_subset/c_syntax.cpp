#include "dashpot/export/c_subset/c_syntax.h"

#include <algorithm>
#include <array>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/export/c_subset/c_directives.h"
#include "dashpot/export/c_subset/c_tokens.h"

namespace dashpot {
namespace {

using TokenKind = CToken::Kind;

/// The binary operators, from those that bind least to those that bind most.
const std::array<std::vector<std::string_view>, 6> kBinary{
    {{"||"}, {"&&"}, {"==", "!="}, {"<", ">", "<=", ">="}, {"+", "-"}, {"*", "/", "%"}}};

/// A keyword of C that the subset does without, and what to write.
struct Outside {
  std::string_view word, instead;
};
constexpr std::array<Outside, 18> kOutside{{{"do", "while"},
                                            {"switch", "if ... else if"},
                                            {"case", "if ... else if"},
                                            {"goto", "break or return"},
                                            {"continue", "if"},
                                            {"union", "struct"},
                                            {"sizeof", "a constant"},
                                            {"char", "int or double"},
                                            {"short", "int"},
                                            {"long", "int or double"},
                                            {"signed", "int"},
                                            {"unsigned", "int"},
                                            {"_Bool", "int"},
                                            {"extern", "static, or neither"},
                                            {"register", "neither"},
                                            {"auto", "a type"},
                                            {"volatile", "const, or neither"},
                                            {"restrict", "neither"}}};

std::vector<CToken> code_tokens(std::string_view code) {
  std::vector<CToken> tokens = c_preprocessed(c_tokens(code));
  for (const CToken& token : tokens)
    if (const auto outside = std::ranges::find(kOutside, token.text, &Outside::word);
        token.kind == TokenKind::Word && outside != kOutside.end())
      throw Error("C text:" + std::to_string(token.line),
                  "has '" + std::string(token.text) + "', which is outside of the subset of C",
                  std::string(outside->instead));
  return tokens;
}

/// Reads by recursive descent: a function for each rule of the grammar in docs/c-subset.md.
class Parser {
 public:
  explicit Parser(std::string_view code) : tokens_(code_tokens(code)) {}

  CProgram program() {
    while (here().kind != TokenKind::End) top_level();
    return std::move(program_);
  }

 private:
  // Tokens.

  const CToken& here() const { return tokens_[at_]; }
  bool is(std::string_view text) const { return here().is(text); }
  bool take(std::string_view text) {
    if (!is(text)) return false;
    ++at_;
    return true;
  }
  void need(std::string_view text) {
    if (!take(text)) fail("'" + std::string(text) + "'");
  }
  std::string word() {
    if (here().kind != TokenKind::Word) fail("a name");
    return std::string(tokens_[at_++].text);
  }
  [[noreturn]] void fail(const std::string& wanted) const {
    const auto quoted = [](const CToken& token) {
      return token.kind == TokenKind::End ? "its end" : "'" + std::string(token.text) + "'";
    };
    throw Error("C text:" + std::to_string(here().line),
                "has " + quoted(here()) + (at_ > 0 ? " behind " + quoted(tokens_[at_ - 1]) : ""),
                wanted + " is expected there");
  }

  // Types and declarations.

  bool is_type() const {
    static constexpr std::array<std::string_view, 8> kWords{"const", "static", "inline", "void",
                                                            "int",   "double", "float",  "struct"};
    return here().kind == TokenKind::Word &&
           (std::ranges::find(kWords, here().text) != kWords.end() || types_.contains(here().text));
  }

  CType base_type() {
    CType type;
    bool is_known = false;
    for (; is_type(); ++at_) {
      const std::string_view name = here().text;
      const bool qualifies =
          name == "const" || name == "static" || name == "inline" || name == "struct";
      if (qualifies) continue;

      // The type itself, once.
      if (is_known) fail("a name");
      is_known = true;
      if (name == "int") type.kind = CType::Kind::Int;
      if (name == "double" || name == "float") type.kind = CType::Kind::Real;
      if (const auto known = types_.find(name); known != types_.end()) type = known->second;
    }
    if (!is_known) fail("a type");
    return type;
  }

  CType pointers(CType type) {
    while (is("*") || is("const"))
      if (tokens_[at_++].text == "*") ++type.pointers;
    return type;
  }

  CDeclaration declarator(const CType& base) {
    CDeclaration out{.type = pointers(base)};
    out.name = word();
    if (take("[")) {
      out.type.is_array = true;
      if (!is("]")) out.type.count = static_cast<std::size_t>(constant(expression()));
      need("]");
    }
    return out;
  }

  /// The value of an expression that gives the size of an array.
  double constant(const CExpr& expr) const {
    if (expr.kind == CExpr::Kind::Number) return expr.number;
    if (expr.kind != CExpr::Kind::Binary || (expr.text != "+" && expr.text != "*"))
      fail("a constant");
    const double a = constant(expr.parts[0]), b = constant(expr.parts[1]);
    return expr.text == "+" ? a + b : a * b;
  }

  CInitialiser initialiser() {
    CInitialiser out;
    if (!take("{")) {
      out.value.push_back(assignment());
      return out;
    }
    while (!take("}")) {
      out.list.push_back(initialiser());
      if (!is("}")) need(",");
    }
    return out;
  }

  /// All that one statement declares, up to its semicolon.
  std::vector<CDeclaration> declarations(const CType& base) {
    std::vector<CDeclaration> out;
    do {
      out.push_back(declarator(base));
      CDeclaration& one = out.back();
      if (take("=")) one.initialiser.push_back(initialiser());
      if (one.type.is_array && one.type.count == 0 && !one.initialiser.empty())
        one.type.count = one.initialiser[0].list.size();
    } while (take(","));
    need(";");
    return out;
  }

  /// Its names become constants, counted from 0.
  CType enumeration() {
    const CType type{.kind = CType::Kind::Int};
    word();
    need("{");
    for (double value = 0; !take("}"); ++value) {
      CExpr number{.number = value, .is_integer = true};
      program_.globals.push_back({word(), type, {{.value = {std::move(number)}}}});
      if (!is("}")) need(",");
    }
    return type;
  }

  CType structure() {
    CStruct out{.name = word()};
    need("{");
    while (!take("}"))
      for (CDeclaration& field : declarations(base_type())) out.fields.push_back(std::move(field));
    program_.structs.push_back(std::move(out));
    return {.kind = CType::Kind::Struct, .structure = program_.structs.size() - 1};
  }

  void type_definition() {
    const CType type = take("enum")     ? enumeration()
                       : take("struct") ? structure()
                                        : base_type_of_alias();
    types_[word()] = type;
    need(";");
  }

  CType base_type_of_alias() {
    const auto known = types_.find(word());
    if (known == types_.end()) fail("a type");
    return known->second;
  }

  void top_level() {
    if (take("typedef")) return type_definition();

    // Only the bracket behind its name tells a function from a variable: look ahead for it.
    const CType base = base_type();
    const std::size_t begin = at_;
    const CType result = pointers(base);
    const std::string name = word();
    if (!is("(")) {
      at_ = begin;
      for (CDeclaration& global : declarations(base)) program_.globals.push_back(std::move(global));
      return;
    }

    // A function: its parameters, then its body unless that comes later in the text.
    need("(");
    CFunction function{.result = result};
    while (!take(")")) {
      function.parameters.push_back(declarator(base_type()));
      if (!is(")")) need(",");
    }
    if (take(";")) return;
    if (!is("{")) fail("'{'");
    function.body.push_back(statement());
    program_.functions[name] = std::move(function);
  }

  // Statements.

  CStatement statement() {
    CStatement out;
    if (take("{")) {
      while (!take("}")) out.parts.push_back(statement());
      return out;
    }
    if (take(";")) return out;
    if (take("for")) return for_loop();

    // Statements with a condition in brackets, and statements of their own.
    if (const bool branches = is("if"); branches || is("while")) {
      ++at_;
      out.kind = branches ? CStatement::Kind::If : CStatement::Kind::Loop;
      out.exprs.push_back(in_brackets());
      out.parts.push_back(statement());
      if (branches && take("else")) out.parts.push_back(statement());
      return out;
    }

    if (is_type()) {
      out.kind = CStatement::Kind::Declaration;
      out.declarations = declarations(base_type());
      return out;
    }

    // Statements that end with a semicolon.
    if (take("break")) {
      out.kind = CStatement::Kind::Break;
    } else if (take("return")) {
      out.kind = CStatement::Kind::Return;
      if (!is(";")) out.exprs.push_back(expression());
    } else {
      out.kind = CStatement::Kind::Expression;
      out.exprs.push_back(expression());
    }
    need(";");
    return out;
  }

  CStatement for_loop() {
    CStatement out{.kind = CStatement::Kind::Loop};
    need("(");
    if (!is(";")) out.start.push_back(expression());
    need(";");
    out.exprs.push_back(expression());
    need(";");
    if (!is(")")) out.step.push_back(expression());
    need(")");
    out.parts.push_back(statement());
    return out;
  }

  // Expressions.

  CExpr in_brackets() {
    need("(");
    CExpr inside = expression();
    need(")");
    return inside;
  }

  static CExpr made(CExpr::Kind kind, std::string_view text, std::vector<CExpr> parts) {
    return {.kind = kind, .text = std::string(text), .parts = std::move(parts)};
  }

  CExpr expression() {
    CExpr left = assignment();
    while (take(",")) left = made(CExpr::Kind::Binary, ",", {std::move(left), assignment()});
    return left;
  }

  CExpr assignment() {
    CExpr left = conditional();
    for (const std::string_view mark : {"=", "+=", "-=", "*=", "/="})
      if (take(mark))
        return made(CExpr::Kind::Assign, mark.substr(0, mark.size() - 1), {left, assignment()});
    return left;
  }

  CExpr conditional() {
    CExpr condition = binary(0);
    if (!take("?")) return condition;
    CExpr yes = expression();
    need(":");
    return made(CExpr::Kind::Conditional, "?",
                {std::move(condition), std::move(yes), conditional()});
  }

  CExpr binary(std::size_t level) {
    if (level == kBinary.size()) return unary();
    CExpr left = binary(level + 1);
    for (;;) {
      const auto mark =
          std::ranges::find_if(kBinary[level], [&](std::string_view m) { return is(m); });
      if (mark == kBinary[level].end()) return left;
      ++at_;
      left = made(CExpr::Kind::Binary, *mark, {std::move(left), binary(level + 1)});
    }
  }

  CExpr unary() {
    for (const std::string_view mark : {"-", "!", "&", "*", "++", "--"})
      if (take(mark)) return made(CExpr::Kind::Unary, mark, {unary()});
    if (is("(")) {
      ++at_;
      if (is_type()) {
        CExpr cast{.kind = CExpr::Kind::Cast, .type = pointers(base_type())};
        need(")");
        cast.parts.push_back(unary());
        return cast;
      }
      --at_;
    }
    return postfix();
  }

  CExpr postfix() {
    CExpr out = primary();
    for (;;) {
      if (take("[")) {
        out = made(CExpr::Kind::Index, "", {std::move(out), expression()});
        need("]");
      } else if (take(".")) {
        out = made(CExpr::Kind::Member, word(), {std::move(out)});
      } else if (take("->")) {
        out = made(CExpr::Kind::Member, word(), {made(CExpr::Kind::Unary, "*", {std::move(out)})});
      } else {
        return out;
      }
    }
  }

  CExpr primary() {
    if (is("(")) return in_brackets();
    if (here().kind == TokenKind::Number) return number();
    if (here().kind != TokenKind::Word) fail("an expression");
    CExpr out{.kind = CExpr::Kind::Name, .text = word()};
    if (!take("(")) return out;
    out.kind = CExpr::Kind::Call;
    while (!take(")")) {
      out.parts.push_back(assignment());
      if (!is(")")) need(",");
    }
    return out;
  }

  /// A whole number in decimal digits, or a real one with a point or an exponent; F behind a real
  /// number says that it is in single precision.
  CExpr number() {
    std::string_view text = here().text;
    const bool is_integer = text.find_first_of(".e") == std::string_view::npos;
    if (!is_integer && text.ends_with('F')) text.remove_suffix(1);
    if (!is_integer && text.ends_with('.')) text.remove_suffix(1);
    const auto value = parse_number(text);
    const bool is_octal = is_integer && text.size() > 1 && text[0] == '0';
    if (!value || is_octal) fail("a number such as 10, 0.5, 1e-9 or 0.5F");
    ++at_;
    return {.number = *value, .is_integer = is_integer};
  }

  std::vector<CToken> tokens_;
  std::size_t at_ = 0;
  CProgram program_;
  std::map<std::string, CType, std::less<>> types_;
};

}  // namespace

std::size_t CProgram::size_of(const CType& type) const {
  std::size_t one = 1;
  if (type.kind == CType::Kind::Struct && type.pointers == 0) {
    one = 0;
    for (const CDeclaration& field : structs[type.structure].fields) one += size_of(field.type);
  }
  return type.is_array ? type.count * one : one;
}

std::size_t CProgram::size_of_struct(std::string_view name) const {
  const auto found = std::ranges::find(structs, name, &CStruct::name);
  if (found == structs.end()) throw Error("C text", "has no struct '" + std::string(name) + "'");
  return size_of({.kind = CType::Kind::Struct,
                  .structure = static_cast<std::size_t>(found - structs.begin())});
}

CProgram parse_c(std::string_view code) { return Parser(code).program(); }

}  // namespace dashpot
