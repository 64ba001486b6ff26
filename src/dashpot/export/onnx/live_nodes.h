#pragma once
#include <map>
#include <vector>

#include "dashpot/export/onnx/graph.h"

namespace dashpot::trace {

/// The nodes that some outputs need, in groups whose members do not need each other.
class LiveNodes {
 public:
  LiveNodes(const Graph& graph, const std::vector<Node>& outputs);

  bool has(Node node) const { return is_live_[node]; }
  /// The numbers of the values that a loop carries and something needs, without the truth that it
  /// goes on.
  std::vector<std::size_t> carried(std::size_t loop) const;
  /// The nodes computed in this loop (0: in none) by how many steps lie before them; without
  /// constants, inputs and what is carried, which are given.
  std::map<std::size_t, std::vector<Node>> by_level(std::size_t region) const;

 private:
  void mark(Node node);
  void collect_needs();
  void need(Node node, std::size_t region);
  bool is_given(Node node) const;

  const Graph& graph_;
  std::vector<bool> is_live_;
  std::vector<std::vector<Node>> needs_;  ///< by loop: what it takes from outside
};

}  // namespace dashpot::trace
