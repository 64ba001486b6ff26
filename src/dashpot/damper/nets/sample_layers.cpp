#include "dashpot/damper/nets/sample_layers.h"

#include <algorithm>

namespace dashpot {

template <class Real>
SampleLayers<Real>::SampleLayers(const Mlp& mlp) : weights(Mlp::parameter_count(mlp.layers)) {
  const Real* at = weights.data();
  for (std::size_t layer = 1; layer < mlp.layers.size(); ++layer) {
    const std::size_t inputs = mlp.layers[layer - 1], outputs = mlp.layers[layer];
    layers.push_back({inputs, outputs, mlp.activation(layer), at});
    at += (inputs + 1) * outputs;
  }
  if (!mlp.parameters.empty()) set_parameters(mlp.parameters);
}

template <class Real>
void SampleLayers<Real>::set_parameters(std::span<const double> parameters) {
  const double* weight = parameters.data();
  Real* to = weights.data();
  for (const SampleLayer<Real>& layer : layers) {
    const double* bias = weight + layer.inputs * layer.outputs;
    for (std::size_t n = 0; n < layer.outputs; ++n, weight += layer.inputs) {
      to = std::transform(weight, weight + layer.inputs, to,
                          [](double w) { return static_cast<Real>(w); });
      *to++ = static_cast<Real>(bias[n]);
    }
    weight = bias + layer.outputs;
  }
}

template struct SampleLayers<float>;
template struct SampleLayers<double>;

}  // namespace dashpot
