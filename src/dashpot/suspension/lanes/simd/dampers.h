#pragma once
#include "dashpot/suspension/lanes/ride.h"
#include "dashpot/suspension/lanes/simd/lane_math.h"

namespace dashpot {
namespace {

/// A static network, one set of weights per lane.
class NetworkLanes {
 public:
  static constexpr std::size_t kStates = 0;
  explicit NetworkLanes(const LaneRide& ride) : shape_(*ride.network), weights_(ride.damper) {}

  void set_current(Lane current) { current_ = current; }
  void derivative(Lane, Lane, const Lane*, Lane*) const {}
  Lane force(Lane x, Lane v, const Lane*) const {
    const Lane motion[3] = {x, v, current_};
    Lane room[2][kMaxWidth];
    for (std::size_t i = 0; i < shape_.layers[0].inputs; ++i) room[0][i] = motion[shape_.inputs[i]];
    const double* weights = weights_;
    std::size_t from = 0;
    for (std::size_t l = 0; l + 1 < shape_.count; ++l) {
      const LaneNetwork::Layer &layer = shape_.layers[l], &next = shape_.layers[l + 1];
      if (l + 2 == shape_.count && layer.activation == Activation::Tanh)
        return ended(next, last_two(layer, room[from], weights),
                     weights + (layer.inputs + 1) * layer.outputs * kWidth);
      with_activation(layer.activation, [&]<Activation kKind>() {
        for (std::size_t n = 0; n < layer.outputs; ++n)
          room[1 - from][n] = activated<kKind, double>(sum(layer, n, room[from], weights));
      });
      weights += (layer.inputs + 1) * layer.outputs * kWidth;
      from = 1 - from;
    }
    const LaneNetwork::Layer& last = shape_.layers[shape_.count - 1];
    return ended(last, sum(last, 0, room[from], weights), weights);
  }

 private:
  static Lane sum(const LaneNetwork::Layer& layer, std::size_t neuron, const Lane* in,
                  const double* weights) {
    const double* row = weights + neuron * layer.inputs * kWidth;
    Lane total = load(weights + (layer.inputs * layer.outputs + neuron) * kWidth);
    for (std::size_t i = 0; i < layer.inputs; ++i) total += load(row + i * kWidth) * in[i];
    return total;
  }
  /// A layer of tanh and the sum over it. Two neurons share a division, which takes longer than all else.
  static Lane last_two(const LaneNetwork::Layer& layer, const Lane* in, const double* weights) {
    const double* out = weights + (layer.inputs + 1) * layer.outputs * kWidth;
    Lane total = load(out + layer.outputs * kWidth);
    std::size_t n = 0;
    for (; n + 2 <= layer.outputs; n += 2) {
      const Fraction<double> a = tanh_fraction<double>(sum(layer, n, in, weights)),
                             b = tanh_fraction<double>(sum(layer, n + 1, in, weights));
      const Lane one = load(out + n * kWidth) * a.above, other = load(out + (n + 1) * kWidth) * b.above;
      total += (one * b.below + other * a.below) / (a.below * b.below);
    }
    if (n < layer.outputs) total += load(out + n * kWidth) * tanh(sum(layer, n, in, weights));
    return total;
  }
  /// In raw units: scale and mean stand behind the last layer's weights.
  static Lane ended(const LaneNetwork::Layer& last, Lane sum, const double* weights) {
    const double* scale = weights + (last.inputs + 1) * kWidth;
    with_activation(last.activation, [&]<Activation kKind>() { sum = activated<kKind, double>(sum); });
    return load(scale) * sum + load(scale + kWidth);
  }

  const LaneNetwork& shape_;
  const double* weights_;
  Lane current_{};
};

/// A law whose text is compiled for lanes: a struct of numbers per lane and its functions.
template <class P, auto Force, auto Derivative, std::size_t kCount>
class LawLanes {
 public:
  static constexpr std::size_t kStates = kCount;
  explicit LawLanes(const LaneRide& ride) : by_power_(ride.damper) {}

  void set_current(Lane current) {
    Lane values[kParameters];
    for (std::size_t k = 0; k < kParameters; ++k) {
      const double* at = by_power_ + k * kWidth;
      constexpr std::size_t kStep = kParameters * kWidth;
      values[k] = load(at) + current * (load(at + kStep) +
                                        current * (load(at + 2 * kStep) + current * load(at + 3 * kStep)));
    }
    __builtin_memcpy(&law_, values, sizeof law_);
  }
  void derivative(Lane x, Lane v, const Lane* z, Lane* dz) const {
    if constexpr (kStates > 0) Derivative(&law_, x, v, z, dz);
  }
  Lane force(Lane x, Lane v, const Lane* z) const { return Force(&law_, x, v, z); }

 private:
  static constexpr std::size_t kParameters = sizeof(P) / sizeof(Lane);
  const double* by_power_;
  P law_{};
};

}  // namespace
}  // namespace dashpot
