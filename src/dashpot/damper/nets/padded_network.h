#pragma once
#include <span>
#include <vector>

#include "dashpot/damper/nets/aligned.h"
#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/nets/mlp.h"

namespace dashpot {

/// The layers of a network as the kernel wants them, and room for passes over mini-batches:
/// forward, and backward to the gradient. Standardised units, any number of outputs. Not safe from
/// several threads.
template <class Real>
/// The layers of a network as the kernel wants them, and room for passes over mini-batches:
/// forward, and backward to the gradient. Standardised units, any number of outputs. Owns all its
/// arrays, which NeuronLayer describes. Not safe from several threads.
class PaddedNetwork {
 public:
  /// `samples`: most that a pass will hold (0: no passes). `level`: one of simd_levels().
  PaddedNetwork(const Mlp& mlp, std::size_t samples, SimdLevel level);
  PaddedNetwork(PaddedNetwork&&) = default;  // a copy's pointers would be wrong

  std::size_t inputs() const { return layers_.front().inputs; }
  std::size_t outputs() const { return layers_.back().outputs; }
  std::span<const NeuronLayer<Real>> layers() const { return layers_; }

  /// Parameters and gradient in the order of Mlp.
  void set_parameters(std::span<const double> parameters);
  void get_parameters(std::span<double> parameters) const;
  void get_gradient(std::span<double> gradient) const;

  /// Room for the inputs of a sample, to be filled before forward(). Two rows lie input_step()
  /// numbers apart, and a row may be copied over with what lies behind its inputs: a 1, then zeros.
  Real* input(std::size_t sample) { return layers_.front().in + sample * input_step(); }
  std::size_t input_step() const { return layers_.front().in_step; }
  /// Outputs of one output neuron, a number per sample: forward() fills it.
  const Real* output(std::size_t neuron) const {
    return layers_.back().out + neuron * layers_.back().out_step;
  }
  /// Room for the derivatives of the loss by the outputs of one output neuron, a number per sample:
  /// to be filled before backward(), which changes it.
  Real* output_slope(std::size_t neuron) {
    return layers_.back().deltas + neuron * layers_.back().out_step;
  }

  void forward(std::size_t samples) { kernel_.forward(layers_.data(), layers_.size(), samples); }
  /// After forward() on the same samples: the gradient. When `by_inputs` is given, also the
  /// derivatives by the inputs: samples x padded<Real>(inputs()).
  void backward(std::size_t samples, Real* by_inputs = nullptr);

  /// A training step along the last gradient. `mean` and `square`: size() zeros at first.
  void update(const UpdateRule<Real>& rule, AlignedVector<Real>& mean, AlignedVector<Real>& square);
  std::size_t size() const { return size_; }

 private:
  void place_weights();
  void place_passes(std::size_t samples);

  const Kernel<Real>& kernel_;
  std::vector<NeuronLayer<Real>> layers_;
  std::vector<std::size_t> place_;  ///< of each parameter in weights_
  AlignedVector<Real> weights_, gradient_, transposed_, lanes_, passes_;
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t size_ = 0;                 ///< of weights_, without what is only read over
  std::size_t transposed_from_ = kNone;  ///< first layer whose transposed weights are up to date
};

}  // namespace dashpot
