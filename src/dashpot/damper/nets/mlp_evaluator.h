#pragma once
#include <span>

#include "dashpot/damper/nets/padded_network.h"
#include "dashpot/damper/nets/sample_layers.h"

namespace dashpot {

/// The same network on raw inputs: its first layer standardises in passing. That loses no more
/// digits than an input far from zero has lost when it was rounded.
Mlp on_raw_inputs(Mlp mlp);

/// A network ready to run fast, in raw units; Real is float or double. Safe from several threads.
template <class Real>
/// A network with one output, ready to run fast on raw inputs, in raw units; Real is float or
/// double. Owns copies of the weights. Safe from several threads.
class MlpEvaluator {
 public:
  explicit MlpEvaluator(const Mlp& mlp, SimdLevel level = simd_levels().back());

  /// Output at one input (inputs of the network numbers), as soon as possible. Allocates nothing.
  Real evaluate(const Real* input) const noexcept;
  /// Outputs at many inputs (outputs.size() rows), as many per second as possible. Allocates
  /// nothing; takes 192 KiB of the stack in double precision, and reads nothing beyond `inputs`.
  void evaluate(std::span<const Real> inputs, std::span<Real> outputs) const noexcept;

 private:
  /// For one input AVX2 at most: each layer reads at once what the one before has just stored, and
  /// 64-byte stores are slow at that.
  const Kernel<Real>& one_kernel_;
  const Kernel<Real>& many_kernel_;
  PaddedNetwork<Real> single_;  ///< neurons as lanes
  SampleLayers<Real> many_;     ///< samples as lanes
  Real output_mean_, output_scale_;
};

}  // namespace dashpot
