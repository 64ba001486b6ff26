#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dashpot/export/onnx/graph.h"
#include "dashpot/export/onnx/onnx_file.h"

namespace dashpot::trace {

/// As ONNX counts.
std::int64_t size_of(const auto& list) { return static_cast<std::int64_t>(list.size()); }

/// The tensors of an ONNX graph while it is written, and which node of a Graph stands where in
/// them. A tensor has the shape [batch, width]; a node is one of its columns, a constant is none.
/// Writes the operators that put columns together.
class OnnxTensors {
 public:
  using Names = std::vector<std::string>;
  using Nodes = std::vector<Node>;
  using Attributes = std::vector<std::pair<std::string, std::int64_t>>;

  /// `type`: of the numbers. `first_input`: a tensor that is there before all else; it says how
  /// large the batch is.
  OnnxTensors(const Graph& graph, OnnxType type, std::string first_input)
      : graph_(graph), type_(type), first_input_(std::move(first_input)) {}

  OnnxType type() const { return type_; }

  // Writing, to the innermost of the graphs that are open: the step, and the bodies of loops within
  // it, which see the tensors of the graphs around them.

  void open(OnnxGraph& graph) { scopes_.push_back({&graph, {}}); }
  void close() { scopes_.pop_back(); }
  void add(OnnxNode node) { scopes_.back().graph->nodes.push_back(std::move(node)); }
  /// Adds an operator with one output, and gives the output's name: a new one if none is given.
  std::string emit(std::string_view op, Names inputs, std::string output = {},
                   Attributes attributes = {});
  std::string cast(const std::string& tensor, OnnxType type);
  /// A name that no tensor and no graph has.
  std::string fresh(std::string_view stem);

  // The places of nodes.

  /// Says that the columns of this tensor are these nodes.
  void place(const Nodes& nodes, const std::string& tensor);
  /// The same for one column, and for the number of columns.
  void place(Node node, const std::string& tensor, std::size_t column) {
    places_[node] = {tensor, column};
  }
  void set_width(const std::string& tensor, std::size_t width) { widths_[tensor] = width; }
  /// The tensor of which a node is a column; "#" for a constant.
  std::string source(Node node) const;
  /// The order of nodes by the tensor and the column where they stand.
  bool stands_before(Node a, Node b) const;

  // Tensors made of nodes.

  /// A tensor with a column per node; one column for all where all are the same. The nodes must be
  /// columns of one tensor, or constants.
  std::string operand(const Nodes& nodes);
  /// [batch, nodes], wherever the nodes stand.
  std::string packed(const Nodes& nodes);
  /// [1, values].
  std::string row(const std::vector<double>& values);
  /// A tensor of constants, which stands in the file once.
  std::string constant(OnnxType type, std::vector<std::int64_t> shape, std::vector<double> values);

  /// All constants in the order of their names; empties the list.
  std::vector<OnnxTensor> take_constants() { return std::move(constants_); }

 private:
  struct Place {
    std::string tensor;
    std::size_t column = 0;
  };
  struct Scope {
    OnnxGraph* graph;
    std::map<std::string, std::string> columns;  ///< by tensor and columns: what was gathered
  };

  std::string constants_of(const Nodes& nodes);
  std::string columns_of(const Nodes& nodes);
  std::string gathered(const std::string& tensor, const std::vector<double>& columns);
  std::string reordered(const Nodes& nodes);
  std::string spread(const Nodes& nodes);
  std::string batch_shape();

  const Graph& graph_;
  const OnnxType type_;
  const std::string first_input_;
  std::vector<Scope> scopes_;
  std::map<Node, Place> places_;
  std::map<std::string, std::size_t> widths_;
  std::map<std::string, std::string> constant_names_;  ///< by type, shape and values
  std::vector<OnnxTensor> constants_;
  std::size_t count_ = 0;  ///< of the names that fresh() gave
  bool has_batch_shape_ = false;
};

}  // namespace dashpot::trace
