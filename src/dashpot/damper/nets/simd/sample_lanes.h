#pragma once
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/nets/simd/activations.h"
#include "dashpot/damper/nets/simd/multiply.h"

namespace dashpot {
namespace {

template <class Real>
constexpr std::size_t kBlockVectors = kBlock / kLanes<Real>;

template <class Real>
void apply_layer(const SampleLayer<Real>& layer, const Real* in, Real* out) {
  const std::size_t step = layer.inputs + 1;
  const Real bound = layer.activation == Activation::Relu ? 0 : static_cast<Real>(-__builtin_inf());
  multiply<Form::Samples, Real>(layer.outputs, kBlockVectors<Real>,
                                {layer.inputs,
                                 {layer.weights, step, 1},
                                 {in, kBlock},
                                 {out, kBlock},
                                 {layer.weights + layer.inputs, step},
                                 {&bound, 0}});
  if (!is_bound(layer.activation))
    with_activation(layer.activation,
                    [&]<Activation kKind>() { activate<kKind>(out, layer.outputs * kBlock); });
}

/// Inputs of a block, row by row in memory -> a row of samples each. kUsed of them, a power of two,
/// beginning at `from`; in registers whole squares are turned around, of which the compiler leaves
/// out what is not used.
template <std::size_t kUsed, class Real>
inline void turn_inputs(const Real* from, std::size_t step, Real* to) {
  constexpr std::size_t kSize = kLanes<Real>;
  for (std::size_t s = 0; s < kBlock; s += kSize) {
    Lanes<Real> square[kSize];
#pragma GCC unroll 16
    for (std::size_t k = 0; k < kSize; ++k) square[k] = load(from + (s + k) * step);
    Shuffle<Real>::transpose(square);
#pragma GCC unroll 16
    for (std::size_t k = 0; k < kUsed; ++k) store(to + k * kBlock + s, square[k]);
  }
}
template <class Real>
void take_inputs(const Real* rows, std::size_t inputs, Real* to) {
  constexpr std::size_t kSize = kLanes<Real>, kSome = kSize > 8 ? 8 : kSize;
  for (std::size_t i = 0; i < inputs; i += kSize, rows += kSize, to += kSize * kBlock) {
    const std::size_t left = inputs - i;
    if (left <= 2)
      turn_inputs<2>(rows, inputs, to);
    else if (left <= kSome)
      turn_inputs<kSome>(rows, inputs, to);
    else
      turn_inputs<kSize>(rows, inputs, to);
  }
}

template <class Real>
const Real* evaluate(const SampleLayer<Real>* layers, std::size_t count, const Real* inputs,
                     Real* room) noexcept {
  Real *from = room, *to = room + kRoomRows * kBlock;
  take_inputs(inputs, layers[0].inputs, from);
  for (std::size_t l = 0; l < count; ++l) {
    apply_layer(layers[l], from, to);
    Real* const swapped = from;
    from = to;
    to = swapped;
  }
  return from;
}

/// Rows of block `index`.
inline const double* rows_of(const JacobianBlocks& blocks, std::size_t index) {
  return blocks.rows + index * (blocks.layers[0].inputs + 2) * kBlock;
}

/// Fills the activations of all layers on block `index` and returns those of the output.
const double* forward_block(const JacobianBlocks& blocks, std::size_t index) {
  const double* in = rows_of(blocks, index);
  double* out = blocks.activations + index * blocks.activation_step;
  for (std::size_t l = 0; l < blocks.count; ++l) {
    if (!blocks.passed) apply_layer(blocks.layers[l], in, out);
    in = out;
    out += blocks.layers[l].outputs * kBlock;
  }
  return in;
}

/// The residuals of kLanes samples from number s on; 0 where a sample does not count.
inline Lanes<double> residuals(const double* out, const double* targets, std::size_t s) {
  return (load(out + s) - load(targets + s)) * load(targets + kBlock + s);
}

/// Derivatives by a layer's weights, from those by its sums (which are those by its biases).
void weight_rows(const SampleLayer<double>& layer, const double* in, const double* by_sums,
                 double* rows) {
  constexpr std::size_t kSize = kLanes<double>;
  for (std::size_t n = 0; n < layer.outputs; ++n, by_sums += kBlock)
    for (std::size_t i = 0; i < layer.inputs; ++i, rows += kBlock)
      for (std::size_t s = 0; s < kBlock; s += kSize)
        store(rows + s, load(by_sums + s) * load(in + i * kBlock + s));
}

/// Rows of a block's Jacobian, last layer first, and the residual behind them.
void fill_jacobian(const JacobianBlocks& blocks, std::size_t index, double* jacobian) {
  constexpr std::size_t kSize = kLanes<double>;
  const double *rows = rows_of(blocks, index), *out = forward_block(blocks, index),
               *targets = rows + blocks.layers[0].inputs * kBlock;
  double* const residual = jacobian + blocks.parameters * kBlock;
  double* by_sums = residual - kBlock;
  for (std::size_t s = 0; s < kBlock; s += kSize) {
    store(residual + s, residuals(out, targets, s));
    store(by_sums + s, load(targets + kBlock + s));
  }
  for (std::size_t l = blocks.count; l-- > 0;) {
    const SampleLayer<double>& layer = blocks.layers[l];
    with_activation(layer.activation, [&]<Activation kKind>() {
      deactivate<kKind>(by_sums, out, layer.outputs * kBlock);
    });
    double* const weights = by_sums - layer.outputs * layer.inputs * kBlock;
    const double* in = l > 0 ? out - layer.inputs * kBlock : rows;
    weight_rows(layer, in, by_sums, weights);
    if (l == 0) break;
    double* const before = weights - layer.inputs * kBlock;
    multiply<Form::Sum, double>(
        layer.inputs, kBlockVectors<double>,
        {layer.outputs, {layer.weights, 1, layer.inputs + 1}, {by_sums, kBlock}, {before, kBlock}});
    by_sums = before;
    out = in;
  }
}

constexpr std::size_t kTall = 4,
                      kWide = kRegisters == 32 ? 4 : 2;  // rows of the Jacobian in a tile of J'J

/// Scalar products of kTall rows from row a on with kColumns rows from row b on, added to
/// `products`.
template <std::size_t kColumns>
void add_tile(const JacobianBlocks& blocks, std::size_t a, std::size_t b, double* products) {
  constexpr std::size_t kSize = kLanes<double>, kCount = kTall * kColumns;
  Lanes<double> sums[kCount] = {};
  const double* block = blocks.jacobian;
  for (std::size_t k = 0; k < blocks.blocks; ++k, block += blocks.columns * kBlock)
    for (std::size_t s = 0; s < kBlock; s += kSize) {
      Lanes<double> right[kColumns];
#pragma GCC unroll 4
      for (std::size_t j = 0; j < kColumns; ++j) right[j] = load(block + (b + j) * kBlock + s);
#pragma GCC unroll 4
      for (std::size_t i = 0; i < kTall; ++i) {
        const Lanes<double> left = load(block + (a + i) * kBlock + s);
#pragma GCC unroll 4
        for (std::size_t j = 0; j < kColumns; ++j) sums[i * kColumns + j] += left * right[j];
      }
    }
  double totals[kCount];
#pragma GCC unroll 8
  for (std::size_t k = 0; k < kCount; k += kSize)
    store(totals + k, Shuffle<double>::sums(sums + k));
  products += a * blocks.columns + b;
#pragma GCC unroll 4
  for (std::size_t i = 0; i < kTall; ++i)
#pragma GCC unroll 4
    for (std::size_t j = 0; j < kColumns; ++j)
      products[i * blocks.columns + j] += totals[i * kColumns + j];
}

void add_sums(const JacobianBlocks& blocks, double* sums) {
  constexpr std::size_t kSize = kLanes<double>;
  for (std::size_t p = 0; p <= blocks.parameters; p += kSize) {
    Lanes<double> totals[kSize] = {};
    const double* block = blocks.jacobian + p * kBlock;
    for (std::size_t k = 0; k < blocks.blocks; ++k, block += blocks.columns * kBlock)
      for (std::size_t s = 0; s < kBlock; s += kSize)
#pragma GCC unroll 8
        for (std::size_t j = 0; j < kSize; ++j) totals[j] += load(block + j * kBlock + s);
    store(sums + p, load(sums + p) + Shuffle<double>::sums(totals));
  }
}

void add_products(const JacobianBlocks& blocks, double* products, double* sums) noexcept {
  for (std::size_t k = 0; k < blocks.blocks; ++k)
    fill_jacobian(blocks, k, blocks.jacobian + k * blocks.columns * kBlock);
  const std::size_t rows = blocks.parameters + 1;
  for (std::size_t a = 0; a < rows; a += kTall) {
    std::size_t b = a;
    for (; b + kWide / 2 < rows; b += kWide) add_tile<kWide>(blocks, a, b, products);
    if (b < rows) add_tile<kWide / 2>(blocks, a, b, products);
  }
  if (sums) add_sums(blocks, sums);
}

void add_errors(const JacobianBlocks& blocks, double sums[2]) noexcept {
  Lanes<double> sum{}, squares{};
  for (std::size_t k = 0; k < blocks.blocks; ++k) {
    const double* const rows = rows_of(blocks, k);
    const double *out = forward_block(blocks, k),
                 *targets = rows + blocks.layers[0].inputs * kBlock;
    for (std::size_t s = 0; s < kBlock; s += kLanes<double>) {
      const Lanes<double> residual = residuals(out, targets, s);
      sum += residual;
      squares += residual * residual;
    }
  }
  sums[0] += Shuffle<double>::sum(sum);
  sums[1] += Shuffle<double>::sum(squares);
}

}  // namespace
}  // namespace dashpot
