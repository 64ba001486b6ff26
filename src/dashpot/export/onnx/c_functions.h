#pragma once
#include <span>
#include <string_view>

#include "dashpot/export/onnx/graph.h"

namespace dashpot::trace {

/// Whether math.h has it and a graph, too: "exp", "fmax"; in single precision "expf".
bool is_c_function(std::string_view name);
/// Its value.
Node c_function(Graph& graph, std::string_view name, std::span<const Node> arguments);

}  // namespace dashpot::trace
