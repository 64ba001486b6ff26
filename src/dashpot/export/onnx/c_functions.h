#pragma once
#include <span>
#include <string_view>

#include "dashpot/export/onnx/graph.h"

namespace dashpot::trace {

/// Whether both math.h and a graph have this function: "exp", "fmax"; in single precision "expf".
bool is_c_function(std::string_view name);
/// The value of such a function, with as many arguments as math.h has it.
Node c_function(Graph& graph, std::string_view name, std::span<const Node> arguments);

}  // namespace dashpot::trace
