#include "dashpot/damper/kinds/law/law_expression.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::size_t kLongestText = 4000;
constexpr int kDeepestNesting = 50;

/// A function of equations: its name, its C function and how many arguments it has.
struct EquationFunction {
  std::string_view name, c_name;
  LawOp op;
  std::size_t arguments;
};
constexpr std::array kEquationFunctions{
    EquationFunction{"abs", "fabs", LawOp::Abs, 1},
    EquationFunction{"sign", "law_sign", LawOp::Sign, 1},
    EquationFunction{"sqrt", "sqrt", LawOp::Sqrt, 1},
    EquationFunction{"exp", "exp", LawOp::Exp, 1},
    EquationFunction{"log", "log", LawOp::Log, 1},
    EquationFunction{"sin", "sin", LawOp::Sin, 1},
    EquationFunction{"cos", "cos", LawOp::Cos, 1},
    EquationFunction{"tan", "tan", LawOp::Tan, 1},
    EquationFunction{"tanh", "tanh", LawOp::Tanh, 1},
    EquationFunction{"atan", "atan", LawOp::Atan, 1},
    EquationFunction{"atanh", "atanh", LawOp::Atanh, 1},
    EquationFunction{"min", "fmin", LawOp::Min, 2},
    EquationFunction{"max", "fmax", LawOp::Max, 2},
    EquationFunction{"where", "", LawOp::Where, 3},
};
constexpr std::array<std::string_view, 3> kEquationWords{"pi", "and", "or"};

const EquationFunction* function_named(std::string_view name) {
  const auto found = std::ranges::find(kEquationFunctions, name, &EquationFunction::name);
  return found == kEquationFunctions.end() ? nullptr : &*found;
}

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const EquationFunction& function : kEquationFunctions) names.emplace_back(function.name);
  return names;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// One expression on its way to nodes, by recursive descent.
class EquationParser {
 public:
  EquationParser(std::string_view text, const LawNames& names, LawNodes& nodes,
                 const std::string& where)
      : text_(text), names_(names), nodes_(nodes), where_(where) {
    if (text.size() > kLongestText)
      throw Error(where, "is an expression of " + std::to_string(text.size()) + " characters",
                  "at most " + std::to_string(kLongestText) +
                      "; name parts of it by equations of their own");
  }

  std::uint16_t whole_value() {
    const std::uint16_t node = sum();
    refuse_rest();
    return node;
  }

  std::uint16_t whole_condition() {
    const std::uint16_t node = condition();
    refuse_rest();
    return node;
  }

 private:
  /// Counts how deep the parser stands, so that no text can exhaust the stack.
  class Level {
   public:
    explicit Level(EquationParser& parser) : parser_(parser) {
      if (++parser_.depth_ > kDeepestNesting)
        parser_.refuse("is nested more than " + std::to_string(kDeepestNesting) + " levels deep",
                       "name parts of it by equations of their own");
    }
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    EquationParser& parser_;
  };

  [[noreturn]] void refuse(const std::string& what, const std::string& right) const {
    throw Error(where_, "'" + std::string(trim(text_)) + "' " + what, right);
  }

  void skip_blanks() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
      ++at_;
  }

  /// Takes this sign or word where it stands next.
  bool take(std::string_view sign) {
    skip_blanks();
    if (!text_.substr(at_).starts_with(sign)) return false;
    const std::size_t end = at_ + sign.size();
    if (is_letter(sign.front()) && end < text_.size() &&
        (is_letter(text_[end]) || is_digit(text_[end])))
      return false;
    at_ = end;
    return true;
  }

  /// What stands next, for a message.
  std::string next() {
    skip_blanks();
    if (at_ == text_.size()) return "its end";
    std::size_t end = at_ + 1;
    while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end])) &&
           (is_letter(text_[at_]) || is_digit(text_[at_])))
      ++end;
    return "'" + std::string(text_.substr(at_, end - at_)) + "'";
  }

  void require(std::string_view sign, const std::string& after) {
    if (!take(sign))
      refuse("has " + next() + " where '" + std::string(sign) + "' is expected " + after,
             "write '" + std::string(sign) + "' there");
  }

  void refuse_rest() {
    skip_blanks();
    if (at_ == text_.size()) return;
    const bool operand = is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '(';
    refuse("has " + next() + " where it could end",
           operand ? "a product is written with *, as 2*v" : "the operators are + - * / ^");
  }

  std::uint16_t make(LawOp op, std::uint16_t a, std::uint16_t b = 0, std::uint16_t c = 0) {
    return nodes_.add({.op = op, .of = {a, b, c}}, where_);
  }

  std::uint16_t condition() {
    const Level level(*this);
    std::uint16_t node = conjunction();
    while (take("or")) node = make(LawOp::Or, node, conjunction());
    return node;
  }

  std::uint16_t conjunction() {
    std::uint16_t node = comparison();
    while (take("and")) node = make(LawOp::And, node, comparison());
    return node;
  }

  std::uint16_t comparison() {
    const std::uint16_t left = sum();
    if (take("<=")) return make(LawOp::LessOrEqual, left, sum());
    if (take("<")) return make(LawOp::Less, left, sum());
    if (take("==")) return make(LawOp::Equal, left, sum());

    // A right side that is larger stands first in its node.
    if (take(">=")) {
      const std::uint16_t right = sum();
      return make(LawOp::LessOrEqual, right, left);
    }
    if (take(">")) {
      const std::uint16_t right = sum();
      return make(LawOp::Less, right, left);
    }
    refuse("has " + next() + " where a condition compares", "write it as v > 0; < <= > >= ==");
  }

  std::uint16_t sum() {
    const Level level(*this);
    std::uint16_t node = product();
    for (;;) {
      if (take("+"))
        node = make(LawOp::Add, node, product());
      else if (take("-"))
        node = make(LawOp::Subtract, node, product());
      else
        return node;
    }
  }

  std::uint16_t product() {
    std::uint16_t node = negated();
    for (;;) {
      if (take("**"))
        refuse("has '**'", "a power is written with ^");
      else if (take("*"))
        node = make(LawOp::Multiply, node, negated());
      else if (take("/"))
        node = make(LawOp::Divide, node, negated());
      else
        return node;
    }
  }

  std::uint16_t negated() {
    const Level level(*this);
    if (take("-")) {
      const std::uint16_t node = negated();
      if (nodes_[node].op != LawOp::Number) return make(LawOp::Negate, node);
      return nodes_.add({.op = LawOp::Number, .number = -nodes_[node].number}, where_);
    }
    const std::uint16_t base = primary();
    return take("^") ? make(LawOp::Power, base, negated()) : base;
  }

  std::uint16_t primary() {
    skip_blanks();
    if (take("(")) {
      const std::uint16_t node = sum();
      require(")", "behind what began with '('");
      return node;
    }
    if (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) return number();
    if (at_ < text_.size() && is_letter(text_[at_])) return named();
    refuse("has " + next() + " where a number, a name or '(' is expected",
           "write an expression such as c0*v + k0*(x - x0)");
  }

  std::uint16_t number() {
    std::size_t end = at_;
    while (end < text_.size() && (is_digit(text_[end]) || text_[end] == '.')) ++end;

    // An exponent belongs to it where digits follow.
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      std::size_t digits = end + 1;
      if (digits < text_.size() && (text_[digits] == '+' || text_[digits] == '-')) ++digits;
      if (digits < text_.size() && is_digit(text_[digits])) {
        while (digits < text_.size() && is_digit(text_[digits])) ++digits;
        end = digits;
      }
    }

    const std::string_view word = text_.substr(at_, end - at_);
    const std::optional<double> value = parse_number(word);
    if (!value || !std::isfinite(*value))
      refuse("has '" + std::string(word) + "', which is no number", "write it as 0.25 or 1e-3");
    at_ = end;
    return nodes_.add({.op = LawOp::Number, .number = *value}, where_);
  }

  std::uint16_t named() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string name(text_.substr(begin, at_ - begin));
    if (take("(")) return call(name);
    if (name == "pi") return nodes_.add({.op = LawOp::Number, .number = std::numbers::pi}, where_);
    if (const auto found = names_.find(name); found != names_.end()) return found->second;

    if (function_named(name)) refuse("has no argument behind " + name, "write " + name + "(...)");
    std::vector<std::string> known;
    for (const auto& [each, node] : names_) known.push_back(each);
    refuse("has '" + name + "', which is neither a parameter, a state nor defined above",
           suggest(name, known));
  }

  std::uint16_t call(const std::string& name) {
    const EquationFunction* function = function_named(name);
    if (!function && names_.contains(name))
      refuse("calls '" + name + "', which is no function", "write " + name + "*(...)");
    if (!function)
      refuse("has the unknown function '" + name + "'", suggest(name, function_names()));

    // The first argument of where() alone is a condition.
    std::array<std::uint16_t, 3> arguments{};
    for (std::size_t k = 0; k < function->arguments; ++k) {
      if (k > 0) require(",", "between the arguments of " + name + "()");
      arguments[k] = function->op == LawOp::Where && k == 0 ? condition() : sum();
    }
    require(")", "behind the " + counted(function->arguments, "argument") + " of " + name + "()");
    return make(function->op, arguments[0], arguments[1], arguments[2]);
  }

  std::string_view text_;
  const LawNames& names_;
  LawNodes& nodes_;
  const std::string& where_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

std::size_t LawNode::arguments() const {
  if (op <= LawOp::Travel) return 0;
  if (op == LawOp::Negate) return 1;
  if (op <= LawOp::Power) return 2;
  if (op <= LawOp::Atanh) return 1;
  return op == LawOp::Where ? 3 : 2;
}

bool LawNode::is_condition() const { return op >= LawOp::Less && op <= LawOp::Or; }

std::uint16_t LawNodes::add(const LawNode& node, const std::string& where) {
  const auto is_same = [&](const LawNode& other) {
    return other.op == node.op && other.index == node.index && other.of == node.of &&
           other.number == node.number;
  };
  const auto found = std::ranges::find_if(nodes_, is_same);
  if (found == nodes_.end()) {
    if (nodes_.size() == kMost)
      throw Error(where,
                  "the equations of the law have more than " + std::to_string(kMost) +
                      " different operations, names and numbers",
                  "write a smaller law, or one in C++ (CONTRIBUTING.md)");
    nodes_.push_back(node);
    return static_cast<std::uint16_t>(nodes_.size() - 1);
  }
  return static_cast<std::uint16_t>(found - nodes_.begin());
}

std::vector<bool> LawNodes::needed(std::span<const std::uint16_t> outputs) const {
  std::vector<bool> needed(nodes_.size());
  for (const std::uint16_t output : outputs) needed[output] = true;

  // Arguments stand before what takes them.
  for (std::size_t k = nodes_.size(); k-- > 0;)
    for (std::size_t a = 0; needed[k] && a < nodes_[k].arguments(); ++a)
      needed[nodes_[k].of[a]] = true;
  return needed;
}

bool LawNodes::needs(std::uint16_t place, LawOp op, std::uint16_t index) const {
  const std::vector<bool> needed = this->needed({&place, 1});
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (needed[k] && nodes_[k].op == op && nodes_[k].index == index) return true;
  return false;
}

std::uint16_t parse_law_expression(std::string_view text, const LawNames& names, LawNodes& nodes,
                                   const std::string& where) {
  return EquationParser(text, names, nodes, where).whole_value();
}

std::uint16_t parse_law_condition(std::string_view text, const LawNames& names, LawNodes& nodes,
                                  const std::string& where) {
  return EquationParser(text, names, nodes, where).whole_condition();
}

std::string_view c_function_of(LawOp op) {
  const auto found = std::ranges::find(kEquationFunctions, op, &EquationFunction::op);
  if (op == LawOp::Power) return "law_power";
  return found == kEquationFunctions.end() ? std::string_view() : found->c_name;
}

bool is_word_of_equations(std::string_view word) {
  return function_named(word) || std::ranges::find(kEquationWords, word) != kEquationWords.end();
}

}  // namespace dashpot
