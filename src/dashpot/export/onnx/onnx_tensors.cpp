#include "dashpot/export/onnx/onnx_tensors.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

#include "dashpot/base/text.h"

namespace dashpot::trace {
namespace {

constexpr const char* kBatchShape = "batch_shape";

}  // namespace

std::string OnnxTensors::emit(std::string_view op, Names inputs, std::string output,
                              Attributes attributes) {
  if (output.empty()) output = fresh(op);
  add({std::string(op), std::move(inputs), {output}, std::move(attributes), {}});
  return output;
}

std::string OnnxTensors::cast(const std::string& tensor, OnnxType type) {
  return emit("Cast", {tensor}, {}, {{"to", static_cast<std::int64_t>(type)}});
}

std::string OnnxTensors::fresh(std::string_view stem) {
  return std::string(stem) + '_' + std::to_string(++count_);
}

void OnnxTensors::place(const Nodes& nodes, const std::string& tensor) {
  for (std::size_t k = 0; k < nodes.size(); ++k) place(nodes[k], tensor, k);
  set_width(tensor, nodes.size());
}

std::string OnnxTensors::source(Node node) const {
  return graph_.is_constant(node) ? "#" : places_.at(node).tensor;
}

bool OnnxTensors::stands_before(Node a, Node b) const {
  const Place &left = places_.at(a), &right = places_.at(b);
  return std::tie(left.tensor, left.column) < std::tie(right.tensor, right.column);
}

std::string OnnxTensors::constant(OnnxType type, std::vector<std::int64_t> shape,
                                  std::vector<double> values) {
  // Exact digits as a key: what is the same to the last bit stands there once.
  std::string key = std::to_string(static_cast<int>(type)) + ':';
  for (const std::int64_t size : shape) key += std::to_string(size) + ',';
  for (const double value : values) key += ' ' + format_exact(value);

  std::string& name = constant_names_[key];
  if (name.empty()) {
    name = "constant_" + std::to_string(constants_.size());
    constants_.push_back({name, type, std::move(shape), std::move(values)});
  }
  return name;
}

std::string OnnxTensors::row(const std::vector<double>& values) {
  return constant(type_, {1, size_of(values)}, values);
}

/// Constants as an operand, which need no column per lane of the batch.
std::string OnnxTensors::constants_of(const Nodes& nodes) {
  std::vector<double> values;
  for (const Node node : nodes) values.push_back(graph_.value(node));
  if (std::ranges::all_of(values, [&](double value) { return value == values[0]; }))
    values.resize(1);
  const OnnxType type = graph_.at(nodes[0]).is_truth ? OnnxType::Bool : type_;
  const std::int64_t width = size_of(values);
  return constant(type, {1, width}, std::move(values));
}

/// These columns of a tensor: itself where they are all of it in their order.
std::string OnnxTensors::gathered(const std::string& tensor, const std::vector<double>& columns) {
  if (columns.size() == widths_.at(tensor)) {
    std::size_t k = 0;
    while (k < columns.size() && columns[k] == static_cast<double>(k)) ++k;
    if (k == columns.size()) return tensor;
  }

  // Columns that were gathered before, here or in a graph around this one, are taken again.
  std::string key = tensor;
  for (const double column : columns) key += ' ' + format_exact(column);
  for (const Scope& scope : scopes_)
    if (const auto known = scope.columns.find(key); known != scope.columns.end())
      return known->second;

  const std::string which = constant(OnnxType::Int64, {size_of(columns)}, columns);
  return scopes_.back().columns[key] = emit("Gather", {tensor, which}, {}, {{"axis", 1}});
}

std::string OnnxTensors::operand(const Nodes& nodes) {
  if (graph_.is_constant(nodes[0])) return constants_of(nodes);
  const bool all_same = std::ranges::all_of(nodes, [&](Node node) { return node == nodes[0]; });
  return columns_of(all_same ? Nodes{nodes[0]} : nodes);
}

/// Columns of one tensor.
std::string OnnxTensors::columns_of(const Nodes& nodes) {
  std::vector<double> columns;
  for (const Node node : nodes) columns.push_back(static_cast<double>(places_.at(node).column));
  return gathered(places_.at(nodes[0]).tensor, columns);
}

std::string OnnxTensors::packed(const Nodes& nodes) {
  // Cut the list into runs of nodes that stand in the same tensor.
  std::vector<Nodes> runs;
  std::set<std::string> tensors;
  for (const Node node : nodes) {
    if (runs.empty() || source(node) != source(runs.back().back())) runs.emplace_back();
    runs.back().push_back(node);
    tensors.insert(source(node));
  }

  // One part per run, unless the list goes back and forth between tensors.
  if (runs.size() > tensors.size() + 1) return reordered(nodes);
  Names parts;
  for (const Nodes& run : runs)
    parts.push_back(graph_.is_constant(run[0]) ? spread(run) : columns_of(run));
  return parts.size() == 1 ? parts[0] : emit("Concat", parts, {}, {{"axis", 1}});
}

/// The same as packed(): put together tensor by tensor first, then brought into the order asked
/// for.
std::string OnnxTensors::reordered(const Nodes& nodes) {
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return source(nodes[k]); });

  Nodes sorted;
  std::vector<double> columns(nodes.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    sorted.push_back(nodes[order[k]]);
    columns[order[k]] = static_cast<double>(k);
  }
  const std::string all = packed(sorted);
  const std::string which = constant(OnnxType::Int64, {size_of(nodes)}, std::move(columns));
  return emit("Gather", {all, which}, {}, {{"axis", 1}});
}

/// Constants as columns, in every lane of the batch.
std::string OnnxTensors::spread(const Nodes& nodes) {
  std::vector<double> values;
  for (const Node node : nodes) values.push_back(graph_.value(node));
  const OnnxType type = graph_.at(nodes[0]).is_truth ? OnnxType::Bool : type_;
  const std::string one = constant(type, {1, size_of(nodes)}, std::move(values));
  return emit("Expand", {one, batch_shape()});
}

/// The shape [batch, 1], made where it is first needed, in front of all else so that loops see it,
/// too.
std::string OnnxTensors::batch_shape() {
  if (has_batch_shape_) return kBatchShape;
  has_batch_shape_ = true;

  std::vector<OnnxNode> made{{"Shape", {first_input_}, {kBatchShape}, {}, {}}};
  if (widths_.at(first_input_) > 1) {
    const std::string first = constant(OnnxType::Int64, {1}, {0});
    made[0].inputs = {"first_column"};
    made.insert(made.begin(),
                {"Gather", {first_input_, first}, {"first_column"}, {{"axis", 1}}, {}});
  }
  std::vector<OnnxNode>& nodes = scopes_.front().graph->nodes;
  nodes.insert(nodes.begin(), made.begin(), made.end());
  return kBatchShape;
}

}  // namespace dashpot::trace
