#include "dashpot/export/onnx/live_nodes.h"

#include <algorithm>

namespace dashpot::trace {

LiveNodes::LiveNodes(const Graph& graph, const std::vector<Node>& outputs)
    : graph_(graph), is_live_(graph.size()), needs_(graph.loop_count()) {
  for (const Node output : outputs) mark(output);
  collect_needs();
}

void LiveNodes::mark(Node first) {
  std::vector<Node> open{first};
  while (!open.empty()) {
    const Node node = open.back();
    open.pop_back();
    if (is_live_[node]) continue;
    is_live_[node] = true;

    // Its operands; for a value of a loop also how that begins, goes on and ends.
    const NodeData& data = graph_.at(node);
    open.insert(open.end(), data.inputs.begin(), data.inputs.end());
    if (data.op != Op::Result && data.op != Op::Carried) continue;
    const Loop& loop = graph_.loop(data.loop);
    for (const std::size_t which : {std::size_t{0}, static_cast<std::size_t>(data.numbers[0])})
      open.insert(open.end(), {loop.carried[which], loop.starts[which], loop.ends[which]});
  }
}

std::vector<std::size_t> LiveNodes::carried(std::size_t loop) const {
  std::vector<std::size_t> out;
  for (std::size_t k = 1; k < graph_.loop(loop).carried.size(); ++k)
    if (has(graph_.loop(loop).carried[k])) out.push_back(k);
  return out;
}

bool LiveNodes::is_given(Node node) const {
  const Op op = graph_.at(node).op;
  return op == Op::Constant || op == Op::Input || op == Op::Carried;
}

/// Every loop from `region` outwards takes the node from outside, up to where it is computed.
void LiveNodes::need(Node node, std::size_t region) {
  for (; region != graph_.at(node).region; region = graph_.loop(region).within)
    needs_[region].push_back(node);
}

void LiveNodes::collect_needs() {
  for (Node node = 0; node < is_live_.size(); ++node) {
    if (!has(node)) continue;
    const NodeData& data = graph_.at(node);
    if (is_given(node) && data.op != Op::Carried) continue;

    // Its operands, and for what a loop carries how that begins and ends.
    for (const Node input : data.inputs)
      if (graph_.at(input).op != Op::Constant) need(input, data.region);
    if (data.op != Op::Carried) continue;
    const Loop& loop = graph_.loop(data.loop);
    const auto which = static_cast<std::size_t>(data.numbers[0]);
    for (const Node end : {loop.ends[which], loop.starts[which]})
      if (graph_.at(end).op != Op::Constant) need(end, data.loop);
  }
}

std::map<std::size_t, std::vector<Node>> LiveNodes::by_level(std::size_t region) const {
  std::map<std::size_t, std::vector<Node>> levels;
  std::vector<std::size_t> level(is_live_.size());
  // A node stands behind all that it is made of.
  for (Node node = 0; node < is_live_.size(); ++node) {
    const NodeData& data = graph_.at(node);
    if (!has(node) || data.region != region || is_given(node)) continue;
    const std::vector<Node>& sources = data.op == Op::Result ? needs_[data.loop] : data.inputs;
    for (const Node source : sources)
      if (graph_.at(source).region == region)
        level[node] = std::max(level[node], level[source] + 1);
    levels[level[node]].push_back(node);
  }
  return levels;
}

}  // namespace dashpot::trace
