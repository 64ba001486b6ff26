#pragma once
#include "dashpot/damper/neural/kernel.h"
#include "dashpot/damper/neural/simd/activations.h"

// One sample, as soon as possible: sums in several chains, since what counts is how long one takes.
namespace dashpot {
namespace {

/// Sums of one group of neurons, as many as fill kKernelAlign bytes.
template <class Real, Activation kKind>
inline void respond_group(const NeuronLayer<Real>& layer, const Real* in, std::size_t first, Real* out) {
  constexpr std::size_t kSize = kLanes<Real>, kVectors = kKernelAlign / kLaneBytes;
  constexpr std::size_t kChains = kVectors == 4 ? 2 : 4;
  const std::size_t step = layer.columns;
  const Real* weights = layer.weights + first;
  Lanes<Real> sums[kChains][kVectors] = {};
  // The 1 behind the inputs meets the biases, the zeros behind it whatever stands there.
  for (std::size_t i = 0; i <= layer.inputs; i += kChains, weights += kChains * step)
#pragma GCC unroll 4
    for (std::size_t k = 0; k < kChains; ++k)
#pragma GCC unroll 4
      for (std::size_t v = 0; v < kVectors; ++v)
        sums[k][v] += in[i + k] * load(weights + k * step + v * kSize);
  const bool end = first + kVectors * kSize == step;
#pragma GCC unroll 4
  for (std::size_t v = 0; v < kVectors; ++v) {
    Lanes<Real> total = sums[0][v] + sums[1][v];
    if constexpr (kChains == 4) total += sums[2][v] + sums[3][v];
    total = activated<kKind, Real>(total);
    if (end) total = load(layer.counts + v * kSize) * total + load(layer.ones + v * kSize);
    store(out + first + v * kSize, total);
  }
}

template <class Real>
inline Real respond_output(const Real* in, const Real* weights, std::size_t columns) {
  Lanes<Real> sums = load(in) * load(weights);
  for (std::size_t k = kLanes<Real>; k < columns; k += kLanes<Real>) sums += load(in + k) * load(weights + k);
  return Shuffle<Real>::sum(sums);
}

template <class Real>
void respond(const NeuronLayer<Real>* layers, std::size_t count, const Real* input, Real* outputs) noexcept {
  alignas(kKernelAlign) Real room[2][padded<Real>(kMaxWidth + 1)];
  const Real* in = input;
  for (std::size_t l = 0; l + 1 < count; ++l) {
    const NeuronLayer<Real>& layer = layers[l];
    Real* out = room[l % 2];
    with_activation(layer.activation, [&]<Activation kKind>() {
      for (std::size_t first = 0; first < layer.columns; first += kKernelAlign / sizeof(Real))
        respond_group<Real, kKind>(layer, in, first, out);
    });
    if (layer.out_step > layer.columns) {  // the 1 lies in a vector of its own
      constexpr std::size_t kPad = kKernelAlign / sizeof(Real);
      for (std::size_t k = 0; k < kPad; ++k) out[layer.columns + k] = k == 0 ? 1 : 0;
    }
    in = out;
  }
  const NeuronLayer<Real>& last = layers[count - 1];
  with_activation(last.activation, [&]<Activation kKind>() {
    for (std::size_t n = 0; n < last.outputs; ++n)
      outputs[n] = activated<kKind, Real>(
          Lanes<Real>{} + respond_output(in, last.weights + n * last.columns, last.columns))[0];
  });
}

}  // namespace
}  // namespace dashpot
