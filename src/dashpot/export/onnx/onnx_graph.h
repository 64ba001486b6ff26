#pragma once
#include "dashpot/export/onnx/graph.h"
#include "dashpot/export/onnx/onnx_file.h"

namespace dashpot::trace {

/// An input or output of the ONNX graph: a tensor [batch, columns].
struct OnnxFace {
  std::string name, meaning;
  std::vector<Node> columns;
};

/// The part of a graph that leads from inputs to outputs (one input at least), as operators of ONNX
/// on tensors [batch, width]: nodes of one kind that can be computed beside each other share an
/// operator, sums of products become Gemm.
OnnxGraph onnx_graph(const Graph& graph, const std::vector<OnnxFace>& inputs,
                     const std::vector<OnnxFace>& outputs, OnnxType type);

}  // namespace dashpot::trace
