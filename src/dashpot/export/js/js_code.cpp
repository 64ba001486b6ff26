#include "dashpot/export/js/js_code.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

using TypeKind = CType::Kind;
using Node = CExpr::Kind;

/// How strongly an operator binds in JavaScript, from a comma to a name: the order of C.
enum class Bind { Comma, Assign, Choose, Or, And, Equal, Less, Sum, Product, Unary, Atom };

/// An expression. A truth is true or false where C has 1 or 0.
struct Js {
  std::string text;
  Bind bind = Bind::Atom;
  CType type = {.kind = TypeKind::Real};
  bool is_truth = false;
};

/// A function of math.h: what stands for it, and the definition that this needs.
struct MathFunction {
  std::string_view name, in_js, definition;
};
constexpr std::array kMath{
    MathFunction{"atan", "Math.atan", ""},
    MathFunction{"atan2", "Math.atan2", ""},
    MathFunction{"atanh", "Math.atanh", ""},
    MathFunction{"ceil", "Math.ceil", ""},
    MathFunction{"copysign", "$copysign",
                 "const $copysign = (x, sign) => (sign < 0 || Object.is(sign, -0) ? -Math.abs(x) : "
                 "Math.abs(x));"},
    MathFunction{"cos", "Math.cos", ""},
    MathFunction{"exp", "Math.exp", ""},
    MathFunction{"expm1", "Math.expm1", ""},
    MathFunction{"fabs", "Math.abs", ""},
    MathFunction{"floor", "Math.floor", ""},
    // What is no number gives way to the other, which Math.max does not do.
    MathFunction{"fmax", "$fmax", "const $fmax = (a, b) => (a > b || b !== b ? a : b);"},
    MathFunction{"fmin", "$fmin", "const $fmin = (a, b) => (a < b || b !== b ? a : b);"},
    MathFunction{"isfinite", "Number.isFinite", ""},
    MathFunction{"isnan", "Number.isNaN", ""},
    MathFunction{"log", "Math.log", ""},
    MathFunction{"log1p", "Math.log1p", ""},
    MathFunction{"pow", "$pow", "const $pow = (x, y) => (x === 1 ? 1 : Math.pow(x, y));"},
    MathFunction{"sin", "Math.sin", ""},
    MathFunction{"sqrt", "Math.sqrt", ""},
    MathFunction{"tan", "Math.tan", ""},
    MathFunction{"tanh", "Math.tanh", ""},
};

/// Names in C that mean something in JavaScript.
constexpr std::array<std::string_view, 33> kReserved{
    "arguments",  "await",     "catch", "class",   "debugger", "delete",  "eval",
    "export",     "extends",   "false", "finally", "function", "import",  "in",
    "instanceof", "interface", "let",   "new",     "null",     "package", "private",
    "protected",  "public",    "super", "this",    "throw",    "true",    "try",
    "typeof",     "undefined", "var",   "with",    "yield"};

CType decayed(CType type) {
  if (!type.is_array) return type;
  type.is_array = false;
  ++type.pointers;
  return type;
}

/// What a pointer or an array points to.
CType pointed(CType type) {
  type = decayed(type);
  --type.pointers;
  return type;
}

CType element_of(CType array) {
  array.is_array = false;
  return array;
}

bool is_number(const CType& type) { return type.pointers == 0 && !type.is_array; }
bool is_real(const CType& type) { return is_number(type) && type.kind == TypeKind::Real; }
bool is_whole(const CType& type) { return is_number(type) && type.kind == TypeKind::Int; }

std::string in_brackets(const Js& js, Bind least) {
  return js.bind < least ? "(" + js.text + ")" : js.text;
}

/// A sum of places, of which those that are 0 are left out.
Js place_sum(const Js& first, const Js& second) {
  if (second.text == "0") return first;
  if (first.text == "0") return second;
  return {in_brackets(first, Bind::Sum) + " + " + in_brackets(second, Bind::Product), Bind::Sum};
}

Js times(const Js& count, std::size_t size) {
  if (size == 1) return count;
  if (const auto number = parse_number(count.text))
    return {format_exact(*number * static_cast<double>(size))};
  return {std::to_string(size) + " * " + in_brackets(count, Bind::Unary), Bind::Product};
}

/// Calls `see` with every expression below one, it first.
template <class See>
void each(const CExpr& expr, const See& see) {
  see(expr);
  for (const CExpr& part : expr.parts) each(part, see);
}
template <class See>
void each(const CInitialiser& initialiser, const See& see) {
  for (const CExpr& value : initialiser.value) each(value, see);
  for (const CInitialiser& part : initialiser.list) each(part, see);
}
template <class See>
void each(const CStatement& statement, const See& see) {
  for (const auto* list : {&statement.exprs, &statement.start, &statement.step})
    for (const CExpr& expr : *list) each(expr, see);
  for (const CDeclaration& one : statement.declarations)
    for (const CInitialiser& initialiser : one.initialiser) each(initialiser, see);
  for (const CStatement& part : statement.parts) each(part, see);
}

class Translator {
 public:
  Translator(const CProgram& program, std::span<const std::string_view> roots) : program_(program) {
    for (const std::string_view root : roots) need_function(std::string(root));
  }

  JsCode code(std::size_t room) {
    // Tables first, then the functions, whose variables lie behind them.
    std::string tables = written_tables(), functions;
    for (const std::string& name : order_)
      if (program_.functions.contains(name)) functions += function(name);

    std::string fields, helpers;
    for (const auto& [name, offset] : fields_)
      fields += "const " + name + " = " + std::to_string(offset) + ";\n";
    for (const std::string_view helper : helpers_) helpers += std::string(helper) + "\n";
    return {"const $ = new Float64Array(" + std::to_string(size_ + room) + ");\n" + tables +
                fields + helpers + "\n" + functions,
            size_};
  }

 private:
  struct Variable {
    CType type;
    bool in_memory = false;
    std::string text;  ///< its name, or its place
  };

  [[noreturn]] void fail(const std::string& what, const std::string& right) const {
    throw Error("C function " + function_, what, right);
  }

  // What the roots need.

  void need_function(const std::string& name) {
    if (std::ranges::find(at_work_, name) != at_work_.end())
      throw Error("C function " + name, "calls itself, by way of others or not",
                  "functions that do not");
    if (!seen_.insert(name).second) return;

    // What it calls and which tables it reads, depth first: `at_work_` shows circles.
    at_work_.push_back(name);
    for (const CStatement& body : program_.functions.at(name).body)
      each(body, [&](const CExpr& expr) {
        const bool is_call = expr.kind == Node::Call;
        if (is_call && program_.functions.contains(expr.text)) need_function(expr.text);
        if (expr.kind == Node::Name) need_global(expr.text);
      });
    at_work_.pop_back();
    order_.push_back(name);
  }

  const CDeclaration* global(std::string_view name) const {
    const auto found = std::ranges::find(program_.globals, name, &CDeclaration::name);
    return found == program_.globals.end() ? nullptr : &*found;
  }

  void need_global(const std::string& name) {
    const CDeclaration* found = global(name);
    if (!found || !seen_globals_.insert(name).second) return;
    for (const CInitialiser& initialiser : found->initialiser)
      each(initialiser, [&](const CExpr& expr) {
        if (expr.kind == Node::Name) need_global(expr.text);
      });
  }

  // Tables.

  bool is_constant(const CDeclaration& one) const {
    return is_number(one.type) && one.type.kind != TypeKind::Struct;
  }

  std::string written_tables() {
    // Places first: a table may point to one that stands behind it.
    std::string places;
    std::vector<const CDeclaration*> tables;
    for (const CDeclaration& one : program_.globals) {
      if (!seen_globals_.contains(one.name)) continue;
      if (is_constant(one)) {
        globals_[one.name] = {one.type, false, format_exact(constant(one.initialiser.at(0)))};
        continue;
      }
      globals_[one.name] = {one.type, true, one.name};
      places_[one.name] = size_;
      places += "const " + one.name + " = " + std::to_string(size_) + ";\n";
      size_ += program_.size_of(one.type);
      tables.push_back(&one);
    }
    if (tables.empty()) return "";

    std::vector<double> numbers;
    for (const CDeclaration* table : tables) {
      if (table->initialiser.empty())
        numbers.resize(numbers.size() + program_.size_of(table->type));
      else
        flatten(table->type, table->initialiser[0], numbers);
    }
    std::string list, line;
    for (const double number : numbers) {
      const std::string text = format_exact(number) + ",";
      if (line.size() + text.size() > 100) list += line + "\n", line.clear();
      line += text;
    }
    return "$.set([\n" + list + line + "\n]);\n" + places;
  }

  double constant(const CInitialiser& initialiser) const {
    if (initialiser.value.empty())
      throw Error("C text", "has a list where one number is due", "a number");
    return constant(initialiser.value[0]);
  }

  /// The value of an expression in a table: a number, a sum or product of such, or a place.
  double constant(const CExpr& expr) const {
    const auto part = [&](std::size_t k) { return constant(expr.parts[k]); };
    if (expr.kind == Node::Number) return expr.number;
    if (expr.kind == Node::Cast) return part(0);
    if (expr.kind == Node::Unary && expr.text == "-") return -part(0);
    if (expr.kind == Node::Unary && expr.text == "&") return part(0);
    if (expr.kind == Node::Binary && expr.text == "+") return part(0) + part(1);
    if (expr.kind == Node::Binary && expr.text == "-") return part(0) - part(1);
    if (expr.kind == Node::Binary && expr.text == "*") return part(0) * part(1);
    if (expr.kind == Node::Binary && expr.text == "/") return part(0) / part(1);
    if (expr.kind == Node::Name) {
      if (const auto place = places_.find(expr.text); place != places_.end())
        return static_cast<double>(place->second);
      if (const CDeclaration* one = global(expr.text); one && is_constant(*one))
        return constant(one->initialiser.at(0));
    }
    throw Error("C text", "has a table whose numbers are no constants", "numbers and tables");
  }

  /// The numbers of a table in the order of its places; those that the text leaves out are 0.
  void flatten(const CType& type, const CInitialiser& initialiser, std::vector<double>& to) const {
    const std::size_t end = to.size() + program_.size_of(type);
    if (type.is_array) {
      for (const CInitialiser& item : initialiser.list) flatten(element_of(type), item, to);
    } else if (type.is_struct()) {
      const std::vector<CDeclaration>& fields = program_.structs[type.structure].fields;
      for (std::size_t k = 0; k < initialiser.list.size(); ++k)
        flatten(fields.at(k).type, initialiser.list[k], to);
    } else {
      to.push_back(constant(initialiser));
    }
    to.resize(end);
  }

  // Functions.

  std::string function(const std::string& name) {
    function_ = name;
    const CFunction& function = program_.functions.at(name);
    result_ = function.result;

    // Variables to which something points need memory.
    pointed_at_.clear();
    each(function.body.at(0), [&](const CExpr& expr) {
      if (expr.kind == Node::Unary && expr.text == "&" && expr.parts[0].kind == Node::Name)
        pointed_at_.insert(expr.parts[0].text);
    });

    // Arguments are pointers and numbers; one that is pointed at moves into memory.
    std::string list, moved;
    scopes_.assign(1, {});
    for (const CDeclaration& parameter : function.parameters) {
      const CType type = decayed(parameter.type);
      if (type.is_struct())
        fail("takes the struct '" + parameter.name + "' by value", "a pointer to it");
      std::string given = own(parameter.name);
      if (pointed_at_.contains(parameter.name)) {
        const std::string place = std::to_string(size_++);
        given += "$value";
        moved += "  const " + own(parameter.name) + " = " + place + ";\n  $[" + place +
                 "] = " + given + ";\n";
      }
      scopes_.back()[parameter.name] = {type, pointed_at_.contains(parameter.name),
                                        own(parameter.name)};
      list += (list.empty() ? "" : ", ") + given;
    }

    indent_ = 1;
    std::string body;
    for (const CStatement& statement : function.body[0].parts) body += statement_text(statement);
    return "function " + own(name) + "(" + list + ") {\n" + moved + body + "}\n\n";
  }

  /// A name of C as one of JavaScript.
  static std::string own(const std::string& name) {
    return std::ranges::find(kReserved, name) != kReserved.end() ? name + "_" : name;
  }

  std::string margin() const { return std::string(2 * indent_, ' '); }
  std::string line(const std::string& text) const { return margin() + text + "\n"; }

  std::string block(const CStatement& statement) {
    scopes_.emplace_back();
    ++indent_;
    std::string text;
    if (statement.kind == CStatement::Kind::Block)
      for (const CStatement& part : statement.parts) text += statement_text(part);
    else
      text = statement_text(statement);
    --indent_;
    scopes_.pop_back();
    return text;
  }

  std::string statement_text(const CStatement& statement) {
    using Is = CStatement::Kind;
    switch (statement.kind) {
      // What has no effect leaves no text.
      case Is::Block: {
        const std::string inside = block(statement);
        return inside.empty() ? "" : line("{") + inside + line("}");
      }
      case Is::Declaration: {
        std::string text;
        for (const CDeclaration& one : statement.declarations) text += declaration(one);
        return text;
      }
      case Is::Expression: {
        const std::string text = effect(statement.exprs[0]);
        return text.empty() ? "" : line(text + ";");
      }

      // The way through the statements, which is C's own.
      case Is::If: {
        const std::string condition = truth(statement.exprs[0]).text;
        std::string text = line("if (" + condition + ") {") + block(statement.parts[0]);
        const std::string other = statement.parts.size() > 1 ? block(statement.parts[1]) : "";
        if (!other.empty()) text += line("} else {") + other;
        return text + line("}");
      }
      case Is::Loop:
        return loop(statement);
      case Is::Break:
        return line("break;");
      case Is::Return:
        return line(statement.exprs.empty() ? "return;" : "return " + returned(statement) + ";");
    }
    return "";
  }

  std::string loop(const CStatement& statement) {
    const std::string condition = truth(statement.exprs[0]).text;
    const auto part = [&](const std::vector<CExpr>& exprs) {
      return exprs.empty() ? std::string() : effect(exprs[0]);
    };
    const std::string start = part(statement.start), step = part(statement.step);
    const std::string head = start.empty() && step.empty()
                                 ? "while (" + condition + ") {"
                                 : "for (" + start + "; " + condition + "; " + step + ") {";
    return line(head) + block(statement.parts[0]) + line("}");
  }

  /// A struct is returned as the place where it lies; who called copies it at once.
  std::string returned(const CStatement& statement) {
    const CExpr& value = statement.exprs[0];
    return result_.is_struct() ? place(value).text : converted(evaluate(value), result_).text;
  }

  // Variables.

  std::string declaration(const CDeclaration& one) {
    const bool in_memory =
        one.type.is_array || one.type.is_struct() || pointed_at_.contains(one.name);
    if (!in_memory) {
      const std::string value =
          one.initialiser.empty()
              ? ""
              : " = " + converted(evaluate(one.initialiser[0].value.at(0)), one.type).text;
      scopes_.back()[one.name] = {one.type, false, own(one.name)};
      return line("let " + own(one.name) + value + ";");
    }

    const std::size_t at = size_;
    size_ += program_.size_of(one.type);
    scopes_.back()[one.name] = {one.type, true, own(one.name)};
    std::string text = line("const " + own(one.name) + " = " + std::to_string(at) + ";");
    if (!one.initialiser.empty())
      text += initialised(one.type, own(one.name), 0, one.initialiser[0]);
    return text;
  }

  static std::string at_place(const std::string& name, std::size_t offset) {
    return offset == 0 ? name : name + " + " + std::to_string(offset);
  }

  /// Assignments that give a variable in memory its first value; what the text leaves out is 0.
  std::string initialised(const CType& type, const std::string& name, std::size_t offset,
                          const CInitialiser& initialiser) {
    if (type.is_struct() && !initialiser.value.empty())
      return line(copied(at_place(name, offset), initialiser.value[0], type) + ";");
    if (!type.is_array && !type.is_struct())
      return line("$[" + at_place(name, offset) +
                  "] = " + converted(evaluate(initialiser.value.at(0)), type).text + ";");

    // The parts that are given, then zeros.
    const std::size_t end = offset + program_.size_of(type);
    std::string text;
    for (std::size_t k = 0; k < initialiser.list.size(); ++k) {
      const CType part =
          type.is_array ? element_of(type) : program_.structs[type.structure].fields.at(k).type;
      text += initialised(part, name, offset, initialiser.list[k]);
      offset += program_.size_of(part);
    }
    if (offset < end)
      text += line("$.fill(0, " + at_place(name, offset) + ", " + at_place(name, end) + ");");
    return text;
  }

  const Variable& find(const std::string& name) const {
    for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope)
      if (const auto found = scope->find(name); found != scope->end()) return found->second;
    if (const auto found = globals_.find(name); found != globals_.end()) return found->second;
    fail("has the name '" + name + "', which nothing declares", "a variable");
  }

  // Expressions.

  /// Where a thing lies: a place in $ as a number of type `type`.
  Js place(const CExpr& expr) {
    if (expr.kind == Node::Name) {
      const Variable& variable = find(expr.text);
      if (!variable.in_memory) fail("points at '" + expr.text + "'", "a variable in memory");
      return {variable.text, Bind::Atom, variable.type};
    }
    if (expr.kind == Node::Unary && expr.text == "*") {
      Js pointer = evaluate(expr.parts[0]);
      pointer.type = pointed(pointer.type);
      return pointer;
    }
    if (expr.kind == Node::Index) {
      const Js array = evaluate(expr.parts[0]);
      const CType element = pointed(array.type);
      Js at = place_sum(array, times(number(expr.parts[1]), program_.size_of(element)));
      at.type = element;
      return at;
    }
    if (expr.kind == Node::Member) return member(expr);
    if (expr.kind == Node::Call) return evaluate(expr);
    fail("has a value where something that lies in memory is due", "a variable");
  }

  Js member(const CExpr& expr) {
    const Js whole = place(expr.parts[0]);
    const CStruct& structure = program_.structs[whole.type.structure];
    std::size_t offset = 0;
    for (const CDeclaration& field : structure.fields) {
      if (field.name == expr.text) {
        const std::string name = structure.name + "$" + field.name;
        fields_[name] = offset;
        Js at = place_sum(whole, {name});
        at.type = field.type;
        return at;
      }
      offset += program_.size_of(field.type);
    }
    fail("asks " + structure.name + " for '" + expr.text + "', which it has not", "a field");
  }

  /// The value of what lies at a place; of arrays and structs the place itself.
  static Js read(const Js& place) {
    if (place.type.is_array || place.type.is_struct())
      return {place.text, place.bind, decayed(place.type)};
    return {"$[" + place.text + "]", Bind::Atom, place.type};
  }

  Js evaluate(const CExpr& expr) {
    switch (expr.kind) {
      // A number, a name or what lies in memory: JavaScript's variables have no address.
      case Node::Number:
        return {format_exact(expr.number),
                Bind::Atom,
                {.kind = expr.is_integer ? TypeKind::Int : TypeKind::Real}};
      case Node::Name: {
        const Variable& variable = find(expr.text);
        if (!variable.in_memory) {
          const bool is_negative = variable.text[0] == '-';
          return {variable.text, is_negative ? Bind::Unary : Bind::Atom, variable.type};
        }
        return read({variable.text, Bind::Atom, variable.type});
      }
      case Node::Index:
      case Node::Member:
        return read(place(expr));

      // What is computed of others.
      case Node::Unary:
        return unary(expr);
      case Node::Binary:
        return binary(expr);
      case Node::Assign:
        return assign(expr);
      case Node::Conditional:
        return choose(expr);
      case Node::Call:
        return call(expr);
      case Node::Cast:
        return cast(expr);
    }
    fail("has an expression of an unknown kind", "one of the subset");
  }

  /// A value that is a number, not a truth.
  Js number(const CExpr& expr) { return as_number(evaluate(expr)); }
  static Js as_number(const Js& js) {
    if (!js.is_truth) return js;
    return {"+" + in_brackets(js, Bind::Unary), Bind::Unary, {.kind = TypeKind::Int}};
  }

  /// Whether a value holds: in C what is no number does, in JavaScript it does not.
  Js truth(const CExpr& expr) {
    const Js js = evaluate(expr);
    if (js.is_truth || !is_real(js.type)) return js;
    return {in_brackets(js, Bind::Less) + " !== 0", Bind::Equal, {.kind = TypeKind::Int}, true};
  }

  static Js converted(const Js& from, const CType& type) {
    const Js value = as_number(from);
    if (is_whole(type) && is_real(value.type))
      return {"Math.trunc(" + value.text + ")", Bind::Atom, type};
    return {value.text, value.bind, type};
  }

  Js unary(const CExpr& expr) {
    const CExpr& part = expr.parts[0];
    if (expr.text == "&") {
      Js at = place(part);
      if (at.type.is_array) fail("takes the address of a whole array", "its name");
      ++at.type.pointers;
      return at;
    }
    if (expr.text == "*") return read(place(expr));
    if (expr.text == "!") {
      const Js js = truth(part);
      return {"!" + in_brackets(js, Bind::Unary), Bind::Unary, {.kind = TypeKind::Int}, true};
    }
    if (expr.text == "-") {
      const Js js = number(part);
      const bool is_signed = js.text[0] == '-';
      return {"-" + (is_signed ? "(" + js.text + ")" : in_brackets(js, Bind::Unary)), Bind::Unary,
              js.type};
    }

    // ++ and --: a pointer moves by what it points to.
    const Js js = evaluate(part);
    const std::size_t size = is_number(js.type) ? 1 : program_.size_of(pointed(js.type));
    if (size == 1) return {expr.text + js.text, Bind::Unary, js.type};
    return {js.text + " " + expr.text[0] + "= " + std::to_string(size), Bind::Assign, js.type};
  }

  struct Operator {
    std::string_view mark, in_js;
    Bind bind;
    bool is_truth;
  };
  static constexpr std::array<Operator, 14> kOperators{{{",", ",", Bind::Comma, false},
                                                        {"||", "||", Bind::Or, true},
                                                        {"&&", "&&", Bind::And, true},
                                                        {"==", "===", Bind::Equal, true},
                                                        {"!=", "!==", Bind::Equal, true},
                                                        {"<", "<", Bind::Less, true},
                                                        {">", ">", Bind::Less, true},
                                                        {"<=", "<=", Bind::Less, true},
                                                        {">=", ">=", Bind::Less, true},
                                                        {"+", "+", Bind::Sum, false},
                                                        {"-", "-", Bind::Sum, false},
                                                        {"*", "*", Bind::Product, false},
                                                        {"/", "/", Bind::Product, false},
                                                        {"%", "%", Bind::Product, false}}};

  static Js joined(const Operator& by, const Js& a, const Js& b, const CType& type) {
    const std::string space = by.mark == "," ? "" : " ";
    // Operators of the same strength group from the left.
    const auto right = static_cast<Bind>(static_cast<int>(by.bind) + 1);
    return {in_brackets(a, by.bind) + space + std::string(by.in_js) + " " + in_brackets(b, right),
            by.bind, type, by.is_truth};
  }

  Js binary(const CExpr& expr) {
    const Operator& by = *std::ranges::find(kOperators, expr.text, &Operator::mark);
    if (expr.text == ",") {
      // Of the first only what it does counts.
      const std::string first = effect(expr.parts[0]);
      const Js second = evaluate(expr.parts[1]);
      if (first.empty()) return second;
      return {first + ", " + in_brackets(second, Bind::Assign), Bind::Comma, second.type,
              second.is_truth};
    }
    if (by.bind == Bind::Or || by.bind == Bind::And) {
      const auto side = [&](std::size_t k) {
        const Js js = truth(expr.parts[k]);
        // A whole number is as good as a truth in a condition, but would be the value here.
        return js.is_truth ? js
                           : Js{in_brackets(js, Bind::Less) + " !== 0", Bind::Equal, js.type, true};
      };
      return joined(by, side(0), side(1), {.kind = TypeKind::Int});
    }
    return arithmetic(by, number(expr.parts[0]), number(expr.parts[1]));
  }

  Js arithmetic(const Operator& by, Js a, Js b) {
    // A pointer moves by what it points to.
    const bool moves_a = !is_number(a.type), moves_b = !is_number(b.type);
    if (!by.is_truth && (moves_a || moves_b)) {
      if ((moves_a && moves_b) || (by.mark != "+" && (by.mark != "-" || moves_b)))
        fail("computes with pointers by '" + std::string(by.mark) + "'", "a pointer and a number");
      Js& moved = moves_a ? b : a;
      moved = times(moved, program_.size_of(pointed(moves_a ? a.type : b.type)));
      const CType type = moves_a ? a.type : b.type;
      return joined(by, a, b, type);
    }
    if (by.is_truth) return joined(by, a, b, {.kind = TypeKind::Int});

    // Whole numbers stay whole.
    const bool whole = is_whole(a.type) && is_whole(b.type);
    Js out = joined(by, a, b, {.kind = whole ? TypeKind::Int : TypeKind::Real});
    if (whole && by.mark == "/") return {"Math.trunc(" + out.text + ")", Bind::Atom, out.type};
    return out;
  }

  std::string copied(const std::string& to, const CExpr& from, const CType& type) {
    const std::string source = in_brackets(place(from), Bind::Assign);
    return "$copy(" + to + ", " + source + ", " + std::to_string(use_copy(program_.size_of(type))) +
           ")";
  }
  std::size_t use_copy(std::size_t size) {
    helpers_.insert(
        "const $copy = (to, from, count) => {\n"
        "  for (let k = 0; k < count; ++k) $[to + k] = $[from + k];\n};");
    return size;
  }

  Js assign(const CExpr& expr) {
    const CExpr& to = expr.parts[0];
    const bool is_variable = to.kind == Node::Name && !find(to.text).in_memory;
    const Js goal =
        is_variable ? Js{find(to.text).text, Bind::Atom, find(to.text).type} : place(to);
    if (goal.type.is_struct())
      return {copied(goal.text, expr.parts[1], goal.type), Bind::Atom, goal.type};

    const Js target = is_variable ? goal : read(goal);
    Js value = number(expr.parts[1]);
    const bool is_pointer = !is_number(goal.type);
    if (is_pointer && !expr.text.empty())
      value = times(value, program_.size_of(pointed(goal.type)));

    // A whole number that takes in a real one is cut again.
    if (!expr.text.empty() && is_whole(goal.type) && (is_real(value.type) || expr.text == "/")) {
      const Operator& by = *std::ranges::find(kOperators, expr.text, &Operator::mark);
      value = arithmetic(by, target, value);
      return {target.text + " = " + converted(value, goal.type).text, Bind::Assign, goal.type};
    }
    if (expr.text.empty()) value = converted(value, goal.type);
    return {target.text + " " + expr.text + "= " + in_brackets(value, Bind::Assign), Bind::Assign,
            goal.type};
  }

  Js choose(const CExpr& expr) {
    const Js condition = truth(expr.parts[0]);
    const Js yes = number(expr.parts[1]), no = number(expr.parts[2]);
    const CType type = is_real(no.type) ? no.type : yes.type;
    return {in_brackets(condition, Bind::Or) + " ? " + in_brackets(yes, Bind::Assign) + " : " +
                in_brackets(no, Bind::Assign),
            Bind::Choose, type};
  }

  Js call(const CExpr& expr) {
    const auto function = program_.functions.find(expr.text);
    if (function == program_.functions.end()) return math(expr);
    std::string list;
    for (std::size_t k = 0; k < expr.parts.size(); ++k) {
      const CType type = decayed(function->second.parameters.at(k).type);
      const Js argument = converted(evaluate(expr.parts[k]), type);
      list += (list.empty() ? "" : ", ") + in_brackets(argument, Bind::Assign);
    }
    return {own(expr.text) + "(" + list + ")", Bind::Atom, function->second.result};
  }

  Js math(const CExpr& expr) {
    const auto found = std::ranges::find(kMath, expr.text, &MathFunction::name);
    if (found == kMath.end())
      fail("calls '" + expr.text + "', which JavaScript has not", "another function of math.h");
    if (!found->definition.empty()) helpers_.insert(found->definition);
    std::string list;
    for (const CExpr& part : expr.parts)
      list += (list.empty() ? "" : ", ") + in_brackets(number(part), Bind::Assign);
    const bool is_truth = found->in_js.starts_with("Number.");
    return {std::string(found->in_js) + "(" + list + ")",
            Bind::Atom,
            {.kind = is_truth ? TypeKind::Int : TypeKind::Real},
            is_truth};
  }

  Js cast(const CExpr& expr) {
    const Js value = number(expr.parts[0]);
    if (is_number(expr.type) != is_number(value.type) && expr.type.kind != TypeKind::Void)
      fail("makes a number of a pointer, or the reverse", "either");
    return converted(value, expr.type);
  }

  /// An expression for what it does alone; "" where it does nothing.
  std::string effect(const CExpr& expr) {
    if (expr.kind == Node::Cast && expr.type.kind == TypeKind::Void && expr.type.pointers == 0)
      return effect(expr.parts[0]);
    if (expr.kind == Node::Binary && expr.text == ",") {
      const std::string first = effect(expr.parts[0]), second = effect(expr.parts[1]);
      return first + (first.empty() || second.empty() ? "" : ", ") + second;
    }
    bool does = false;
    each(expr, [&](const CExpr& part) {
      does = does || part.kind == Node::Call || part.kind == Node::Assign ||
             (part.kind == Node::Unary && (part.text == "++" || part.text == "--"));
    });
    return does ? evaluate(expr).text : "";
  }

  const CProgram& program_;
  std::set<std::string> seen_, seen_globals_;  ///< what the roots need
  std::vector<std::string> at_work_, order_;   ///< functions: callers; callees before callers
  std::map<std::string, Variable> globals_;
  std::map<std::string, std::size_t> places_;  ///< of tables
  std::map<std::string, std::size_t> fields_;  ///< "Struct$field" and its place within
  std::set<std::string_view> helpers_;
  std::size_t size_ = 0;  ///< of $, so far

  // The function at work.
  std::string function_;
  CType result_;
  std::set<std::string> pointed_at_;
  std::vector<std::map<std::string, Variable>> scopes_;
  std::size_t indent_ = 1;
};

}  // namespace

JsCode js_code(const CProgram& program, std::span<const std::string_view> roots, std::size_t room) {
  return Translator(program, roots).code(room);
}

}  // namespace dashpot
