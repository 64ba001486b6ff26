#include "dashpot/export/onnx/graph.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace dashpot::trace {
namespace {

/// A function of one constant.
double folded(Op op, double a) {
  switch (op) {
    // Rounded as the compiler's math library does, in double precision.
    case Op::Exp:
      return std::exp(a);
    case Op::Log:
      return std::log(a);
    case Op::Sqrt:
      return std::sqrt(a);
    case Op::Abs:
      return std::abs(a);
    case Op::Tanh:
      return std::tanh(a);
    case Op::Sin:
      return std::sin(a);
    case Op::Atan:
      return std::atan(a);
    case Op::Ceil:
      return std::ceil(a);
    default:
      return std::floor(a);
  }
}

/// An operator on two constants; 1 or 0 for a truth.
double folded(Op op, double a, double b) {
  switch (op) {
    // fmin and fmax: where one is no number, the other is taken, as C has it.
    case Op::Mul:
      return a * b;
    case Op::Div:
      return a / b;
    case Op::Pow:
      return std::pow(a, b);
    case Op::Min:
      return std::fmin(a, b);
    case Op::Max:
      return std::fmax(a, b);
    case Op::Less:
      return a < b;
    case Op::LessOrEqual:
      return a <= b;
    default:
      return a == b;
  }
}

std::string key_of(const NodeData& data) {
  std::string key(1, static_cast<char>(data.op));
  key += data.is_truth ? '?' : ' ';
  const auto append = [&](const auto& values) {
    const std::size_t at = key.size(), size = values.size() * sizeof values[0];
    key.resize(at + size);
    if (size > 0) std::memcpy(key.data() + at, values.data(), size);
  };
  append(data.inputs);
  append(data.numbers);
  append(std::vector{data.loop});
  return key;
}

}  // namespace

Node Graph::made(NodeData data) {
  for (const Node input : data.inputs) data.region = std::max(data.region, at(input).region);
  const auto [entry, is_new] = known_.try_emplace(key_of(data), static_cast<Node>(nodes_.size()));
  if (is_new) nodes_.push_back(std::move(data));
  return entry->second;
}

Node Graph::constant(double value) { return made({.op = Op::Constant, .numbers = {value}}); }

Node Graph::truth(bool value) {
  return made({.op = Op::Constant, .numbers = {value ? 1. : 0.}, .is_truth = true});
}

Node Graph::input(std::size_t which) {
  return made({.op = Op::Input, .numbers = {static_cast<double>(which)}});
}

Node Graph::sum(Node a, double factor_a, Node b, double factor_b) {
  // Collect the terms of both: sums are taken apart, constants are added up.
  std::vector<std::pair<Node, double>> terms;
  double rest = 0;
  const auto take = [&](Node node, double factor) {
    if (factor == 0) return;
    const NodeData& data = at(as_number(node));
    if (data.op == Op::Constant) {
      rest += factor * data.numbers[0];
    } else if (data.op == Op::Affine) {
      for (std::size_t k = 0; k < data.inputs.size(); ++k)
        terms.emplace_back(data.inputs[k], factor * data.numbers[k]);
      rest += factor * data.numbers.back();
    } else {
      terms.emplace_back(as_number(node), factor);
    }
  };
  take(a, factor_a);
  take(b, factor_b);

  // Merge terms of the same node; those that cancel are left out.
  std::ranges::sort(terms);
  NodeData out{.op = Op::Affine};
  for (std::size_t k = 0; k < terms.size();) {
    double factor = 0;
    const Node node = terms[k].first;
    for (; k < terms.size() && terms[k].first == node; ++k) factor += terms[k].second;
    if (factor == 0) continue;
    out.inputs.push_back(node);
    out.numbers.push_back(factor);
  }

  // A sum of one is no sum.
  if (out.inputs.empty()) return constant(rest);
  if (out.inputs.size() == 1 && out.numbers[0] == 1 && rest == 0) return out.inputs[0];
  out.numbers.push_back(rest);
  return made(std::move(out));
}

Node Graph::pair(Op op, Node a, Node b) {
  a = as_number(a);
  b = as_number(b);
  if (is_constant(a) && is_constant(b)) return constant(folded(op, value(a), value(b)));
  return made({.op = op, .inputs = {a, b}});
}

Node Graph::multiply(Node a, Node b) {
  if (is_constant(a)) return scaled(b, value(a));
  if (is_constant(b)) return scaled(a, value(b));
  return pair(Op::Mul, std::min(a, b), std::max(a, b));
}

Node Graph::divide(Node a, Node b) {
  if (is_constant(a) && is_constant(b)) return constant(value(a) / value(b));
  if (is_constant(b) && value(b) != 0) return scaled(a, 1 / value(b));
  return pair(Op::Div, a, b);
}

Node Graph::power(Node a, Node b) {
  if (is(b, 1)) return a;
  if (is(b, 2)) return multiply(a, a);
  return pair(Op::Pow, a, b);
}

Node Graph::apply(Op function, Node a) {
  a = as_number(a);
  return is_constant(a) ? constant(folded(function, value(a)))
                        : made({.op = function, .inputs = {a}});
}

/// Whether a node is one of two constants.
bool Graph::is_choice(Node node) const {
  return at(node).op == Op::Where && is_constant(at(node).inputs[1]) &&
         is_constant(at(node).inputs[2]);
}

Node Graph::compare(Op op, Node a, Node b) {
  a = as_number(a);
  b = as_number(b);
  if (is_constant(a) && is_constant(b)) return truth(folded(op, value(a), value(b)) != 0);

  // A choice of two constants beside a constant is decided by what chooses.
  for (const bool first : {true, false}) {
    const Node choice = first ? a : b, other = first ? b : a;
    if (!is_choice(choice) || !is_constant(other)) continue;
    const std::vector<Node> parts = at(choice).inputs;
    const Node yes = first ? compare(op, parts[1], other) : compare(op, other, parts[1]);
    const Node no = first ? compare(op, parts[2], other) : compare(op, other, parts[2]);
    return where(parts[0], yes, no);
  }
  return made({.op = op, .inputs = {a, b}, .is_truth = true});
}

/// Whether `one` is among those of which `all` is made by And.
bool Graph::implies(Node all, Node one) const {
  if (all == one) return true;
  const NodeData& data = at(all);
  return data.op == Op::And && (implies(data.inputs[0], one) || implies(data.inputs[1], one));
}

Node Graph::both(Node a, Node b) {
  if (is_constant(a)) return value(a) != 0 ? b : a;
  if (is_constant(b)) return value(b) != 0 ? a : b;
  if (implies(a, b)) return a;
  if (implies(b, a)) return b;
  if (implies(a, opposite(b)) || implies(b, opposite(a))) return truth(false);
  return made({.op = Op::And, .inputs = {a, b}, .is_truth = true});
}

Node Graph::either(Node a, Node b) {
  if (is_constant(a)) return value(a) != 0 ? a : b;
  if (is_constant(b)) return value(b) != 0 ? b : a;
  if (a == b || implies(b, a)) return a;
  if (implies(a, b)) return b;
  if (a == opposite(b)) return truth(true);
  return made({.op = Op::Or, .inputs = {std::min(a, b), std::max(a, b)}, .is_truth = true});
}

Node Graph::opposite(Node a) {
  if (is_constant(a)) return truth(value(a) == 0);
  if (at(a).op == Op::Not) return at(a).inputs[0];
  return made({.op = Op::Not, .inputs = {a}, .is_truth = true});
}

Node Graph::where(Node condition, Node yes, Node no) {
  if (is_constant(condition)) return value(condition) != 0 ? yes : no;
  if (yes == no) return yes;

  // Truths are combined as such.
  if (at(yes).is_truth && at(no).is_truth)
    return either(both(condition, yes), both(opposite(condition), no));

  // Numbers: without a negation, and without a choice that the same condition has made already.
  yes = as_number(yes);
  no = as_number(no);
  if (at(condition).op == Op::Not) {
    std::swap(yes, no);
    condition = at(condition).inputs[0];
  }
  if (at(yes).op == Op::Where && at(yes).inputs[0] == condition) yes = at(yes).inputs[1];
  if (at(no).op == Op::Where && at(no).inputs[0] == condition) no = at(no).inputs[2];
  if (yes == no) return yes;
  return made({.op = Op::Where, .inputs = {condition, yes, no}});
}

Node Graph::as_number(Node a) {
  if (!at(a).is_truth) return a;
  return is_constant(a) ? constant(value(a)) : where(a, constant(1), constant(0));
}

Node Graph::as_truth(Node a) { return at(a).is_truth ? a : opposite(equal(a, constant(0))); }

std::size_t Graph::begin_loop(std::vector<Node> starts, std::size_t within) {
  const std::size_t loop = loops_.size();
  loops_.push_back({.within = within, .starts = std::move(starts)});
  for (std::size_t k = 0; k < loops_[loop].starts.size(); ++k) {
    const bool is_truth = at(loops_[loop].starts[k]).is_truth;
    loops_[loop].carried.push_back(made({.op = Op::Carried,
                                         .numbers = {static_cast<double>(k)},
                                         .region = loop,
                                         .loop = loop,
                                         .is_truth = is_truth}));
  }
  return loop;
}

Node Graph::result(std::size_t loop, std::size_t which) {
  const bool is_truth = at(loops_[loop].carried[which]).is_truth;
  return made({.op = Op::Result,
               .numbers = {static_cast<double>(which)},
               .region = loops_[loop].within,
               .loop = loop,
               .is_truth = is_truth});
}

}  // namespace dashpot::trace
