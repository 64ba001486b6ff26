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

constexpr std::size_t kTall = 4, kWide = kRegisters == 32 ? 4 : 2;  // rows of the Jacobian in a tile of J'J

/// Scalar products of kTall rows at `a` with kWide rows at `b`, added to `products`.
void add_tile(const double* a, const double* b, double* products, std::size_t columns) {
  constexpr std::size_t kSize = kLanes<double>;
  Lanes<double> sums[kTall * kWide] = {};
  for (std::size_t s = 0; s < kBlock; s += kSize) {
    Lanes<double> right[kWide];
#pragma GCC unroll 4
    for (std::size_t j = 0; j < kWide; ++j) right[j] = load(b + j * kBlock + s);
#pragma GCC unroll 4
    for (std::size_t i = 0; i < kTall; ++i) {
      const Lanes<double> left = load(a + i * kBlock + s);
#pragma GCC unroll 4
      for (std::size_t j = 0; j < kWide; ++j) sums[i * kWide + j] += left * right[j];
    }
  }
  double totals[kTall * kWide];
#pragma GCC unroll 8
  for (std::size_t k = 0; k < kTall * kWide; k += kSize) store(totals + k, Shuffle<double>::sums(sums + k));
#pragma GCC unroll 4
  for (std::size_t i = 0; i < kTall; ++i)
#pragma GCC unroll 4
    for (std::size_t j = 0; j < kWide; ++j) products[i * columns + j] += totals[i * kWide + j];
}

void add_products(const JacobianBlock& block, double* products, double* sums) noexcept {
  constexpr std::size_t kSize = kLanes<double>;
  fill_jacobian(block);
  const std::size_t columns = block.columns, rows = block.parameters + 1;
  for (std::size_t a = 0; a < rows; a += kTall)
    for (std::size_t b = a; b < rows; b += kWide)
      add_tile(block.jacobian + a * kBlock, block.jacobian + b * kBlock, products + a * columns + b, columns);
  for (std::size_t p = 0; p < rows; p += kSize) {
    Lanes<double> totals[kSize] = {};
    for (std::size_t s = 0; s < kBlock; s += kSize)
#pragma GCC unroll 8
      for (std::size_t k = 0; k < kSize; ++k) totals[k] += load(block.jacobian + (p + k) * kBlock + s);
    store(sums + p, load(sums + p) + Shuffle<double>::sums(totals));
  }
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
