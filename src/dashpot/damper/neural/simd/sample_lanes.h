#pragma once
#include "dashpot/damper/neural/kernel.h"
#include "dashpot/damper/neural/simd/activations.h"
#include "dashpot/damper/neural/simd/multiply.h"

namespace dashpot {
namespace {

template <class Real>
constexpr std::size_t kBlockVectors = kBlock / kLanes<Real>;

/// A layer on a block; behind its outputs goes the row of ones that the next layer's biases meet.
template <class Real>
void apply_layer(const SampleLayer<Real>& layer, const Real* in, Real* out) {
  multiply<Real>(
      layer.outputs, kBlockVectors<Real>,
      {layer.inputs + 1, {layer.weights, layer.inputs + 1, 1}, {in, kBlock}, zeros<Real>(), {out, kBlock}});
  const std::size_t size = layer.outputs * kBlock;
  with_activation(layer.activation, [&]<Activation kKind>() { activate<kKind>(out, size); });
  for (std::size_t s = 0; s < kBlock; ++s) out[size + s] = 1;
}

template <class Real>
const Real* evaluate(const SampleLayer<Real>* layers, std::size_t count, Real* from, Real* to) noexcept {
  for (std::size_t l = 0; l < count; ++l) {
    apply_layer(layers[l], from, to);
    Real* const swapped = from;
    from = to;
    to = swapped;
  }
  return from;
}

/// Fills the activations of all layers and returns those of the output.
const double* forward_block(const JacobianBlock& block) {
  double* in = block.activations;
  for (std::size_t l = 0; l < block.count; ++l) {
    double* out = in + (block.layers[l].inputs + 1) * kBlock;
    apply_layer(block.layers[l], in, out);
    in = out;
  }
  return in;
}

/// Derivatives by a layer's weights, from those by its sums (which are those by its biases).
void weight_rows(const SampleLayer<double>& layer, const double* in, const double* by_sums, double* rows) {
  constexpr std::size_t kSize = kLanes<double>;
  for (std::size_t n = 0; n < layer.outputs; ++n, by_sums += kBlock)
    for (std::size_t i = 0; i < layer.inputs; ++i, rows += kBlock)
      for (std::size_t s = 0; s < kBlock; s += kSize)
        store(rows + s, load(by_sums + s) * load(in + i * kBlock + s));
}

/// Rows of the Jacobian, last layer first, and the residual behind them.
void fill_jacobian(const JacobianBlock& block) {
  constexpr std::size_t kSize = kLanes<double>;
  const double* out = forward_block(block);
  double* const residual = block.jacobian + block.parameters * kBlock;
  double* by_sums = residual - kBlock;
  for (std::size_t s = 0; s < kBlock; s += kSize) {
    store(residual + s, (load(out + s) - load(block.targets + s)) * load(block.counts + s));
    store(by_sums + s, load(block.counts + s));
  }
  for (std::size_t l = block.count; l-- > 0;) {
    const SampleLayer<double>& layer = block.layers[l];
    with_activation(layer.activation,
                    [&]<Activation kKind>() { deactivate<kKind>(by_sums, out, layer.outputs * kBlock); });
    double* const weights = by_sums - layer.outputs * layer.inputs * kBlock;
    const double* in = out - (layer.inputs + 1) * kBlock;
    weight_rows(layer, in, by_sums, weights);
    if (l == 0) break;
    double* const before = weights - layer.inputs * kBlock;
    multiply<double>(layer.inputs, kBlockVectors<double>,
                     {layer.outputs,
                      {layer.weights, 1, layer.inputs + 1},
                      {by_sums, kBlock},
                      zeros<double>(),
                      {before, kBlock}});
    by_sums = before;
    out = in;
  }
}

void transpose_jacobian(const JacobianBlock& block) {
  constexpr std::size_t kSize = kLanes<double>;
  for (std::size_t p = 0; p < block.columns; p += kSize)
    for (std::size_t s = 0; s < kBlock; s += kSize) {
      Lanes<double> square[kSize];
#pragma GCC unroll 8
      for (std::size_t k = 0; k < kSize; ++k) square[k] = load(block.jacobian + (p + k) * kBlock + s);
      Shuffle<double>::transpose(square);
#pragma GCC unroll 8
      for (std::size_t k = 0; k < kSize; ++k)
        store(block.transposed + (s + k) * block.columns + p, square[k]);
    }
}

void add_products(const JacobianBlock& block, double* products, double* sums) noexcept {
  fill_jacobian(block);
  transpose_jacobian(block);
  const std::size_t columns = block.columns, rows = block.parameters + 1;
  const Left<double> left{block.transposed, 1, columns};
  constexpr std::size_t kWide = 2, kStep = kWide * kLanes<double>;
  for (std::size_t first = 0; first < columns; first += kStep) {
    const std::size_t wide = columns - first < kStep ? 1 : kWide, end = first + wide * kLanes<double>;
    multiply<double>(end < rows ? end : rows, wide,
                     {kBlock,
                      left,
                      {block.transposed + first, columns},
                      {products + first, columns},
                      {products + first, columns}});
  }
  multiply<double>(
      1, columns / kLanes<double>,
      {kBlock, {block.counts, 0, 1}, {block.transposed, columns}, {sums, columns}, {sums, columns}});
}

void add_errors(const JacobianBlock& block, double sums[2]) noexcept {
  const double* out = forward_block(block);
  Lanes<double> sum{}, squares{};
  for (std::size_t s = 0; s < kBlock; s += kLanes<double>) {
    const Lanes<double> residual = (load(out + s) - load(block.targets + s)) * load(block.counts + s);
    sum += residual;
    squares += residual * residual;
  }
  sums[0] += Shuffle<double>::sum(sum);
  sums[1] += Shuffle<double>::sum(squares);
}

}  // namespace
}  // namespace dashpot
