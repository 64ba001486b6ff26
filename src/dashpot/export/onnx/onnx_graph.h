#pragma once
#include "dashpot/export/onnx/graph.h"
#include "dashpot/export/onnx/onnx_file.h"

namespace dashpot::trace {

/// One tensor [batch, nodes] of a graph's face.
struct OnnxFace {
  std::string name, meaning;
  std::vector<Node> columns;
};

/// The part of a graph that leads from inputs to outputs, as operators of ONNX on tensors [batch,
/// width]: what is of one kind and can be computed beside each other shares an operator, sums of
/// products become Gemm.
OnnxGraph onnx_graph(const Graph& graph, const std::vector<OnnxFace>& inputs,
                     const std::vector<OnnxFace>& outputs, OnnxType type);

}  // namespace dashpot::trace
