#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The equations of a law from a file: text to nodes. Nothing else of Dashpot sees the text: what
// computes and what is exported is made of the nodes.
namespace dashpot {

/// What a node of an equation is. A comparison is a condition, which only where() takes.
enum class LawOp : std::uint8_t {
  Number,     ///< `number`
  Parameter,  ///< number `index` of the law's table
  State,      ///< number `index`
  Displacement,
  Velocity,
  Travel,  ///< the displacement that a closed form of the state takes it over, m
  Negate,
  Add,
  Subtract,
  Multiply,
  Divide,
  Power,
  Abs,
  Sign,
  Sqrt,
  Exp,
  Log,
  Sin,
  Cos,
  Tan,
  Tanh,
  Atan,
  Atanh,
  Min,
  Max,
  Less,
  LessOrEqual,
  Equal,
  And,
  Or,
  Where,  ///< a condition, the value where it holds, the value where it does not

  // Of programs only (law_program.h). They join the two ways of a where(); they do what their like
  // above does with the outcome of the operation before, which need not come from memory.
  Move,
  Jump,
  JumpUnless,
  NegateIt,
  AbsOfIt,
  AddToIt,
  SubtractFromIt,  // it - b
  SubtractIt,      // a - it
  MultiplyIt,
  DivideIt,    // it / b
  DivideByIt,  // a / it
  PowerOfIt,
  MultiplyAdd,   // a * b + c
  MultiplyItAdd  // it * b + c
};

struct LawNode {
  LawOp op = LawOp::Number;
  double number = 0;
  std::uint16_t index = 0;
  std::array<std::uint16_t, 3> of{};  ///< the places of its arguments

  std::size_t arguments() const;
  bool is_condition() const;
};

/// The nodes of a law's equations, each once; arguments stand before what takes them.
class LawNodes {
 public:
  static constexpr std::size_t kMost = 500;

  /// The place of this node, an old one where there is its like. Throws Error(where, ...) at one
  /// more than kMost.
  std::uint16_t add(const LawNode& node, const std::string& where);
  const LawNode& operator[](std::size_t place) const { return nodes_[place]; }
  std::size_t size() const { return nodes_.size(); }
  /// Which nodes the values of `outputs` need, by place.
  std::vector<bool> needed(std::span<const std::uint16_t> outputs) const;
  /// Whether the value at `place` needs a node of this kind; `index` counts for parameters and
  /// states.
  bool needs(std::uint16_t place, LawOp op, std::uint16_t index = 0) const;

 private:
  std::vector<LawNode> nodes_;
};

/// The names that an expression may use, and the nodes that they stand for.
using LawNames = std::map<std::string, std::uint16_t, std::less<>>;

/// Reads "c0*v + where(v > 0, a, b)*tanh(z/z0)^2": + - * / ^, abs, sign, sqrt, exp, log, sin, cos,
/// tan, tanh, atan, atanh, min, max, pi, and where(condition, yes, no) with conditions of < <= > >=
/// ==, `and` and `or`. -a^b is -(a^b), a^b^c is a^(b^c). Throws Error(where, ...) that shows the
/// place of what is wrong and says what would be right, also on a text too long or nested too
/// deeply.
std::uint16_t parse_law_expression(std::string_view text, const LawNames& names, LawNodes& nodes,
                                   const std::string& where);
/// The same for a condition alone.
std::uint16_t parse_law_condition(std::string_view text, const LawNames& names, LawNodes& nodes,
                                  const std::string& where);

/// The name of a function of equations, and of the C function that it is; empty for operators.
std::string_view c_function_of(LawOp op);
/// Words that no parameter, state or definition may be called.
bool is_word_of_equations(std::string_view word);

}  // namespace dashpot
