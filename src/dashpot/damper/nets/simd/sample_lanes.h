#pragma once
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/nets/simd/activations.h"
#include "dashpot/damper/nets/simd/multiply.h"

// Kernels whose lanes are samples: many outputs per second, and Jacobians.
//
// Everything lies in rows of kBlock numbers, and lane s of each row belongs to sample s of the
// block: a row is one input, one neuron's activation or one derivative, of 64 samples at once. A
// layer is then a product of its weights (outputs x inputs) and the rows of its inputs, and no lane
// meets another until the sums over samples at the very end.
//
//   a block's rows    inputs | target | 1 where the sample counts, 0 where it fills the block
//   activations       first layer's neurons | second layer's | ... | the output
//   its Jacobian      parameters in the order of Mlp | residual | zeros up to `columns` rows, where
//                     a layer's parameters are its weights neuron by neuron, then its biases
//
// The Jacobian is filled from its end. The derivative of the output by a neuron's sum is that by
// its bias, so the rows of a layer's biases double as what is propagated backwards:
//
//   by_sums(l) = derivatives of the output by the sums of layer l = its rows of biases
//   row of weight (n, i) of layer l = by_sums(l)[n] * inputs(l)[i], lane by lane
//   by_sums(l - 1) = (W(l)' by_sums(l)) * activation'(l - 1)
//
// They start as the row of ones and zeros behind the targets, so that samples which only fill a
// block have zeros in every row. J'J is summed in tiles of kTall x kWide rows, over the lanes only
// at the end of a tile.
namespace dashpot {
namespace {

/// Vectors in a row of a block.
template <class Real>
constexpr std::size_t kBlockVectors = kBlock / kLanes<Real>;

/// One layer on a block: `in` has layer.inputs rows, `out` gets layer.outputs rows.
template <class Real>
void apply_layer(const SampleLayer<Real>& layer, const Real* in, Real* out) {
  // Sums start from the bias, which ends each neuron's weights. The product bounds them from below,
  // which is all that ReLU asks for; identity is bounded by minus infinity.
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

/// Turns kUsed inputs of a block around: sample by sample in memory, `step` numbers apart, they
/// become a row of samples each. Whole squares of kLanes x kLanes are transposed in registers; of
/// those the compiler leaves out what is not used. Reads whole vectors, so up to a vector beyond
/// the last sample.
template <std::size_t kUsed, class Real>
inline void turn_inputs(const Real* from, std::size_t step, Real* to) {
  constexpr std::size_t kSize = kLanes<Real>;
  static_assert(kUsed <= kSize && kSize <= 16, "one square of lanes, as far as loops are unrolled");
  for (std::size_t s = 0; s < kBlock; s += kSize) {
    Lanes<Real> square[kSize];
#pragma GCC unroll 16
    for (std::size_t k = 0; k < kSize; ++k) square[k] = load(from + (s + k) * step);
    Shuffle<Real>::transpose(square);
#pragma GCC unroll 16
    for (std::size_t k = 0; k < kUsed; ++k) store(to + k * kBlock + s, square[k]);
  }
}
/// All inputs of a block, kLanes at a time. The last few write up to kLanes rows, of which only
/// those that are inputs are read later.
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

/// Kernel::evaluate: layer after layer between the two halves of `room`.
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
    // add_errors left them where `passed`.
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

/// Derivatives by a layer's weights, outputs x inputs rows, from those by its sums.
void weight_rows(const SampleLayer<double>& layer, const double* in, const double* by_sums,
                 double* rows) {
  constexpr std::size_t kSize = kLanes<double>;
  for (std::size_t n = 0; n < layer.outputs; ++n, by_sums += kBlock)
    for (std::size_t i = 0; i < layer.inputs; ++i, rows += kBlock)
      for (std::size_t s = 0; s < kBlock; s += kSize)
        store(rows + s, load(by_sums + s) * load(in + i * kBlock + s));
}

/// Fills the rows of parameters and residual of a block's Jacobian, the last layer first.
void fill_jacobian(const JacobianBlocks& blocks, std::size_t index, double* jacobian) {
  constexpr std::size_t kSize = kLanes<double>;
  const double *rows = rows_of(blocks, index), *out = forward_block(blocks, index),
               *targets = rows + blocks.layers[0].inputs * kBlock;

  // The output's only bias is the last parameter: its row stands right before the residual's.
  double* const residual = jacobian + blocks.parameters * kBlock;
  double* by_sums = residual - kBlock;
  for (std::size_t s = 0; s < kBlock; s += kSize) {
    store(residual + s, residuals(out, targets, s));
    store(by_sums + s, load(targets + kBlock + s));
  }

  // Invariant: by_sums points at the rows of layer l's biases, which hold the derivatives of the
  // output by that layer's activations, and `out` at these activations.
  for (std::size_t l = blocks.count; l-- > 0;) {
    // From derivatives by activations to derivatives by sums.
    const SampleLayer<double>& layer = blocks.layers[l];
    with_activation(layer.activation, [&]<Activation kKind>() {
      deactivate<kKind>(by_sums, out, layer.outputs * kBlock);
    });

    // The layer's weights stand before its biases.
    double* const weights = by_sums - layer.outputs * layer.inputs * kBlock;
    const double* in = l > 0 ? out - layer.inputs * kBlock : rows;
    weight_rows(layer, in, by_sums, weights);
    if (l == 0) break;

    // The layer before has layer.inputs neurons, whose biases stand before these weights.
    double* const before = weights - layer.inputs * kBlock;
    multiply<Form::Sum, double>(
        layer.inputs, kBlockVectors<double>,
        {layer.outputs, {layer.weights, 1, layer.inputs + 1}, {by_sums, kBlock}, {before, kBlock}});
    by_sums = before;
    out = in;
  }
}

// Rows of the Jacobian in a tile of J'J. A tile takes kTall * kWide sums, kWide vectors of the
// right rows and one of the left: 21 of 32 registers, or 11 of 16.
constexpr std::size_t kTall = 4, kWide = kRegisters == 32 ? 4 : 2;
static_assert(kTall * kWide + kWide + 1 <= kRegisters, "a tile stays in registers");
static_assert(padded<double>(1) % kTall == 0 && padded<double>(1) % kWide == 0,
              "a tile that reaches beyond the last row ends within the rows of zeros");
static_assert(padded<double>(1) % kLanes<double> == 0, "so do the vectors of add_sums");

/// Adds scalar products of kTall rows from row a on with kColumns rows from row b on to `products`
/// (columns x columns), over all blocks.
template <std::size_t kColumns>
void add_tile(const JacobianBlocks& blocks, std::size_t a, std::size_t b, double* products) {
  constexpr std::size_t kSize = kLanes<double>, kCount = kTall * kColumns;
  static_assert(kCount % kSize == 0, "sums are folded into whole vectors of totals");
  Lanes<double> sums[kCount] = {};

  // Lane by lane over the samples of all blocks.
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

  // Then over the lanes, kSize sums at a time.
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

/// Adds the sum of each row of the Jacobian over all samples to `sums`, kLanes rows at a time.
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
  // The Jacobians of these few blocks first, so that tiles find them in the cache.
  for (std::size_t k = 0; k < blocks.blocks; ++k)
    fill_jacobian(blocks, k, blocks.jacobian + k * blocks.columns * kBlock);

  // Tiles of the upper triangle; what they hold below the diagonal is not read.
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
