#pragma once
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/nets/simd/activations.h"
#include "dashpot/damper/nets/simd/multiply.h"

// Kernels whose lanes are the neurons of a layer: passes over mini-batches, forward and backward.
// kernel.h shows how a NeuronLayer's arrays lie in memory. Per layer the passes are
//
//   forward    out = activation(in W + b)
//   backward   gradient = in' deltas,   deltas of the layer before = (deltas W') activation'
//
// each a product of matrices (multiply.h). ReLU and identity only bound or gate a sum, which the
// product does while it has the sum in registers; tanh and sigmoid take another pass over the row.
namespace dashpot {
namespace {

/// How many vectors fill a padded row.
template <class Real>
constexpr std::size_t vectors(std::size_t columns) {
  return columns / kLanes<Real>;
}

/// The activations of the neurons at `lane` of a hidden layer; 0 behind the last and a 1 where the
/// next layer's biases look for it.
template <Activation kKind, class Real>
inline Lanes<Real> activated_lanes(const NeuronLayer<Real>& layer, std::size_t lane,
                                   Lanes<Real> sum) {
  if constexpr (is_bound(kKind)) return larger(load(layer.bounds + lane), sum);
  return load(layer.counts + lane) * activated<kKind, Real>(sum) + load(layer.ones + lane);
}
template <class Real, Activation kKind>
void activate_rows(const NeuronLayer<Real>& layer, std::size_t rows) {
  Real* at = layer.out;
  for (std::size_t r = 0; r < rows; ++r, at += layer.out_step)
    for (std::size_t k = 0; k < layer.columns; k += kLanes<Real>)
      store(at + k, activated_lanes<kKind, Real>(layer, k, load(at + k)));
}

/// Derivatives by activations -> by sums, in place.
template <class Real, Activation kKind>
void deactivate_rows(const NeuronLayer<Real>& layer, std::size_t rows) {
  for (std::size_t r = 0; r < rows; ++r)
    deactivate<kKind>(layer.deltas + r * layer.columns, layer.out + r * layer.out_step,
                      layer.columns);
}

/// Output layer: scalar products of weights and activations, kLanes samples at a time.
template <class Real>
void output_sums(const NeuronLayer<Real>& layer, std::size_t rows) {
  constexpr std::size_t kSize = kLanes<Real>;
  for (std::size_t n = 0; n < layer.outputs; ++n)
    for (std::size_t s = 0; s < rows; s += kSize) {
      // One vector of products per sample, and their sums over the lanes as one vector of samples.
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
  // Hidden layers, whose results are the next layer's inputs.
  for (std::size_t l = 0; l + 1 < count; ++l) {
    const NeuronLayer<Real>& layer = layers[l];
    multiply<Form::Neurons, Real>(rows, vectors<Real>(layer.columns),
                                  {layer.inputs,
                                   {layer.in, layer.in_step, 1},
                                   {layer.weights, layer.columns},
                                   {layer.out, layer.out_step},
                                   {layer.weights + layer.inputs * layer.columns, 0},
                                   {layer.bounds, 0}});
    if (!is_bound(layer.activation))
      with_activation(layer.activation,
                      [&]<Activation kKind>() { activate_rows<Real, kKind>(layer, rows); });
  }

  // The output layer: few neurons, so that samples are its lanes.
  const NeuronLayer<Real>& last = layers[count - 1];
  output_sums(last, rows);
  with_activation(last.activation, [&]<Activation kKind>() {
    for (std::size_t n = 0; n < last.outputs; ++n)
      activate<kKind>(last.out + n * last.out_step, last.out_step);
  });
}

/// The gradient by a layer's weights; for the last layer from derivatives by its outputs.
template <class Real>
void backward_weights(const NeuronLayer<Real>& layer, std::size_t rows, bool last) {
  // A hidden layer: in' deltas; the row of ones behind the inputs gives the biases.
  if (!last)
    return multiply<Form::Sum, Real>(layer.inputs + 1, vectors<Real>(layer.columns),
                                     {rows,
                                      {layer.in, 1, layer.in_step},
                                      {layer.deltas, layer.columns},
                                      {layer.gradient, layer.columns}});

  // The output layer: through its activation first, then neuron by neuron.
  with_activation(layer.activation, [&]<Activation kKind>() {
    for (std::size_t n = 0; n < layer.outputs; ++n)
      deactivate<kKind>(layer.deltas + n * layer.out_step, layer.out + n * layer.out_step,
                        layer.out_step);
  });
  multiply<Form::Sum, Real>(layer.outputs, vectors<Real>(layer.columns),
                            {rows,
                             {layer.deltas, layer.out_step, 1},
                             {layer.in, layer.in_step},
                             {layer.gradient, layer.columns}});
}

/// From a layer's deltas to those of the layer before it; from the first layer's to derivatives by
/// inputs.
template <class Real>
void backward_deltas(const NeuronLayer<Real>& layer, std::size_t rows, bool last,
                     const NeuronLayer<Real>* before, Real* input_gradient) {
  const std::size_t step = padded<Real>(layer.inputs);
  const Left<Real> deltas = last ? Left<Real>{layer.deltas, 1, layer.out_step}
                                 : Left<Real>{layer.deltas, layer.columns, 1};
  const Rows<const Real> weights{layer.transposed, step};

  // Before it lies a ReLU: the product is gated by the sign of that activation.
  if (before && before->activation == Activation::Relu)
    return multiply<Form::Gated, Real>(rows, vectors<Real>(step),
                                       {layer.outputs,
                                        deltas,
                                        weights,
                                        {before->deltas, step},
                                        {},
                                        {before->out, before->out_step}});

  // Any other activation, or the inputs themselves.
  multiply<Form::Sum, Real>(
      rows, vectors<Real>(step),
      {layer.outputs, deltas, weights, {before ? before->deltas : input_gradient, step}});
  if (before)
    with_activation(before->activation,
                    [&]<Activation kKind>() { deactivate_rows<Real, kKind>(*before, rows); });
}

template <class Real>
void backward(const NeuronLayer<Real>* layers, std::size_t count, std::size_t rows,
              Real* input_gradient) noexcept {
  for (std::size_t l = count; l-- > 0;) {
    const bool last = l + 1 == count;
    backward_weights(layers[l], rows, last);
    if (l > 0 || input_gradient)
      backward_deltas(layers[l], rows, last, l > 0 ? &layers[l - 1] : nullptr, input_gradient);
  }
}

/// The weights of a hidden layer, turned around; its biases, behind the weights, stay out of it.
template <class Real>
void transpose_hidden(const NeuronLayer<Real>& layer) {
  constexpr std::size_t kSize = kLanes<Real>;
  const std::size_t step = padded<Real>(layer.inputs);
  for (std::size_t i = 0; i < step; i += kSize)
    for (std::size_t n = 0; n < layer.columns; n += kSize) {
      Lanes<Real> square[kSize];
#pragma GCC unroll 16
      for (std::size_t k = 0; k < kSize; ++k)
        square[k] = i + k < layer.inputs ? load(layer.weights + (i + k) * layer.columns + n)
                                         : Lanes<Real>{};
      Shuffle<Real>::transpose(square);
#pragma GCC unroll 16
      for (std::size_t k = 0; k < kSize; ++k)
        store(layer.transposed + (n + k) * step + i, square[k]);
    }
}

template <class Real>
void transpose(const NeuronLayer<Real>* layers, std::size_t count) noexcept {
  for (std::size_t l = 0; l + 1 < count; ++l) transpose_hidden(layers[l]);
  const NeuronLayer<Real>& last = layers[count - 1];
  for (std::size_t n = 0; n < last.outputs; ++n)
    __builtin_memcpy(last.transposed + n * padded<Real>(last.inputs),
                     last.weights + n * last.columns, last.inputs * sizeof(Real));
}

}  // namespace
}  // namespace dashpot
