#pragma once
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/nets/simd/neuron_lanes.h"

// One sample, as soon as possible. With a single row nothing can be reused, so that the time is
// that of the longest chain of additions: each neuron's sum is made in kChains chains, which are
// added at the end. Neurons are the lanes; activations go from layer to layer on the stack.
//
//   bytes of a vector   vectors of a cache line   chains
//   64                  1                         4
//   32                  2                         4
//   16                  4                         2   (more sums would leave the registers)
namespace dashpot {
namespace {

/// Calls take(lane, activations) for the neurons of a hidden layer, kLanes at a time.
template <Activation kKind, class Real, class Take>
inline void respond_layer(const NeuronLayer<Real>& layer, const Real* in, Take take) {
  constexpr std::size_t kSize = kLanes<Real>, kVectors = kKernelAlign / kLaneBytes;
  constexpr std::size_t kChains = kVectors == 4 ? 2 : 4;
  static_assert(kVectors == 1 || kVectors == 2 || kVectors == 4, "as far as loops are unrolled");
  static_assert(kVectors * kSize == padded<Real>(1), "rows are whole cache lines of neurons");
  const std::size_t step = layer.columns, inputs = layer.inputs;
  for (std::size_t first = 0; first < step; first += kVectors * kSize) {
    const Real* weights = layer.weights + first;
    Lanes<Real> sums[kChains][kVectors] = {};
    const auto add = [&](std::size_t chain, Real factor, std::size_t row) {
#pragma GCC unroll 4
      for (std::size_t v = 0; v < kVectors; ++v)
        sums[chain][v] += factor * load(weights + row * step + v * kSize);
    };

    // The biases, then the inputs dealt to the chains in turn, then the few that are left over.
    add(kChains - 1, 1, inputs);
    std::size_t i = 0;
    for (; i + kChains <= inputs; i += kChains)
#pragma GCC unroll 4
      for (std::size_t k = 0; k < kChains; ++k) add(k, in[i + k], i + k);
#pragma GCC unroll 4
    for (std::size_t k = 0; k + 1 < kChains; ++k)
      if (i + k < inputs) add(k, in[i + k], i + k);

    // Join the chains, and hand on the activations of these neurons.
#pragma GCC unroll 4
    for (std::size_t v = 0; v < kVectors; ++v) {
      Lanes<Real> total = sums[0][v] + sums[1][v];
      if constexpr (kChains == 4) total += sums[2][v] + sums[3][v];
      take(first + v * kSize, activated_lanes<kKind>(layer, first + v * kSize, total));
    }
  }
}

/// The output neuron's sum, straight from the registers that hold the last hidden layer.
template <class Real>
inline Real respond_last(const NeuronLayer<Real>& hidden, const NeuronLayer<Real>& last,
                         const Real* in) {
  Lanes<Real> sums{};
  with_activation(hidden.activation, [&]<Activation kKind>() {
    respond_layer<kKind>(hidden, in, [&](std::size_t lane, Lanes<Real> values) {
      sums += values * load(last.weights + lane);
    });
  });
  const bool bias_outside = hidden.outputs == hidden.columns;  // its 1 lies in a vector of its own
  return Shuffle<Real>::sum(sums) + (bias_outside ? last.weights[last.inputs] : 0);
}

template <class Real>
Real respond(const NeuronLayer<Real>* layers, std::size_t count, const Real* input) noexcept {
  alignas(kKernelAlign) Real room[2][padded<Real>(kMaxWidth)];
  const Real* in = input;

  // All hidden layers but the last, from one half of the room to the other.
  for (std::size_t l = 0; l + 2 < count; ++l) {
    Real* out = room[l % 2];
    with_activation(layers[l].activation, [&]<Activation kKind>() {
      respond_layer<kKind>(layers[l], in, [out](std::size_t lane, Lanes<Real> values) {
        store(out + lane, values);
      });
    });
    in = out;
  }

  // The last hidden layer and the output neuron together; without a hidden layer the inputs' sum.
  const NeuronLayer<Real>& last = layers[count - 1];
  Real sum = 0;
  if (count > 1) {
    sum = respond_last(layers[count - 2], last, in);
  } else {
    sum = last.weights[last.inputs];
    for (std::size_t i = 0; i < last.inputs; ++i) sum += last.weights[i] * in[i];
  }

  if (last.activation == Activation::Identity) return sum;
  with_activation(last.activation, [&]<Activation kKind>() {
    sum = activated<kKind, Real>(Lanes<Real>{} + sum)[0];
  });
  return sum;
}

}  // namespace
}  // namespace dashpot
