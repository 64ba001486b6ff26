#include "dashpot/export/onnx/onnx_file.h"

#include <cstring>

namespace dashpot::trace {
namespace {

/// A message of protocol buffers: fields by number, each a whole number or bytes. The numbers of
/// the fields are those of onnx.proto.
class Message {
 public:
  Message& whole(unsigned field, std::int64_t value) {
    varint(field << 3);
    varint(static_cast<std::uint64_t>(value));
    return *this;
  }
  Message& bytes(unsigned field, const std::string& content) {
    varint(field << 3 | 2);
    varint(content.size());
    data_ += content;
    return *this;
  }
  Message& message(unsigned field, const Message& inner) { return bytes(field, inner.data_); }
  std::string take() { return std::move(data_); }

 private:
  void varint(std::uint64_t value) {
    for (; value >= 128; value >>= 7) data_ += static_cast<char>(value | 128);
    data_ += static_cast<char>(value);
  }

  std::string data_;
};

template <class T>
std::string raw(const std::vector<double>& values) {
  std::string out;
  for (const double value : values) {
    const T converted = static_cast<T>(value);
    char bytes[sizeof converted];
    std::memcpy(bytes, &converted, sizeof converted);
    out.append(bytes, sizeof bytes);
  }
  return out;
}

std::string raw(const OnnxTensor& tensor) {
  switch (tensor.type) {
    case OnnxType::Float:
      return raw<float>(tensor.values);
    case OnnxType::Double:
      return raw<double>(tensor.values);
    case OnnxType::Int64:
      return raw<std::int64_t>(tensor.values);
    case OnnxType::Bool:
      return raw<char>(tensor.values);
  }
  return {};
}

Message tensor_proto(const OnnxTensor& tensor) {
  Message out;
  for (const std::int64_t size : tensor.shape) out.whole(1, size);
  return out.whole(2, static_cast<std::int64_t>(tensor.type))
      .bytes(8, tensor.name)
      .bytes(9, raw(tensor));
}

Message value_info(const OnnxValue& value) {
  Message shape, type, content;
  if (value.width > 0)
    shape.message(1, Message().bytes(2, "batch")).message(1, Message().whole(1, value.width));
  type.message(1, Message().whole(1, static_cast<std::int64_t>(value.type)).message(2, shape));
  content.bytes(1, value.name).message(2, type);
  if (!value.meaning.empty()) content.bytes(3, value.meaning);
  return content;
}

Message graph_proto(const OnnxGraph& graph);

Message node_proto(const OnnxNode& node) {
  constexpr std::int64_t kInt = 2, kGraph = 5;
  Message out;
  for (const std::string& input : node.inputs) out.bytes(1, input);
  for (const std::string& output : node.outputs) out.bytes(2, output);
  out.bytes(4, node.op);
  for (const auto& [name, value] : node.attributes)
    out.message(5, Message().bytes(1, name).whole(3, value).whole(20, kInt));
  if (node.body)
    out.message(5,
                Message().bytes(1, "body").message(6, graph_proto(*node.body)).whole(20, kGraph));
  return out;
}

Message graph_proto(const OnnxGraph& graph) {
  Message out;
  for (const OnnxNode& node : graph.nodes) out.message(1, node_proto(node));
  out.bytes(2, graph.name);
  for (const OnnxTensor& tensor : graph.constants) out.message(5, tensor_proto(tensor));
  for (const OnnxValue& value : graph.inputs) out.message(11, value_info(value));
  for (const OnnxValue& value : graph.outputs) out.message(12, value_info(value));
  return out;
}

}  // namespace

std::string onnx_bytes(const OnnxModel& model) {
  Message out;
  out.whole(1, kOnnxIr)
      .bytes(2, "Dashpot")
      .bytes(3, model.producer_version)
      .bytes(6, model.description);
  out.message(7, graph_proto(model.graph)).message(8, Message().bytes(1, "").whole(2, kOnnxOpset));
  for (const auto& [name, value] : model.metadata)
    out.message(14, Message().bytes(1, name).bytes(2, value));
  return out.take();
}

}  // namespace dashpot::trace
