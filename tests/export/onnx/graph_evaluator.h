#pragma once
#include <cmath>
#include <map>
#include <vector>

#include "dashpot/export/onnx/graph.h"

/// Computes nodes of a graph for one lane, as its definition says, with none of what writes it as
/// ONNX.
class GraphEvaluator {
 public:
  GraphEvaluator(const dashpot::trace::Graph& graph, std::vector<double> inputs)
      : graph_(graph), inputs_(std::move(inputs)) {}

  double operator()(dashpot::trace::Node node) {
    if (const auto known = values_.find(node); known != values_.end()) return known->second;
    const double value = computed(node);
    values_[node] = value;
    return value;
  }

 private:
  double computed(dashpot::trace::Node node) {
    using dashpot::trace::Op;
    const dashpot::trace::NodeData& data = graph_.at(node);
    const auto of = [&](std::size_t k) { return (*this)(data.inputs[k]); };
    switch (data.op) {
      case Op::Constant:
        return data.numbers[0];
      case Op::Input:
        return inputs_.at(static_cast<std::size_t>(data.numbers[0]));
      case Op::Affine: {
        double sum = data.numbers.back();
        for (std::size_t k = 0; k < data.inputs.size(); ++k) sum += data.numbers[k] * of(k);
        return sum;
      }
      case Op::Where:
        return of(0) != 0 ? of(1) : of(2);
      case Op::And:
        return of(0) != 0 && of(1) != 0;
      case Op::Or:
        return of(0) != 0 || of(1) != 0;
      case Op::Not:
        return of(0) == 0;
      case Op::Less:
        return of(0) < of(1);
      case Op::LessOrEqual:
        return of(0) <= of(1);
      case Op::Equal:
        return of(0) == of(1);
      case Op::Result:
        return end_of(data);
      default:
        return data.inputs.size() == 2 ? of_two(data.op, of(0), of(1)) : of_one(data.op, of(0));
    }
  }

  static double of_two(dashpot::trace::Op op, double a, double b) {
    using dashpot::trace::Op;
    return op == Op::Mul   ? a * b
           : op == Op::Div ? a / b
           : op == Op::Pow ? std::pow(a, b)
           : op == Op::Min ? std::fmin(a, b)
                           : std::fmax(a, b);
  }

  static double of_one(dashpot::trace::Op op, double a) {
    using dashpot::trace::Op;
    return op == Op::Exp    ? std::exp(a)
           : op == Op::Log  ? std::log(a)
           : op == Op::Sqrt ? std::sqrt(a)
           : op == Op::Abs  ? std::abs(a)
           : op == Op::Tanh ? std::tanh(a)
           : op == Op::Sin  ? std::sin(a)
           : op == Op::Atan ? std::atan(a)
           : op == Op::Ceil ? std::ceil(a)
                            : std::floor(a);
  }

  double end_of(const dashpot::trace::NodeData& result) {
    const dashpot::trace::Loop& loop = graph_.loop(result.loop);
    std::vector<double> carried;
    for (const dashpot::trace::Node start : loop.starts) carried.push_back((*this)(start));
    while (carried[0] != 0) {
      GraphEvaluator inside(graph_, inputs_);
      inside.values_ = values_;
      for (std::size_t k = 0; k < carried.size(); ++k) inside.values_[loop.carried[k]] = carried[k];
      for (std::size_t k = 0; k < carried.size(); ++k) carried[k] = inside(loop.ends[k]);
    }
    return carried[static_cast<std::size_t>(result.numbers[0])];
  }

  const dashpot::trace::Graph& graph_;
  std::vector<double> inputs_;
  std::map<dashpot::trace::Node, double> values_;
};
