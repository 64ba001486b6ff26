#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "dashpot/damper/nets/activation.h"

namespace dashpot {

/// The small-network kernel: every loop over lanes that training and evaluating networks spend
/// their time in, compiled once per instruction set (simd/) and handed out as tables of functions.
///
/// There are two layouts. With neurons as lanes (NeuronLayer) a pass holds any number of samples
/// and can go backwards: for training on mini-batches, and for one sample as soon as possible. With
/// samples as lanes (SampleLayer) a pass holds blocks of kBlock samples: for evaluating many of
/// them and for Jacobians. The kernel owns no memory; PaddedNetwork, SampleLayers and BlockErrors
/// do. Results differ between instruction sets by rounding, never between runs or numbers of
/// threads.

/// Instruction sets for which the kernel is compiled, the widest last.
enum class SimdLevel { Baseline, Avx2, Avx512 };
/// Those that this processor runs, the fastest last.
const std::vector<SimdLevel>& simd_levels();
/// "sse2" (on other processors: whatever the compiler takes as the least), "avx2", "avx512".
std::string_view name_of(SimdLevel level);
/// From now on simd_levels() ends at this level, so that unlike processors give the same bits. To
/// be called before any work begins. Throws Error, which names who asked, where this processor does
/// not run it.
void use_simd(std::string_view name, const std::string& asked_by);

constexpr std::size_t kMaxWidth = 128;  ///< of a layer

/// Rows in the kernel's buffers are whole multiples of this many bytes, a cache line, whatever the
/// instruction set.
constexpr std::size_t kKernelAlign = 64;
/// `count` rounded up to whole cache lines of Real.
template <class Real>
constexpr std::size_t padded(std::size_t count) {
  constexpr std::size_t kLanes = kKernelAlign / sizeof(Real);
  return (count + kLanes - 1) / kLanes * kLanes;
}

/// A layer whose neurons are the lanes. All rows are padded to whole cache lines:
///
///   weights, hidden layer   (inputs + 1) rows of `columns`: one row of neurons per input, then the
///                           row of biases
///   weights, output layer   outputs rows of `columns` = in_step: a neuron's inputs, then its bias
///   in                      samples rows of in_step: the inputs, a 1, zeros. The 1 meets the bias
///   out, hidden layer       the next layer's `in`
///   out, output layer       outputs rows of out_step: one row of samples per neuron
///   deltas                  hidden layer: samples rows of `columns`; output layer: as out
///   transposed              padded(outputs) rows of padded(inputs)
///
/// Padding of weights is zero and stays zero in training, so that padded neurons give 0.
template <class Real>
struct NeuronLayer {
  std::size_t inputs, outputs;
  Activation activation;
  std::size_t in_step;       ///< padded(inputs + 1): from sample to sample
  std::size_t out_step;      ///< padded(outputs + 1); last layer: samples, from neuron to neuron
  std::size_t columns;       ///< of weights: padded(outputs); last layer: in_step
  Real *weights, *gradient;  ///< (inputs + 1) x columns; last layer: outputs x columns
  Real* transposed;  ///< weights for the way back, no biases: padded(outputs) x padded(inputs)
  Real *in, *out;    ///< activations; out of a layer is in of the next
  Real* deltas;      ///< of the loss by the sums: samples x columns; last: as out
  const Real *counts, *ones;  ///< columns: 1 for a neuron; 1 behind the last one
  const Real* bounds;  ///< columns: below which no activation lies (with ReLU 0; 1 behind the last)
};

/// How a training step moves the weights.
enum class Optimiser { Sgd, Momentum, RmsProp, Adam, AdamW };
/// The numbers of one training step on flat arrays.
template <class Real>
struct UpdateRule {
  Optimiser optimiser;
  Real rate;                   ///< with Adam's correction for the start
  Real epsilon;                ///< likewise
  Real momentum, mean_square;  ///< shares of the averages that are kept
  Real l1, l2, decay;          ///< of the loss; of the weights themselves, per step
};

/// A layer whose samples are the lanes: weights neuron by neuron, each row ending with its bias.
template <class Real>
struct SampleLayer {
  std::size_t inputs, outputs;
  Activation activation;
  const Real* weights;  ///< outputs x (inputs + 1)
};
/// Samples of a block. Between layers a block is one row of kBlock numbers per neuron.
constexpr std::size_t kBlock = 64;
static_assert(kBlock % padded<float>(1) == 0 && kBlock % padded<double>(1) == 0,
              "a row of a block is whole cache lines, so whole vectors of any instruction set");
/// Rows of kBlock that a layer may fill: the widest, or inputs that come by whole cache lines.
constexpr std::size_t kRoomRows = kMaxWidth;

/// The loops over lanes, compiled for one instruction set. None allocates or throws.
template <class Real>
struct Kernel {
  /// Fills the activations of `rows` samples from those of the first layer's `in`.
  void (*forward)(const NeuronLayer<Real>* layers, std::size_t count, std::size_t rows) noexcept;
  /// From the last layer's deltas (of the loss by its outputs) to the gradients of all layers. When
  /// input_gradient is not null, also that by the inputs: samples x padded(inputs).
  void (*backward)(const NeuronLayer<Real>* layers, std::size_t count, std::size_t rows,
                   Real* input_gradient) noexcept;
  /// Brings `transposed` up to date with `weights`.
  void (*transpose)(const NeuronLayer<Real>* layers, std::size_t count) noexcept;
  /// `count` is a multiple of the padding.
  void (*update)(const UpdateRule<Real>& rule, std::size_t count, Real* weights,
                 const Real* gradient, Real* mean, Real* square) noexcept;
  /// The output of a network with one output at one input. Reads weights, counts, ones and bounds
  /// only.
  Real (*respond)(const NeuronLayer<Real>* layers, std::size_t count, const Real* input) noexcept;
  /// Outputs of kBlock samples, whose inputs stand row by row and are read up to kKernelAlign bytes
  /// beyond the last. `room` is for twice kRoomRows rows of kBlock. Returns where in it the outputs
  /// stand.
  const Real* (*evaluate)(const SampleLayer<Real>* layers, std::size_t count, const Real* inputs,
                          Real* room) noexcept;
};
/// The kernel for a level in simd_levels().
template <class Real>
const Kernel<Real>& kernel(SimdLevel level);

/// Blocks of samples, one behind the other, of a network with one output, on which its residuals
/// are linearised. simd/sample_lanes.h shows the rows of a block and of its Jacobian.
struct JacobianBlocks {
  const SampleLayer<double>* layers;
  std::size_t count;
  std::size_t parameters, columns;  ///< columns = padded(parameters + 1)
  const double* rows;   ///< of a block: its inputs, targets, and 1 where a sample counts, else 0
  std::size_t blocks;   ///< for add_products at most kBlocksAtOnce
  double* activations;  ///< all layers' rows, of one block or of each
  std::size_t activation_step;  ///< from block to block; 0: only one has room
  bool passed;                  ///< add_products finds them, as add_errors left them
  double* jacobian;  ///< blocks x columns x kBlock: parameters in the order of Mlp, residual, zeros
};
/// Blocks whose Jacobians are filled before their products are taken: enough for sums over lanes to
/// cost little, few enough for the Jacobians to stay in the second-level cache.
constexpr std::size_t kBlocksAtOnce = 4;

/// Rows of numbers, one behind the other, for a Gram matrix.
struct GramRows {
  const double* at;
  std::size_t count, columns;  ///< columns: whole cache lines, best an odd number of them
};
/// Rows of a Gram matrix that are made at a time.
constexpr std::size_t kGramStrip = 24;

/// Sums over samples, for normal equations. Nothing is cleared first: all add.
struct JacobianKernel {
  /// Adds [J r]' [J r] (columns x columns, the upper triangle); to `sums`, unless it is null, the
  /// sums of J and r over the samples.
  void (*add_products)(const JacobianBlocks& blocks, double* products, double* sums) noexcept;
  /// Adds the sum of the residuals and that of their squares.
  void (*add_errors)(const JacobianBlocks& blocks, double sums[2]) noexcept;
  /// Adds X'X of the rows X to `gram` (columns x columns, the upper triangle). `room` is for
  /// kGramStrip rows.
  void (*add_gram)(const GramRows& rows, double* gram, double* room) noexcept;
  /// Derivatives go from step to step: to = by * from, where `count` rows of `columns` numbers
  /// (whole cache lines) become as many by the first `count` numbers of each row of `by`.
  void (*carry)(std::size_t count, std::size_t columns, const double* by, std::size_t by_step,
                const double* from, double* to) noexcept;
};
/// The Jacobian kernel for a level in simd_levels().
const JacobianKernel& jacobian_kernel(SimdLevel level);

}  // namespace dashpot
