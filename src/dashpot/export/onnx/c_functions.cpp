#include "dashpot/export/onnx/c_functions.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

namespace dashpot::trace {
namespace {

/// exp(x) - 1 with all its digits where x is small.
Node expm1(Graph& g, Node x) {
  return g.multiply(g.apply(Op::Tanh, g.scaled(x, 0.5)), g.add(g.apply(Op::Exp, x), g.constant(1)));
}

/// log(1 + x), likewise, after W. Kahan: dividing by what rounding left of x mends the logarithm.
Node log1p(Graph& g, Node x) {
  // max(1 + x, 0) keeps the graph from folding (1 + x) - 1 to x before anything is rounded.
  const Node more = g.most(g.add(x, g.constant(1)), g.constant(0)),
             lost = g.subtract(more, g.constant(1));
  const Node ratio = g.divide(g.multiply(g.apply(Op::Log, more), x), lost);
  return g.where(g.equal(lost, g.constant(0)), x,
                 g.where(g.less(g.constant(1e6), x), g.apply(Op::Log, more), ratio));
}

Node cosine(Graph& g, Node x) {
  return g.apply(Op::Sin, g.add(x, g.constant(std::numbers::pi / 2)));
}

/// ONNX Runtime has it in single precision only; one step of Newton's method makes it double.
Node atan(Graph& g, Node x) {
  const Node near = g.apply(Op::Atan, x);
  if (g.is_single()) return near;
  const Node s = g.apply(Op::Sin, near), c = cosine(g, near);
  return g.add(near, g.divide(g.subtract(g.multiply(x, c), s), g.add(c, g.multiply(x, s))));
}

/// Right for points off the negative x axis.
Node atan2(Graph& g, Node y, Node x) {
  const Node radius = g.apply(Op::Sqrt, g.add(g.multiply(x, x), g.multiply(y, y)));
  return g.scaled(atan(g, g.divide(y, g.add(radius, x))), 2);
}

Node atanh(Graph& g, Node x) {
  return g.scaled(g.subtract(log1p(g, x), log1p(g, g.scaled(x, -1))), 0.5);
}

Node copysign(Graph& g, Node size, Node sign) {
  const Node magnitude = g.apply(Op::Abs, size);
  return g.where(g.less(sign, g.constant(0)), g.scaled(magnitude, -1), magnitude);
}

struct Function {
  std::string_view name;
  Node (*of)(Graph& graph, std::span<const Node> arguments);
};

template <Op op>
Node of_one(Graph& graph, std::span<const Node> a) {
  return graph.apply(op, a[0]);
}

constexpr std::array kFunctions{
    Function{"atan", [](Graph& g, std::span<const Node> a) { return atan(g, a[0]); }},
    Function{"atan2", [](Graph& g, std::span<const Node> a) { return atan2(g, a[0], a[1]); }},
    Function{"atanh", [](Graph& g, std::span<const Node> a) { return atanh(g, a[0]); }},
    Function{"ceil", of_one<Op::Ceil>},
    Function{"copysign", [](Graph& g, std::span<const Node> a) { return copysign(g, a[0], a[1]); }},
    Function{"cos", [](Graph& g, std::span<const Node> a) { return cosine(g, a[0]); }},
    Function{"exp", of_one<Op::Exp>},
    Function{"expm1", [](Graph& g, std::span<const Node> a) { return expm1(g, a[0]); }},
    Function{"fabs", of_one<Op::Abs>},
    Function{"floor", of_one<Op::Floor>},
    Function{"fmax", [](Graph& g, std::span<const Node> a) { return g.most(a[0], a[1]); }},
    Function{"fmin", [](Graph& g, std::span<const Node> a) { return g.least(a[0], a[1]); }},
    Function{"isfinite",
             [](Graph& g, std::span<const Node> a) {
               return g.less(g.apply(Op::Abs, a[0]),
                             g.constant(std::numeric_limits<double>::infinity()));
             }},
    Function{"isnan",
             [](Graph& g, std::span<const Node> a) { return g.opposite(g.equal(a[0], a[0])); }},
    Function{"log", of_one<Op::Log>},
    Function{"log1p", [](Graph& g, std::span<const Node> a) { return log1p(g, a[0]); }},
    Function{"pow", [](Graph& g, std::span<const Node> a) { return g.power(a[0], a[1]); }},
    Function{"sin", of_one<Op::Sin>},
    Function{"sqrt", of_one<Op::Sqrt>},
    Function{"tan",
             [](Graph& g, std::span<const Node> a) {
               return g.divide(g.apply(Op::Sin, a[0]), cosine(g, a[0]));
             }},
    Function{"tanh", of_one<Op::Tanh>},
    Function{"tanh_single", of_one<Op::Tanh>}};  // of C in single precision

const Function* find(std::string_view name) {
  for (const std::string_view known :
       {name, name.substr(0, name.size() - (name.ends_with('f') ? 1 : 0))}) {
    const auto found = std::ranges::find(kFunctions, known, &Function::name);
    if (found != kFunctions.end()) return &*found;
  }
  return nullptr;
}

}  // namespace

bool is_c_function(std::string_view name) { return find(name) != nullptr; }

Node c_function(Graph& graph, std::string_view name, std::span<const Node> arguments) {
  return find(name)->of(graph, arguments);
}

}  // namespace dashpot::trace
