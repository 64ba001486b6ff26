#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace dashpot::trace {

/// A number or a truth that a Graph computes: its place among the nodes.
using Node = std::uint32_t;

enum class Op {
  Constant,
  Input,   ///< numbers: one, which
  Affine,  ///< numbers: a factor per input, then what is added
  Mul,
  Div,
  Pow,
  Min,
  Max,
  Exp,
  Log,
  Sqrt,
  Abs,
  Tanh,
  Sin,
  Atan,
  Ceil,
  Floor,
  Where,  ///< a truth, then the numbers where it holds and where not
  Less,   ///< a truth, as those behind it
  LessOrEqual,
  Equal,
  And,
  Or,
  Not,
  Carried,  ///< inside a loop: what it carries; numbers: which
  Result    ///< of a loop: what that has become in the end
};

struct NodeData {
  Op op = Op::Constant;
  std::vector<Node> inputs;
  std::vector<double> numbers;
  std::size_t region = 0;  ///< the innermost loop that it is computed in; 0: none
  std::size_t loop = 0;    ///< of Carried and Result
  bool is_truth = false;
};

/// A loop that goes on while its first carried value, a truth, holds: then what is carried goes
/// from `starts` (for the first time) or the last `ends` through the loop.
struct Loop {
  std::size_t within = 0;  ///< the loop around it; 0: none
  std::vector<Node> starts, carried, ends;
};

/// A calculation as nodes: constants are folded in double precision, sums of multiples are one
/// node, and what is the same is there once. A node stands behind all that it is made of.
class Graph {
 public:
  /// `is_single`: the graph will be computed in single precision; constants are folded in double
  /// precision all the same.
  explicit Graph(bool is_single) : is_single_(is_single) { loops_.emplace_back(); }

  Node constant(double value);
  Node truth(bool value);
  Node input(std::size_t which);

  Node add(Node a, Node b) { return sum(a, 1, b, 1); }
  Node subtract(Node a, Node b) { return sum(a, 1, b, -1); }
  Node scaled(Node a, double factor) { return sum(a, factor, a, 0); }
  Node multiply(Node a, Node b);
  Node divide(Node a, Node b);
  Node power(Node a, Node b);
  Node least(Node a, Node b) { return pair(Op::Min, a, b); }
  Node most(Node a, Node b) { return pair(Op::Max, a, b); }
  Node apply(Op function, Node a);
  Node less(Node a, Node b) { return compare(Op::Less, a, b); }
  Node less_or_equal(Node a, Node b) { return compare(Op::LessOrEqual, a, b); }
  Node equal(Node a, Node b) { return compare(Op::Equal, a, b); }
  Node both(Node a, Node b);
  Node either(Node a, Node b);
  Node opposite(Node a);
  /// Both numbers or both truths.
  Node where(Node condition, Node yes, Node no);

  /// 1 or 0 for a truth.
  Node as_number(Node a);
  /// Whether a number is not 0.
  Node as_truth(Node a);

  /// A new loop within the loop `within` (0: none); its number. Its body is made of the nodes
  /// loop(number).carried, and finished by end_loop.
  std::size_t begin_loop(std::vector<Node> starts, std::size_t within);
  void end_loop(std::size_t loop, std::vector<Node> ends) { loops_[loop].ends = std::move(ends); }
  /// The carried value `which` behind the loop.
  Node result(std::size_t loop, std::size_t which);

  bool is_single() const { return is_single_; }
  const NodeData& at(Node node) const { return nodes_[node]; }
  const Loop& loop(std::size_t which) const { return loops_[which]; }
  bool is_constant(Node node) const { return at(node).op == Op::Constant; }
  double value(Node node) const { return at(node).numbers[0]; }
  bool is(Node node, double value) const {
    return is_constant(node) && at(node).numbers[0] == value;
  }
  std::size_t size() const { return nodes_.size(); }
  std::size_t loop_count() const { return loops_.size(); }

 private:
  Node made(NodeData data);
  Node sum(Node a, double factor_a, Node b, double factor_b);
  Node pair(Op op, Node a, Node b);
  Node compare(Op op, Node a, Node b);
  bool is_choice(Node node) const;
  bool implies(Node all, Node one) const;

  bool is_single_;
  std::vector<NodeData> nodes_;
  std::vector<Loop> loops_;  ///< the first stands for none
  std::unordered_map<std::string, Node> known_;
};

}  // namespace dashpot::trace
