#include "dashpot/export/onnx/onnx_graph.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>

#include "dashpot/base/text.h"
#include "dashpot/export/onnx/live_nodes.h"

namespace dashpot::trace {
namespace {

using Names = std::vector<std::string>;
using Nodes = std::vector<Node>;

/// Sums of so many terms or fewer are written term by term where no other has the same terms.
constexpr std::size_t kFewTerms = 3;
constexpr const char* kBatch = "batch_shape";

std::string_view operator_of(Op op) {
  constexpr std::array<std::string_view, 24> kNames{
      "",      "",      "",     "Mul",         "Div",   "Pow", "Min",  "Max",
      "Exp",   "Log",   "Sqrt", "Abs",         "Tanh",  "Sin", "Atan", "Ceil",
      "Floor", "Where", "Less", "LessOrEqual", "Equal", "And", "Or",   "Not"};
  return kNames[static_cast<std::size_t>(op)];
}

class Writer {
 public:
  Writer(const Graph& graph, const LiveNodes& live, OnnxType type)
      : graph_(graph), live_(live), type_(type) {}

  OnnxGraph write(const std::vector<OnnxFace>& inputs, const std::vector<OnnxFace>& outputs) {
    OnnxGraph out{.name = "step"};
    for (const OnnxFace& input : inputs) {
      place(input.columns, input.name);
      out.inputs.push_back(
          {input.name, type_, static_cast<std::int64_t>(input.columns.size()), input.meaning});
    }
    open(out);
    first_input_ = inputs.at(0).name;
    write_region(0);
    for (const OnnxFace& output : outputs) {
      emit("Identity", {packed(output.columns)}, output.name);
      out.outputs.push_back(
          {output.name, type_, static_cast<std::int64_t>(output.columns.size()), output.meaning});
    }
    close();
    out.constants = std::move(constants_);
    return out;
  }

 private:
  struct Place {
    std::string tensor;
    std::size_t column = 0;
  };
  struct Scope {
    OnnxGraph* graph;
    std::map<std::string, std::string> columns;  ///< chosen from tensors before
  };

  // Scopes and names.

  void open(OnnxGraph& graph) { scopes_.push_back({&graph, {}}); }
  void close() { scopes_.pop_back(); }
  std::string fresh(std::string_view stem) {
    return std::string(stem) + '_' + std::to_string(++count_);
  }

  std::string emit(std::string_view op, Names inputs, std::string output = {},
                   std::vector<std::pair<std::string, std::int64_t>> attributes = {}) {
    if (output.empty()) output = fresh(op);
    scopes_.back().graph->nodes.push_back(
        {std::string(op), std::move(inputs), {output}, std::move(attributes), {}});
    return output;
  }

  void place(const Nodes& nodes, const std::string& tensor) {
    for (std::size_t k = 0; k < nodes.size(); ++k) places_[nodes[k]] = {tensor, k};
    widths_[tensor] = nodes.size();
  }

  std::string constant(OnnxType type, std::vector<std::int64_t> shape, std::vector<double> values) {
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

  // Tensors made of nodes.

  bool is_constant(Node node) const { return graph_.is_constant(node); }
  /// Where it stands; '#' for a constant.
  std::string source(Node node) const { return is_constant(node) ? "#" : places_.at(node).tensor; }

  std::string constants(const Nodes& nodes) {
    std::vector<double> values;
    for (const Node node : nodes) values.push_back(graph_.value(node));
    if (std::ranges::all_of(values, [&](double value) { return value == values[0]; }))
      values.resize(1);
    const OnnxType type = graph_.at(nodes[0]).is_truth ? OnnxType::Bool : type_;
    const auto width = static_cast<std::int64_t>(values.size());
    return constant(type, {1, width}, std::move(values));
  }

  std::string chosen(const std::string& tensor, const std::vector<double>& columns) {
    if (columns.size() == widths_.at(tensor)) {
      std::size_t k = 0;
      while (k < columns.size() && columns[k] == static_cast<double>(k)) ++k;
      if (k == columns.size()) return tensor;
    }
    std::string key = tensor;
    for (const double column : columns) key += ' ' + format_exact(column);
    for (const Scope& scope : scopes_)
      if (const auto known = scope.columns.find(key); known != scope.columns.end())
        return known->second;
    const std::string which =
        constant(OnnxType::Int64, {static_cast<std::int64_t>(columns.size())}, columns);
    return scopes_.back().columns[key] = emit("Gather", {tensor, which}, {}, {{"axis", 1}});
  }

  /// Nodes of one tensor, or constants: one column where all are the same.
  std::string operand(const Nodes& nodes) {
    if (is_constant(nodes[0])) return constants(nodes);
    std::vector<double> columns;
    for (const Node node : nodes) columns.push_back(static_cast<double>(places_.at(node).column));
    if (std::ranges::all_of(nodes, [&](Node node) { return node == nodes[0]; })) columns.resize(1);
    return chosen(places_.at(nodes[0]).tensor, columns);
  }

  /// [batch, nodes], wherever they stand.
  std::string packed(const Nodes& nodes) {
    std::vector<Nodes> runs;  // of nodes that stand in the same tensor
    std::set<std::string> tensors;
    for (const Node node : nodes) {
      if (runs.empty() || source(node) != source(runs.back().back())) runs.emplace_back();
      runs.back().push_back(node);
      tensors.insert(source(node));
    }
    if (runs.size() > tensors.size() + 1) return reordered(nodes);
    Names parts;
    for (const Nodes& run : runs)
      parts.push_back(is_constant(run[0]) ? spread(run) : columns_of(source(run[0]), run));
    return parts.size() == 1 ? parts[0] : emit("Concat", parts, {}, {{"axis", 1}});
  }

  /// The same: put together tensor by tensor first.
  std::string reordered(const Nodes& nodes) {
    std::vector<std::size_t> order(nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t k) { return source(nodes[k]); });
    Nodes sorted;
    std::vector<double> columns(nodes.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      sorted.push_back(nodes[order[k]]);
      columns[order[k]] = static_cast<double>(k);
    }
    const auto count = static_cast<std::int64_t>(nodes.size());
    return emit("Gather", {packed(sorted), constant(OnnxType::Int64, {count}, std::move(columns))},
                {}, {{"axis", 1}});
  }

  std::string columns_of(const std::string& tensor, const Nodes& nodes) {
    std::vector<double> columns;
    for (const Node node : nodes) columns.push_back(static_cast<double>(places_.at(node).column));
    return chosen(tensor, columns);
  }

  /// Constants in every lane.
  std::string spread(const Nodes& nodes) {
    std::vector<double> values;
    for (const Node node : nodes) values.push_back(graph_.value(node));
    const auto width = static_cast<std::int64_t>(nodes.size());
    const OnnxType type = graph_.at(nodes[0]).is_truth ? OnnxType::Bool : type_;
    return emit("Expand", {constant(type, {1, width}, std::move(values)), batch_shape()});
  }

  /// [batch, 1]: made before all else, once, where it is needed.
  std::string batch_shape() {
    if (has_batch_shape_) return kBatch;
    has_batch_shape_ = true;
    std::vector<OnnxNode> made{{"Shape", {first_input_}, {kBatch}, {}, {}}};
    if (widths_.at(first_input_) > 1) {
      const std::string first = constant(OnnxType::Int64, {1}, {0});
      made[0].inputs = {"first_column"};
      made.insert(made.begin(),
                  {"Gather", {first_input_, first}, {"first_column"}, {{"axis", 1}}, {}});
    }
    std::vector<OnnxNode>& nodes = scopes_.front().graph->nodes;
    nodes.insert(nodes.begin(), made.begin(), made.end());
    return kBatch;
  }

  // Groups of nodes.

  void write_region(std::size_t region) {
    for (const auto& [level, nodes] : live_.by_level(region)) {
      for (const auto& [key, group] : groups(nodes)) write_group(group);
    }
  }

  std::map<std::string, Nodes> groups(const Nodes& nodes) const {
    std::map<std::string, Nodes> same_terms, out;
    for (const Node node : nodes) {
      if (graph_.at(node).op == Op::Affine)
        same_terms[terms_key(node)].push_back(node);
      else
        out[key_of(node)].push_back(node);
    }
    for (auto& [key, group] : same_terms) {
      Nodes& to = group.size() > 1 || graph_.at(group[0]).inputs.size() > kFewTerms
                      ? out["Gemm " + key]
                      : out[key_of(group[0])];
      to.insert(to.end(), group.begin(), group.end());
    }
    return out;
  }

  std::string terms_key(Node node) const {
    std::string key;
    for (const Node input : graph_.at(node).inputs) key += std::to_string(input) + ' ';
    return key;
  }

  /// Nodes with the same key are made alike, of columns of the same tensors.
  std::string key_of(Node node) const {
    const NodeData& data = graph_.at(node);
    std::string key = std::to_string(static_cast<int>(data.op)) + ' ' + std::to_string(data.loop);
    for (const Node input : data.inputs) key += ' ' + source(input);
    return key;
  }

  void write_group(const Nodes& group) {
    const NodeData& first = graph_.at(group[0]);
    if (first.op == Op::Result) return write_loop(group);
    if (first.op == Op::Affine) {
      const bool is_same = group.size() > 1 && terms_key(group[0]) == terms_key(group[1]);
      return place(group, is_same || first.inputs.size() > kFewTerms ? product(group) : sum(group));
    }
    Names operands;
    for (std::size_t k = 0; k < first.inputs.size(); ++k)
      operands.push_back(operand(inputs_of(group, k)));
    if (first.op == Op::Atan) return place(group, in_single("Atan", operands[0]));
    place(group, emit(operator_of(first.op), operands));
  }

  std::string in_single(std::string_view op, const std::string& of) {
    if (type_ == OnnxType::Float) return emit(op, {of});
    return cast(emit(op, {cast(of, OnnxType::Float)}), type_);
  }

  std::string cast(const std::string& of, OnnxType type) {
    return emit("Cast", {of}, {}, {{"to", static_cast<std::int64_t>(type)}});
  }

  Nodes inputs_of(const Nodes& group, std::size_t which) const {
    Nodes out;
    for (const Node node : group) out.push_back(graph_.at(node).inputs[which]);
    return out;
  }

  std::vector<double> numbers_of(const Nodes& group, std::size_t which) const {
    std::vector<double> out;
    for (const Node node : group) out.push_back(graph_.at(node).numbers[which]);
    return out;
  }

  std::string row(const std::vector<double>& values) {
    return constant(type_, {1, static_cast<std::int64_t>(values.size())}, values);
  }

  /// Sums of multiples of the same nodes.
  std::string product(const Nodes& group) {
    const Nodes& terms = graph_.at(group[0]).inputs;
    std::vector<std::size_t> order(terms.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](std::size_t k) {
      const Place& at = places_.at(terms[k]);
      return std::pair(at.tensor, at.column);
    });
    Nodes sorted;
    std::vector<double> factors;
    for (const std::size_t k : order) {
      sorted.push_back(terms[k]);
      const std::vector<double> of_term = numbers_of(group, k);
      factors.insert(factors.end(), of_term.begin(), of_term.end());
    }
    const auto height = static_cast<std::int64_t>(terms.size()),
               width = static_cast<std::int64_t>(group.size());
    Names inputs{packed(sorted), constant(type_, {height, width}, std::move(factors))};
    const std::vector<double> rest = numbers_of(group, terms.size());
    if (std::ranges::any_of(rest, [](double value) { return value != 0; }))
      inputs.push_back(row(rest));
    return emit("Gemm", inputs);
  }

  /// Sums of a few multiples, term by term.
  std::string sum(const Nodes& group) {
    const std::size_t terms = graph_.at(group[0]).inputs.size();
    std::string out;
    for (std::size_t k = 0; k < terms; ++k) {
      const std::vector<double> factors = numbers_of(group, k);
      const auto all = [&](double value) {
        return std::ranges::all_of(factors, [&](double factor) { return factor == value; });
      };
      const std::string column = operand(inputs_of(group, k));
      const bool is_less = !out.empty() && all(-1);
      const std::string term = all(1) || is_less ? column : emit("Mul", {column, row(factors)});
      out = out.empty() ? term : emit(is_less ? "Sub" : "Add", {out, term});
    }
    const std::vector<double> rest = numbers_of(group, terms);
    const bool is_whole = std::ranges::all_of(rest, [](double value) { return value == 0; });
    return is_whole ? out : emit("Add", {out, row(rest)});
  }

  // Loops.

  std::string any(const std::string& truths) {
    const std::string largest =
        emit("ReduceMax", {cast(truths, OnnxType::Float)}, {}, {{"keepdims", 0}});
    return emit("Greater", {largest, constant(OnnxType::Float, {}, {0.5})});
  }

  void write_loop(const Nodes& results) {
    const std::size_t which = graph_.at(results[0]).loop;
    const Loop& loop = graph_.loop(which);
    Nodes starts, carried, ends;
    const std::vector<std::size_t> alive = live_.carried(which);
    for (const std::size_t k : alive) {
      starts.push_back(loop.starts[k]);
      carried.push_back(loop.carried[k]);
      ends.push_back(loop.ends[k]);
    }
    const std::string going = packed({loop.starts[0]}), name = fresh("loop");
    const Names inputs{"", any(going), going, packed(starts)};
    auto body = std::make_shared<OnnxGraph>();
    body->name = name;
    const auto width = static_cast<std::int64_t>(carried.size());
    body->inputs = {{name + "_round", OnnxType::Int64, 0},
                    {name + "_any", OnnxType::Bool, 0},
                    {name + "_lanes", OnnxType::Bool, 1},
                    {name + "_carried", type_, width}};
    place({loop.carried[0]}, name + "_lanes");
    place(carried, name + "_carried");
    open(*body);
    write_region(which);
    const std::string goes_on = emit("Identity", {packed({loop.ends[0]})}, name + "_lanes_after");
    emit("Identity", {any(goes_on)}, name + "_any_after");
    emit("Identity", {packed(ends)}, name + "_carried_after");
    body->outputs = {{name + "_any_after", OnnxType::Bool, 0},
                     {name + "_lanes_after", OnnxType::Bool, 1},
                     {name + "_carried_after", type_, width}};
    close();
    scopes_.back().graph->nodes.push_back(
        {"Loop", inputs, {name + "_lanes_end", name + "_end"}, {}, body});
    widths_[name + "_end"] = carried.size();
    for (const Node result : results) {
      const auto k =
          std::ranges::find(alive, static_cast<std::size_t>(graph_.at(result).numbers[0]));
      places_[result] = {name + "_end", static_cast<std::size_t>(k - alive.begin())};
    }
  }

  const Graph& graph_;
  const LiveNodes& live_;
  const OnnxType type_;
  std::vector<Scope> scopes_;
  std::map<Node, Place> places_;
  std::map<std::string, std::size_t> widths_;
  std::map<std::string, std::string> constant_names_;
  std::vector<OnnxTensor> constants_;
  std::size_t count_ = 0;
  std::string first_input_;
  bool has_batch_shape_ = false;
};

}  // namespace

OnnxGraph onnx_graph(const Graph& graph, const std::vector<OnnxFace>& inputs,
                     const std::vector<OnnxFace>& outputs, OnnxType type) {
  Nodes all;
  for (const OnnxFace& output : outputs)
    all.insert(all.end(), output.columns.begin(), output.columns.end());
  const LiveNodes live(graph, all);
  return Writer(graph, live, type).write(inputs, outputs);
}

}  // namespace dashpot::trace
