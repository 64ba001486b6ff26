#pragma once
#include <span>
#include <vector>

#include "dashpot/damper/nets/kernel.h"
#include "dashpot/damper/nets/mlp.h"

namespace dashpot {

/// A network's weights for blocks of samples.
template <class Real>
/// A network's weights as the kernels with samples as lanes want them: neuron by neuron, each row
/// ending with its bias. Owns them.
struct SampleLayers {
  std::vector<Real> weights;
  std::vector<SampleLayer<Real>> layers;  ///< point into weights

  explicit SampleLayers(const Mlp& mlp);
  SampleLayers(SampleLayers&&) = default;  // a copy's pointers would be wrong
  void set_parameters(std::span<const double> parameters);
};

}  // namespace dashpot
