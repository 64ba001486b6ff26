#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dashpot::trace {

/// The types of tensors, as ONNX numbers them.
enum class OnnxType { Float = 1, Int64 = 7, Bool = 9, Double = 11 };

struct OnnxTensor {
  std::string name;
  OnnxType type = OnnxType::Float;
  std::vector<std::int64_t> shape;
  std::vector<double> values;
};

/// An input or output of a graph: [batch, width].
struct OnnxValue {
  std::string name;
  OnnxType type = OnnxType::Float;
  std::int64_t width = 1;  ///< 0: a scalar, without a batch
  std::string meaning;
};

struct OnnxGraph;

struct OnnxNode {
  std::string op;
  std::vector<std::string> inputs, outputs;
  std::vector<std::pair<std::string, std::int64_t>> attributes;
  std::shared_ptr<const OnnxGraph> body;  ///< of a Loop
};

struct OnnxGraph {
  std::string name;
  std::vector<OnnxNode> nodes;
  std::vector<OnnxTensor> constants;
  std::vector<OnnxValue> inputs, outputs;
};

struct OnnxModel {
  OnnxGraph graph;
  std::string producer_version, description;
  std::vector<std::pair<std::string, std::string>> metadata;
};

/// Opset 13 and IR 7: what runtimes since 2020 read.
constexpr std::int64_t kOnnxOpset = 13, kOnnxIr = 7;

/// The model as a file: a ModelProto in the wire format of protocol buffers.
std::string onnx_bytes(const OnnxModel& model);

}  // namespace dashpot::trace
