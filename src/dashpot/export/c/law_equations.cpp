#include "dashpot/export/c/law_equations.h"

#include <algorithm>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_text.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {
namespace {

constexpr int kDeepestExpression = 12;  // beyond, a part of it becomes a variable

std::string_view operator_of(LawOp op) {
  switch (op) {
    case LawOp::Add:
      return " + ";
    case LawOp::Subtract:
      return " - ";
    case LawOp::Multiply:
      return " * ";
    case LawOp::Divide:
      return " / ";
    case LawOp::Less:
      return " < ";
    case LawOp::LessOrEqual:
      return " <= ";
    case LawOp::Equal:
      return " == ";
    case LawOp::And:
      return " && ";
    case LawOp::Or:
      return " || ";
    default:
      return "";
  }
}

/// The body of one function: variables for what several places take, then its values.
class FunctionBody {
 public:
  FunctionBody(const Law& law, std::vector<std::uint16_t> outputs)
      : law_(law), nodes_(law.text->nodes()), outputs_(std::move(outputs)) {
    const std::vector<bool> needed = nodes_.needed(outputs_);
    std::vector<int> uses(nodes_.size()), depth(nodes_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      for (std::size_t a = 0; needed[k] && a < nodes_[k].arguments(); ++a) ++uses[nodes_[k].of[a]];
    for (const std::uint16_t output : outputs_) ++uses[output];

    // In the order of the nodes, so that each variable stands above what takes it. Conditions are
    // no numbers, and stay where they are.
    texts_.resize(nodes_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (!needed[k]) continue;
      const LawNode& node = nodes_[k];
      texts_[k] = expression(node);
      for (std::size_t a = 0; a < node.arguments(); ++a)
        depth[k] = std::max(depth[k], 1 + depth[node.of[a]]);
      const bool leaf = node.arguments() == 0;
      if (leaf || node.is_condition() || (uses[k] < 2 && depth[k] < kDeepestExpression)) continue;
      const std::string name = "t" + std::to_string(++variables_);
      code_ += "  const double " + name + " = " + texts_[k] + ";\n";
      texts_[k] = name;
      depth[k] = 0;
    }
  }

  const std::string& variables() const { return code_; }
  const std::string& value(std::size_t output) const { return texts_[outputs_[output]]; }
  /// What keeps a compiler silent about arguments that this function does not take.
  std::string unused(std::initializer_list<std::pair<LawOp, std::string_view>> arguments) const {
    const std::vector<bool> needed = nodes_.needed(outputs_);
    std::string code;
    for (const auto& [op, name] : arguments) {
      bool taken = false;
      for (std::size_t k = 0; k < nodes_.size(); ++k) taken |= needed[k] && nodes_[k].op == op;
      if (!taken) code += "  (void)" + std::string(name) + ";\n";
    }
    return code;
  }

 private:
  std::string expression(const LawNode& node) const {
    const auto argument = [&](std::size_t k) { return texts_[node.of[k]]; };

    // Numbers and names, and the two operations that C writes unlike all others.
    switch (node.op) {
      case LawOp::Number:
        return c_number(node.number);
      case LawOp::Parameter:
        return "p->" + std::string(law_.params[node.index].name);
      case LawOp::State:
        return "z[" + std::to_string(node.index) + "]";
      case LawOp::Displacement:
        return "x";
      case LawOp::Velocity:
        return "v";
      case LawOp::Travel:
        return "s";
      case LawOp::Negate:
        return "(-" + argument(0) + ")";
      case LawOp::Where:
        return "(" + argument(0) + " ? " + argument(1) + " : " + argument(2) + ")";
      default:
        break;
    }

    // An operator between two arguments, or a function of one or two.
    if (const std::string_view sign = operator_of(node.op); !sign.empty())
      return "(" + argument(0) + std::string(sign) + argument(1) + ")";
    return std::string(c_function_of(node.op)) + "(" + argument(0) +
           (node.arguments() > 1 ? ", " + argument(1) : "") + ")";
  }

  const Law& law_;
  const LawNodes& nodes_;
  std::vector<std::uint16_t> outputs_;
  std::vector<std::string> texts_;
  std::string code_;
  int variables_ = 0;
};

/// Text of the file in comments.
std::string comment(std::string_view text) { return c_comment(text).text(); }

std::string head_of(const Law& law) {
  std::string code = "/* " + comment(law.title) + ", a law from a file.\n *\n";
  for (const std::string& line : split(law.equation, '\n')) code += " *   " + comment(line) + "\n";
  code += " *\n * Source: " + comment(law.source) + "\n */\n#include \"law_functions.h\"\n\n";

  // The parameters, in the order of the law's table.
  code += "typedef struct " + pascal_case(c_law_name(law)) + " {\n";
  const std::size_t own = law.side_row > 0 ? law.side_row : law.params.size();
  for (std::size_t k = 0; k < own; ++k) {
    const ParamInfo& row = law.params[k];
    code += "  double " + std::string(row.name) + "; /* " + comment(row.unit) + ", " +
            comment(row.meaning) + " */\n";
  }
  return code + "} " + pascal_case(c_law_name(law)) + ";\n\n";
}

}  // namespace

std::string c_law_name(const Law& law) { return (law.text ? "own_" : "") + std::string(law.name); }

std::string c_law_equations(const Law& law) {
  const LawText& text = *law.text;
  const std::string name = c_law_name(law), type = "const " + pascal_case(name) + "* p";
  const std::string begin = "static inline ", motion = "(" + type + ", double x, double v, ";
  constexpr std::pair kP{LawOp::Parameter, std::string_view("p")},
      kX{LawOp::Displacement, std::string_view("x")}, kV{LawOp::Velocity, std::string_view("v")},
      kZ{LawOp::State, std::string_view("z")}, kS{LawOp::Travel, std::string_view("s")};

  // Several values into an array, or one that is returned.
  const auto filling = [](const FunctionBody& body, std::size_t count, const std::string& array) {
    std::string code;
    for (std::size_t k = 0; k < count; ++k)
      code += "  " + array + "[" + std::to_string(k) + "] = " + body.value(k) + ";\n";
    return code + "}\n\n";
  };
  const auto returning = [](const FunctionBody& body) {
    return "  return " + body.value(0) + ";\n}\n\n";
  };

  // The force; then what a law with states has besides.
  const FunctionBody force(law, {text.force()});
  std::string code = head_of(law) + begin + "double " + name + "_force" + motion +
                     "const double* z) {\n" + force.variables() + force.unused({kX, kV, kZ}) +
                     returning(force);
  if (law.states.empty()) return code;
  const FunctionBody rates(law, text.rates()), rests(law, text.rests()), rate(law, {text.rate()});
  code += begin + "void " + name + "_derivative" + motion + "const double* z, double* dz) {\n" +
          rates.variables() + rates.unused({kP, kX, kV, kZ}) +
          filling(rates, law.states.size(), "dz");
  code += begin + "void " + name + "_rest" + motion + "double* z) {\n" + rests.variables() +
          rests.unused({kP, kX, kV}) + filling(rests, law.states.size(), "z");
  code += "/* 1/s: how fast the states settle at speed v */\n" + begin + "double " + name +
          "_rate(" + type + ", double v) {\n" + rate.variables() + rate.unused({kP, kV}) +
          returning(rate);
  if (!text.travel()) return code;

  // The closed form, and the condition under which it is one.
  const FunctionBody travel(law, {text.travel()->value});
  code += "/* the state after a displacement s of either sign */\n" + begin + "double " + name +
          "_travel(" + type + ", double before, double s) {\n  const double z[1] = {before};\n" +
          travel.variables() + travel.unused({kP, kZ, kS}) + returning(travel);
  if (!text.travel()->holds) return code;
  const FunctionBody holds(law, {*text.travel()->holds});
  return code + "/* whether that form holds */\n" + begin + "int " + name + "_travel_holds(" +
         type + ") {\n" + holds.variables() + holds.unused({kP}) + "  return " + holds.value(0) +
         " ? 1 : 0;\n}\n\n";
}

}  // namespace dashpot
