#pragma once
#include "dashpot/suspension/lanes/ride.h"
#include "dashpot/suspension/lanes/simd/lane_math.h"

namespace dashpot {
namespace {

// Dampers of a ride in lanes. Each has kStates states per vehicle and
//   set_current(i)            i A, from now on
//   force(x, v, z)            N, x m and v m/s of the damper, extension positive
//   derivative(x, v, z, dz)   z' of its states
//   Loop, loop                its hysteresis loop, a LoopPath, if it has one
// It is made from a ride and the number of its strut.

/// For dampers without a hysteresis loop.
struct NoLoop {
  static constexpr bool kExists = false;
  using Loop = NoLoop;
  struct Met {};
  struct Place {};
  struct Speeds {};
};

/// A static network, one set of weights per lane, in the order of Mlp::parameters with scale and
/// mean of the output behind them. The current's part of the first layer is added up once for all
/// motions at that current.
class NetworkLanes {
 public:
  static constexpr std::size_t kStates = 0;
  using Loop = NoLoop;
  explicit NetworkLanes(const LaneRide& ride, std::size_t strut = 0)
      : shape_(*ride.network), weights_(ride.damper + strut * ride.damper_size * kWidth) {
    const std::size_t inputs = shape_.layers[0].inputs;
    for (std::size_t i = 0; i < inputs; ++i) {
      const LaneInput input = shape_.inputs[i];
      (input == LaneInput::Displacement ? by_displacement_
       : input == LaneInput::Velocity   ? by_velocity_
                                        : by_current_) = i;
    }

    // The ones of tanh s = 1 - 2 / (1 + exp 2s), which respond() leaves to the output layer.
    const std::size_t outputs = shape_.layers[0].outputs;
    const double* out = behind(shape_.layers[0], weights_);
    if (shape_.count == 2)
      for (std::size_t n = 0; n <= outputs; ++n) all_ones_ += load(out + n * kWidth);
  }

  void set_current(Lane current) {
    const LaneNetwork::Layer& first = shape_.layers[0];
    const double* biases = weights_ + first.inputs * first.outputs * kWidth;
    for (std::size_t n = 0; n < first.outputs; ++n) {
      biases_[n] = load(biases + n * kWidth);
      if (by_current_ != kNone) biases_[n] += weight(n, by_current_) * current;
    }
  }
  void derivative(Lane, Lane, const Lane*, Lane*) const {}

  /// Out of line: too long to stand six times in a step.
  [[gnu::noinline]] Lane force(Lane x, Lane v, const Lane*) const {
    if (by_displacement_ == kNone)
      return respond([&](std::size_t n) { return biases_[n] + weight(n, by_velocity_) * v; });
    if (by_velocity_ == kNone)
      return respond([&](std::size_t n) { return biases_[n] + weight(n, by_displacement_) * x; });
    return respond([&](std::size_t n) {
      return biases_[n] + weight(n, by_displacement_) * x + weight(n, by_velocity_) * v;
    });
  }

 private:
  static constexpr std::size_t kNone = kMaxWidth;

  Lane weight(std::size_t neuron, std::size_t input) const {
    return load(weights_ + (neuron * shape_.layers[0].inputs + input) * kWidth);
  }

  /// The output in N; first(n): the sum of neuron n of the first layer.
  template <class First>
  Lane respond(First first) const {
    // One layer of tanh before the output's, the usual case, adds its neurons up as they come.
    const LaneNetwork::Layer& layer = shape_.layers[0];
    if (shape_.count == 2 && layer.activation == Activation::Tanh)
      return ended(shape_.layers[1], sum_of_tanh(layer.outputs, first, behind(layer, weights_)),
                   behind(layer, weights_));

    // Any other: layer by layer.
    Lane room[2][kMaxWidth];
    with_activation(layer.activation, [&]<Activation kKind>() {
      for (std::size_t n = 0; n < layer.outputs; ++n)
        room[0][n] = activated<kKind, double>(first(n));
    });
    return respond_behind(room);
  }
  /// All layers behind the first, whose values stand in room[0].
  Lane respond_behind(Lane (&room)[2][kMaxWidth]) const {
    const double* weights = weights_;
    std::size_t from = 0;
    for (std::size_t l = 1; l < shape_.count; ++l, from = 1 - from) {
      const LaneNetwork::Layer& layer = shape_.layers[l];
      weights = behind(shape_.layers[l - 1], weights);
      with_activation(layer.activation, [&]<Activation kKind>() {
        for (std::size_t n = 0; n < layer.outputs; ++n)
          room[1 - from][n] = activated<kKind, double>(sum(layer, n, room[from], weights));
      });
    }
    return raw(room[from][0], behind(shape_.layers[shape_.count - 1], weights));
  }
  static const double* behind(const LaneNetwork::Layer& layer, const double* weights) {
    return weights + (layer.inputs + 1) * layer.outputs * kWidth;
  }
  static Lane sum(const LaneNetwork::Layer& layer, std::size_t neuron, const Lane* in,
                  const double* weights) {
    const double* row = weights + neuron * layer.inputs * kWidth;
    Lane total = load(weights + (layer.inputs * layer.outputs + neuron) * kWidth);
    for (std::size_t i = 0; i < layer.inputs; ++i) total += load(row + i * kWidth) * in[i];
    return total;
  }
  /// The bias and the weighted tanh of that many sums: tanh s = 1 - 2 / (1 + exp 2s), the ones
  /// summed beforehand (all_ones_). Two neurons share a division, which takes longer than all else:
  /// a / A + b / B = (a B + b A) / (A B).
  template <class First>
  Lane sum_of_tanh(std::size_t count, First first, const double* out) const {
    Lane fractions{};
    std::size_t n = 0;
    for (; n + 2 <= count; n += 2) {
      const Lane a = 1 + exp_of_twice<double>(first(n)), b = 1 + exp_of_twice<double>(first(n + 1));
      fractions += (load(out + n * kWidth) * b + load(out + (n + 1) * kWidth) * a) / (a * b);
    }
    if (n < count) fractions += load(out + n * kWidth) / (1 + exp_of_twice<double>(first(n)));
    return all_ones_ - 2 * fractions;
  }
  static Lane ended(const LaneNetwork::Layer& last, Lane sum, const double* weights) {
    with_activation(last.activation,
                    [&]<Activation kKind>() { sum = activated<kKind, double>(sum); });
    return raw(sum, behind(last, weights));
  }
  /// In raw units: scale and mean stand behind the last layer's weights.
  static Lane raw(Lane output, const double* scale) {
    return load(scale) * output + load(scale + kWidth);
  }

  const LaneNetwork& shape_;
  const double* weights_;
  std::size_t by_displacement_ = kNone, by_velocity_ = kNone, by_current_ = kNone;  ///< inputs
  Lane biases_[kMaxWidth];  ///< of the first layer, with the current's part
  Lane all_ones_{};         ///< what the last of two layers sums up where all neurons give 1
};

/// A law whose text is compiled for lanes (laws.h): P, its struct of parameters, a Lane each, its
/// functions, and its hysteresis loop, which LawLoop knows (BoucWenLoop). A parameter may follow
/// the current as a polynomial; those that do are kept in a list.
template <class P, auto Force, auto Derivative, std::size_t kCount, class LawLoop = NoLoop>
class LawLanes {
 public:
  static constexpr std::size_t kStates = kCount;
  explicit LawLanes(const LaneRide& ride, std::size_t strut = 0)
      : by_power_(ride.damper + strut * ride.damper_size * kWidth) {
    LaneMask loop_varies{};
    for (std::size_t k = 0; k < kParameters; ++k) {
      LaneMask varies{};
      for (std::size_t power = 1; power < kLanePowers; ++power)
        varies |= load(by_power_ + (power * kParameters + k) * kWidth) != 0;

      const Lane value = load(by_power_ + k * kWidth);
      __builtin_memcpy(reinterpret_cast<char*>(&law_) + k * sizeof value, &value, sizeof value);
      if (any(varies)) varying_[count_++] = k;
      if constexpr (LawLoop::kExists)
        for (const std::size_t place : LawLoop::kShape)
          if (place == k) loop_varies |= varies;
    }
    if constexpr (LawLoop::kExists) {
      const auto shape = LawLoop::shape(law_);
      loop =
          Loop(shape, ride.absolute_tolerance + ride.relative_tolerance * shape.z_max, loop_varies);
    }
  }

  void set_current(Lane current) {
    for (std::size_t place = 0; place < count_; ++place) {
      const std::size_t k = varying_[place];
      static_assert(kLanePowers == 4, "a cubic, by Horner's rule");
      const double* at = by_power_ + k * kWidth;
      constexpr std::size_t kStep = kParameters * kWidth;
      const Lane value =
          load(at) + current * (load(at + kStep) +
                                current * (load(at + 2 * kStep) + current * load(at + 3 * kStep)));
      __builtin_memcpy(reinterpret_cast<char*>(&law_) + k * sizeof value, &value, sizeof value);
    }
  }
  void derivative(Lane x, Lane v, const Lane* z, Lane* dz) const {
    if constexpr (kStates > 0) Derivative(&law_, x, v, z, dz);
  }
  Lane force(Lane x, Lane v, const Lane* z) const { return Force(&law_, x, v, z); }

  using Loop = typename LawLoop::Loop;
  using LoopOfLaw = LawLoop;
  Loop loop;

 private:
  static constexpr std::size_t kParameters = sizeof(P) / sizeof(Lane);
  static_assert(sizeof(P) % sizeof(Lane) == 0, "a law's struct holds nothing but its parameters");
  const double* by_power_;                        ///< kLanePowers rows of parameters
  std::size_t varying_[kParameters], count_ = 0;  ///< parameters that follow the current
  P law_{};
};

}  // namespace
}  // namespace dashpot
