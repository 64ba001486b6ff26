#pragma once
#include "dashpot/damper/neural/kernel.h"
#include "dashpot/damper/neural/simd/activations.h"
#include "dashpot/damper/neural/simd/multiply.h"

namespace dashpot {
namespace {

template <class Real>
constexpr std::size_t vectors(std::size_t columns) {
  return columns / kLanes<Real>;
}

/// The lanes of a layer's last line, in registers.
template <class Real>
struct LastLine {
  static constexpr std::size_t kSize = kLanes<Real>, kVectors = kKernelAlign / kLaneBytes;
  Lanes<Real> counts[kVectors], ones[kVectors];

  explicit LastLine(const NeuronLayer<Real>& layer) {
    for (std::size_t v = 0; v < kVectors; ++v) {
      counts[v] = load(layer.counts + v * kSize);
      ones[v] = load(layer.ones + v * kSize);
    }
  }
};

/// Sums of a hidden layer -> activations in place, 0 behind the last and a 1 where the next layer's biases
/// look for it.
template <class Real, Activation kKind>
void activate_rows(const NeuronLayer<Real>& layer, std::size_t rows) {
  using Line = LastLine<Real>;
  const Line line(layer);
  const std::size_t before = layer.columns - kOneLine<Real>, step = layer.out_step;
  Real* at = layer.out;
  for (std::size_t r = 0; r < rows; ++r, at += step) {
    for (std::size_t k = 0; k < before; k += Line::kSize) store(at + k, activated<kKind, Real>(load(at + k)));
#pragma GCC unroll 4
    for (std::size_t v = 0; v < Line::kVectors; ++v) {
      Real* const to = at + before + v * Line::kSize;
      store(to, line.counts[v] * activated<kKind, Real>(load(to)) + line.ones[v]);
    }
  }
}

/// Derivatives by activations -> by sums, in place; 0 behind the last neuron.
template <class Real, Activation kKind>
void deactivate_rows(const NeuronLayer<Real>& layer, std::size_t rows) {
  using Line = LastLine<Real>;
  const Line line(layer);
  const std::size_t before = layer.columns - kOneLine<Real>, step = layer.columns, out_step = layer.out_step;
  Real* at = layer.deltas;
  const Real* out = layer.out;
  for (std::size_t r = 0; r < rows; ++r, at += step, out += out_step) {
    for (std::size_t k = 0; k < before; k += Line::kSize)
      store(at + k, through<kKind, Real>(load(out + k), load(at + k)));
#pragma GCC unroll 4
    for (std::size_t v = 0; v < Line::kVectors; ++v) {
      const std::size_t k = before + v * Line::kSize;
      store(at + k, line.counts[v] * through<kKind, Real>(load(out + k), load(at + k)));
    }
  }
}

/// Output layer: scalar products of weights and activations, kLanes samples at a time.
template <class Real>
void output_sums(const NeuronLayer<Real>& layer, std::size_t rows) {
  constexpr std::size_t kSize = kLanes<Real>;
  for (std::size_t n = 0; n < layer.outputs; ++n)
    for (std::size_t s = 0; s < rows; s += kSize) {
      Lanes<Real> products[kSize];
#pragma GCC unroll 16
      for (std::size_t r = 0; r < kSize; ++r) {
        const Real* in = layer.in + (s + r) * layer.in_step;
        const Real* weights = layer.weights + n * layer.columns;
        products[r] = load(in) * load(weights);
        for (std::size_t k = kSize; k < layer.columns; k += kSize)
          products[r] += load(in + k) * load(weights + k);
      }
      store(layer.out + n * layer.out_step + s, Shuffle<Real>::sums(products));
    }
}

template <class Real>
void forward(const NeuronLayer<Real>* layers, std::size_t count, std::size_t rows) noexcept {
  for (std::size_t l = 0; l + 1 < count; ++l) {
    const NeuronLayer<Real>& layer = layers[l];
    multiply<Real>(rows, vectors<Real>(layer.columns),
                   {layer.inputs,
                    {layer.in, layer.in_step, 1},
                    {layer.weights, layer.columns},
                    {layer.weights + layer.inputs * layer.columns, 0},
                    {layer.out, layer.out_step}});
    with_activation(layer.activation, [&]<Activation kKind>() { activate_rows<Real, kKind>(layer, rows); });
  }
  const NeuronLayer<Real>& last = layers[count - 1];
  output_sums(last, rows);
  with_activation(last.activation, [&]<Activation kKind>() {
    for (std::size_t n = 0; n < last.outputs; ++n)
      activate<kKind>(last.out + n * last.out_step, last.out_step);
  });
}

/// The last layer: its deltas from derivatives by its outputs, its gradient, and derivatives by its inputs.
template <class Real>
void backward_output(const NeuronLayer<Real>& last, std::size_t rows, Rows<Real> by_input) {
  with_activation(last.activation, [&]<Activation kKind>() {
    for (std::size_t n = 0; n < last.outputs; ++n)
      deactivate<kKind>(last.deltas + n * last.out_step, last.out + n * last.out_step, last.out_step);
  });
  multiply<Real>(last.outputs, vectors<Real>(last.columns),
                 {rows,
                  {last.deltas, last.out_step, 1},
                  {last.in, last.in_step},
                  zeros<Real>(),
                  {last.gradient, last.columns}});
  if (by_input.at)
    multiply<Real>(rows, vectors<Real>(by_input.step),
                   {last.outputs,
                    {last.deltas, 1, last.out_step},
                    {last.weights, last.columns},
                    zeros<Real>(),
                    by_input});
}

template <class Real>
void backward(const NeuronLayer<Real>* layers, std::size_t count, std::size_t rows,
              Real* input_gradient) noexcept {
  const auto by_input = [&](std::size_t l) {
    return l > 0 ? Rows<Real>{layers[l - 1].deltas, layers[l - 1].columns}
                 : Rows<Real>{input_gradient, padded<Real>(layers[0].inputs)};
  };
  backward_output(layers[count - 1], rows, by_input(count - 1));
  for (std::size_t l = count - 1; l-- > 0;) {
    const NeuronLayer<Real>& layer = layers[l];
    with_activation(layer.activation, [&]<Activation kKind>() { deactivate_rows<Real, kKind>(layer, rows); });
    const Rows<const Real> deltas{layer.deltas, layer.columns};
    multiply<Real>(
        layer.inputs + 1, vectors<Real>(layer.columns),
        {rows, {layer.in, 1, layer.in_step}, deltas, zeros<Real>(), {layer.gradient, layer.columns}});
    if (const Rows<Real> to = by_input(l); to.at)
      multiply<Real>(
          rows, vectors<Real>(to.step),
          {layer.outputs, {deltas.at, deltas.step, 1}, {layer.transposed, to.step}, zeros<Real>(), to});
  }
}

template <class Real>
void transpose(const NeuronLayer<Real>* layers, std::size_t count) noexcept {
  constexpr std::size_t kSize = kLanes<Real>;
  for (std::size_t l = 0; l + 1 < count; ++l) {
    const NeuronLayer<Real>& layer = layers[l];
    const std::size_t step = padded<Real>(layer.inputs);
    for (std::size_t i = 0; i < step; i += kSize)
      for (std::size_t n = 0; n < layer.columns; n += kSize) {
        Lanes<Real> square[kSize];
#pragma GCC unroll 16
        for (std::size_t k = 0; k < kSize; ++k) square[k] = load(layer.weights + (i + k) * layer.columns + n);
        Shuffle<Real>::transpose(square);
#pragma GCC unroll 16
        for (std::size_t k = 0; k < kSize; ++k) store(layer.transposed + (n + k) * step + i, square[k]);
      }
  }
}

}  // namespace
}  // namespace dashpot
