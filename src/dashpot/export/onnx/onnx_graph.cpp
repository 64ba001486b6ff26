#include "dashpot/export/onnx/onnx_graph.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "dashpot/export/onnx/live_nodes.h"
#include "dashpot/export/onnx/onnx_tensors.h"

namespace dashpot::trace {
namespace {

using Names = OnnxTensors::Names;
using Nodes = OnnxTensors::Nodes;

/// Sums of so many terms or fewer are written term by term where no other sum has the same terms;
/// larger ones become a product with a matrix.
constexpr std::size_t kFewTerms = 3;

/// The operator of ONNX, by Op; empty for those that are no operator of their own.
constexpr std::array<std::string_view, 26> kOperators{
    "",      "",    "",     "Mul", "Div",  "Pow",  "Min",   "Max",   "Exp",  "Log",
    "Sqrt",  "Abs", "Tanh", "Sin", "Atan", "Ceil", "Floor", "Where", "Less", "LessOrEqual",
    "Equal", "And", "Or",   "Not", "",     ""};
static_assert(kOperators.size() == static_cast<std::size_t>(Op::Result) + 1);
static_assert(kOperators[static_cast<std::size_t>(Op::Not)] == "Not");

std::string_view operator_of(Op op) { return kOperators[static_cast<std::size_t>(op)]; }

bool all_are(const std::vector<double>& values, double value) {
  return std::ranges::all_of(values, [&](double each) { return each == value; });
}

/// Writes the nodes that are needed, region by region (the step itself, then each loop where its
/// results are due), level by level, group by group.
class Writer {
 public:
  Writer(const Graph& graph, const LiveNodes& live, OnnxType type, const std::string& first_input)
      : graph_(graph), live_(live), tensors_(graph, type, first_input) {}

  OnnxGraph write(const std::vector<OnnxFace>& inputs, const std::vector<OnnxFace>& outputs) {
    OnnxGraph out{.name = "step"};
    for (const OnnxFace& input : inputs) {
      tensors_.place(input.columns, input.name);
      out.inputs.push_back({input.name, tensors_.type(), size_of(input.columns), input.meaning});
    }

    tensors_.open(out);
    write_region(0);
    for (const OnnxFace& output : outputs) {
      tensors_.emit("Identity", {tensors_.packed(output.columns)}, output.name);
      out.outputs.push_back(
          {output.name, tensors_.type(), size_of(output.columns), output.meaning});
    }
    tensors_.close();
    out.constants = tensors_.take_constants();
    return out;
  }

 private:
  // Groups of nodes that become one operator.

  /// `region`: a loop's number; 0: the step itself.
  void write_region(std::size_t region) {
    for (const auto& [level, nodes] : live_.by_level(region))
      for (const auto& [key, group] : groups(nodes)) write_group(group);
  }

  /// Nodes of one level by what they share. They do not need each other.
  std::map<std::string, Nodes> groups(const Nodes& nodes) const {
    std::map<std::string, Nodes> same_terms, out;
    for (const Node node : nodes) {
      if (graph_.at(node).op == Op::Affine)
        same_terms[terms_key(node)].push_back(node);
      else
        out[key_of(node)].push_back(node);
    }

    // Sums of the same terms, or of many, become a Gemm; the rest is written term by term.
    for (auto& [key, group] : same_terms) {
      const bool is_product = group.size() > 1 || graph_.at(group[0]).inputs.size() > kFewTerms;
      Nodes& to = is_product ? out["Gemm " + key] : out[key_of(group[0])];
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
    for (const Node input : data.inputs) key += ' ' + tensors_.source(input);
    return key;
  }

  void write_group(const Nodes& group) {
    const NodeData& first = graph_.at(group[0]);
    if (first.op == Op::Result) return write_loop(group);
    if (first.op == Op::Affine) {
      const bool same_terms = group.size() > 1 && terms_key(group[0]) == terms_key(group[1]);
      const bool is_product = same_terms || first.inputs.size() > kFewTerms;
      return tensors_.place(group, is_product ? product(group) : sum(group));
    }

    // Any other operator takes its operands one by one, each with a column per node.
    Names operands;
    for (std::size_t k = 0; k < first.inputs.size(); ++k)
      operands.push_back(tensors_.operand(inputs_of(group, k)));
    tensors_.place(group, first.op == Op::Atan ? arc_tangent(operands[0])
                                               : tensors_.emit(operator_of(first.op), operands));
  }

  /// ONNX Runtime has it in single precision only.
  std::string arc_tangent(const std::string& of) {
    if (tensors_.type() == OnnxType::Float) return tensors_.emit("Atan", {of});
    return tensors_.cast(tensors_.emit("Atan", {tensors_.cast(of, OnnxType::Float)}),
                         tensors_.type());
  }

  /// The operand `which` of each node.
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

  /// Sums of multiples of the same terms: terms [batch, terms] times factors [terms, group], plus
  /// what is added [1, group].
  std::string product(const Nodes& group) {
    // Take the terms in the order in which they stand in tensors, so that few are moved.
    const Nodes& terms = graph_.at(group[0]).inputs;
    std::vector<std::size_t> order(terms.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
      return tensors_.stands_before(terms[a], terms[b]);
    });

    Nodes sorted;
    std::vector<double> factors;
    for (const std::size_t k : order) {
      sorted.push_back(terms[k]);
      const std::vector<double> of_term = numbers_of(group, k);
      factors.insert(factors.end(), of_term.begin(), of_term.end());
    }

    const std::string columns = tensors_.packed(sorted);
    Names inputs{columns, tensors_.constant(tensors_.type(), {size_of(terms), size_of(group)},
                                            std::move(factors))};
    const std::vector<double> added = numbers_of(group, terms.size());
    if (!all_are(added, 0)) inputs.push_back(tensors_.row(added));
    return tensors_.emit("Gemm", inputs);
  }

  /// Sums of a few multiples, term by term: a factor of 1 or -1 needs no operator of its own.
  std::string sum(const Nodes& group) {
    const std::size_t terms = graph_.at(group[0]).inputs.size();
    std::string out;
    for (std::size_t k = 0; k < terms; ++k) {
      const std::vector<double> factors = numbers_of(group, k);
      const std::string column = tensors_.operand(inputs_of(group, k));
      const bool is_less = !out.empty() && all_are(factors, -1);
      const std::string term = all_are(factors, 1) || is_less
                                   ? column
                                   : tensors_.emit("Mul", {column, tensors_.row(factors)});
      out = out.empty() ? term : tensors_.emit(is_less ? "Sub" : "Add", {out, term});
    }

    const std::vector<double> added = numbers_of(group, terms);
    return all_are(added, 0) ? out : tensors_.emit("Add", {out, tensors_.row(added)});
  }

  // Loops.

  /// Whether any lane of the batch holds: a scalar, as Loop asks for it.
  std::string any(const std::string& truths) {
    const std::string largest =
        tensors_.emit("ReduceMax", {tensors_.cast(truths, OnnxType::Float)}, {}, {{"keepdims", 0}});
    return tensors_.emit("Greater", {largest, tensors_.constant(OnnxType::Float, {}, {0.5})});
  }

  /// The loop that has these results: an operator Loop that goes on while any lane does, and
  /// carries which lanes do and all that is needed of what the loop carries.
  void write_loop(const Nodes& results) {
    const std::size_t which = graph_.at(results[0]).loop;
    const Loop& loop = graph_.loop(which);
    const std::vector<std::size_t> alive = live_.carried(which);
    Nodes starts, carried, ends;
    for (const std::size_t k : alive) {
      starts.push_back(loop.starts[k]);
      carried.push_back(loop.carried[k]);
      ends.push_back(loop.ends[k]);
    }

    // From the graph around the loop go in: no limit of rounds, whether any lane goes on, which
    // do, and what is carried.
    const std::string going = tensors_.packed({loop.starts[0]}), name = tensors_.fresh("loop");
    const std::string any_going = any(going);
    const Names inputs{"", any_going, going, tensors_.packed(starts)};

    // The body, with inputs and outputs in the order that Loop lays down.
    auto body = std::make_shared<OnnxGraph>();
    body->name = name;
    body->inputs = {{name + "_round", OnnxType::Int64, 0},
                    {name + "_any", OnnxType::Bool, 0},
                    {name + "_lanes", OnnxType::Bool, 1},
                    {name + "_carried", tensors_.type(), size_of(carried)}};
    tensors_.place({loop.carried[0]}, name + "_lanes");
    tensors_.place(carried, name + "_carried");
    tensors_.open(*body);
    write_region(which);
    const std::string goes_on =
        tensors_.emit("Identity", {tensors_.packed({loop.ends[0]})}, name + "_lanes_after");
    tensors_.emit("Identity", {any(goes_on)}, name + "_any_after");
    tensors_.emit("Identity", {tensors_.packed(ends)}, name + "_carried_after");
    body->outputs = {{name + "_any_after", OnnxType::Bool, 0},
                     {name + "_lanes_after", OnnxType::Bool, 1},
                     {name + "_carried_after", tensors_.type(), size_of(carried)}};
    tensors_.close();

    // Out comes a column for each value that is carried; the results are some of them.
    tensors_.add({"Loop", inputs, {name + "_lanes_end", name + "_end"}, {}, body});
    tensors_.set_width(name + "_end", alive.size());
    for (const Node result : results) {
      const auto number = static_cast<std::size_t>(graph_.at(result).numbers[0]);
      const auto column = std::ranges::find(alive, number) - alive.begin();
      tensors_.place(result, name + "_end", static_cast<std::size_t>(column));
    }
  }

  const Graph& graph_;
  const LiveNodes& live_;
  OnnxTensors tensors_;
};

}  // namespace

OnnxGraph onnx_graph(const Graph& graph, const std::vector<OnnxFace>& inputs,
                     const std::vector<OnnxFace>& outputs, OnnxType type) {
  Nodes all;
  for (const OnnxFace& output : outputs)
    all.insert(all.end(), output.columns.begin(), output.columns.end());
  const LiveNodes live(graph, all);
  return Writer(graph, live, type, inputs.at(0).name).write(inputs, outputs);
}

}  // namespace dashpot::trace
