#include "dashpot/export/c_subset/c_syntax.h"

#include <algorithm>
#include <array>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/export/c_subset/c_tokens.h"

namespace dashpot::trace {
namespace {

using TokenKind = CToken::Kind;

/// From the operators that bind least to those that bind most.
const std::array<std::vector<std::string_view>, 6> kBinary{
    {{"||"}, {"&&"}, {"==", "!="}, {"<", ">", "<=", ">="}, {"+", "-"}, {"*", "/", "%"}}};

class Parser {
 public:
  explicit Parser(std::string_view code) : tokens_(c_tokens(code)) {}

  CProgram program() {
    while (here().kind != TokenKind::End) top_level();
    return std::move(program_);
  }

 private:
  // Tokens.

  const CToken& here() const { return tokens_[at_]; }
  bool is(std::string_view text) const {
    return here().kind != TokenKind::End && here().text == text;
  }
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
    return tokens_[at_++].text;
  }
  [[noreturn]] void fail(const std::string& wanted) const {
    std::string around;
    for (std::size_t k = at_ < 8 ? 0 : at_ - 8; k < std::min(at_ + 4, tokens_.size()); ++k)
      around += (k == at_ ? " >>" : " ") + tokens_[k].text;
    throw Error("C text", "cannot be followed at" + around, wanted + " is expected there");
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
    while (is_type()) {
      const std::string name = here().text;
      if (name == "int") type.kind = CType::Kind::Int;
      if (name == "double" || name == "float") type.kind = CType::Kind::Real;
      if (const auto known = types_.find(name); known != types_.end()) type = known->second;
      const bool qualifies =
          name == "const" || name == "static" || name == "inline" || name == "struct";
      if (!qualifies && is_known) fail("a name");
      is_known = is_known || !qualifies;
      ++at_;
    }
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

  /// A size of an array.
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

  /// Up to its semicolon.
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

  /// Its names are constants, counted from 0.
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
    const CType base = base_type();
    const std::size_t begin = at_;
    const CType result = pointers(base);
    const std::string name = word();
    if (!is("(")) {
      at_ = begin;
      for (CDeclaration& global : declarations(base)) program_.globals.push_back(std::move(global));
      return;
    }
    need("(");
    CFunction function{.result = result};
    while (!take(")")) {
      function.parameters.push_back(declarator(base_type()));
      if (!is(")")) need(",");
    }
    if (take(";")) return;  // it comes later
    function.body.push_back(statement());
    program_.functions[name] = std::move(function);
  }

  // Statements.

  CStatement statement() {
    CStatement out;
    if (take("{")) {
      while (!take("}")) out.parts.push_back(statement());
    } else if (take(";")) {
    } else if (take("if")) {
      out.kind = CStatement::Kind::If;
      out.exprs.push_back(in_brackets());
      out.parts.push_back(statement());
      if (take("else")) out.parts.push_back(statement());
    } else if (take("while")) {
      out.kind = CStatement::Kind::Loop;
      out.exprs.push_back(in_brackets());
      out.parts.push_back(statement());
    } else if (take("for")) {
      out = for_loop();
    } else if (take("break")) {
      out.kind = CStatement::Kind::Break;
      need(";");
    } else if (take("return")) {
      out.kind = CStatement::Kind::Return;
      if (!is(";")) out.exprs.push_back(expression());
      need(";");
    } else if (is_type()) {
      out.kind = CStatement::Kind::Declaration;
      out.declarations = declarations(base_type());
    } else {
      out.kind = CStatement::Kind::Expression;
      out.exprs.push_back(expression());
      need(";");
    }
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
    if (here().kind == TokenKind::Number) return number(tokens_[at_++].text);
    CExpr out{.kind = CExpr::Kind::Name, .text = word()};
    if (!take("(")) return out;
    out.kind = CExpr::Kind::Call;
    while (!take(")")) {
      out.parts.push_back(assignment());
      if (!is(")")) need(",");
    }
    return out;
  }

  CExpr number(std::string text) {
    CExpr out{.is_integer = text.find_first_of(".e") == std::string::npos};
    if (text.back() == 'F') text.pop_back();
    if (text.back() == '.') text.pop_back();
    const auto value = parse_number(text);
    if (!value) fail("a number");
    out.number = *value;
    return out;
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

}  // namespace dashpot::trace
