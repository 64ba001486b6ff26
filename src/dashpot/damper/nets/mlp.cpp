#include "dashpot/damper/nets/mlp.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "dashpot/base/random.h"

namespace dashpot {
namespace {

double activated(Activation kind, double sum) {
  switch (kind) {
    case Activation::Relu:
      return sum < 0 ? 0 : sum;
    case Activation::Tanh:
      return std::tanh(sum);
    case Activation::Sigmoid:
      return 1 / (1 + std::exp(-sum));
    default:
      return sum;
  }
}

}  // namespace

std::size_t Mlp::parameter_count(const std::vector<std::size_t>& layers) {
  std::size_t count = 0;
  for (std::size_t layer = 1; layer < layers.size(); ++layer)
    count += (layers[layer - 1] + 1) * layers[layer];
  return count;
}

Activation Mlp::activation(std::size_t layer) const {
  if (!activations.empty()) return activations[layer - 1];
  return layer + 1 < layers.size() ? Activation::Tanh : Activation::Identity;
}

double Mlp::evaluate(const double* input) const noexcept {
  double buffers[2][kMaxWidth];
  double *from = buffers[0], *to = buffers[1];
  for (std::size_t i = 0; i < layers.front(); ++i)
    from[i] = (input[i] - input_mean[i]) / input_scale[i];

  const double* weight = parameters.data();
  for (std::size_t layer = 1; layer < layers.size(); ++layer) {
    const std::size_t inputs = layers[layer - 1], outputs = layers[layer];
    const double* bias = weight + inputs * outputs;
    for (std::size_t n = 0; n < outputs; ++n) {
      to[n] = bias[n];
      for (std::size_t i = 0; i < inputs; ++i) to[n] += *weight++ * from[i];
    }
    for (std::size_t n = 0; n < outputs; ++n) to[n] = activated(activation(layer), to[n]);
    weight = bias + outputs;
    std::swap(from, to);
  }
  return output_mean + output_scale * from[0];
}

namespace {

/// Weights of a layer of `outputs` neurons on inputs that span `range`: a row per neuron, of a
/// length that lets the neurons share the range, in a random direction; biases within +-steepness.
/// After Nguyen and Widrow.
void nguyen_widrow(Random& random, double* weight, std::size_t inputs, std::size_t outputs,
                   double range) {
  const double steepness =
      0.7 * std::pow(static_cast<double>(outputs), 1.0 / static_cast<double>(inputs));
  double* bias = weight + inputs * outputs;
  for (std::size_t n = 0; n < outputs; ++n, weight += inputs) {
    double squares = 0;
    for (std::size_t i = 0; i < inputs; ++i) {
      weight[i] = random.uniform(-1, 1);
      squares += weight[i] * weight[i];
    }
    for (std::size_t i = 0; i < inputs; ++i) weight[i] *= steepness / (range * std::sqrt(squares));
    bias[n] = random.uniform(-steepness, steepness);
  }
}

}  // namespace

Mlp without_weights(std::size_t inputs, const std::vector<std::size_t>& hidden, Activation kind) {
  Mlp mlp;
  mlp.layers.push_back(inputs);
  mlp.layers.insert(mlp.layers.end(), hidden.begin(), hidden.end());
  mlp.layers.push_back(1);
  mlp.activations.assign(hidden.size(), kind);
  mlp.activations.push_back(Activation::Identity);
  return mlp;
}

void initialise(Mlp& mlp, std::uint64_t seed) {
  assert(mlp.layers.size() >= 2);
  constexpr double kInputRange = 2;  // standardised inputs lie within about two standard deviations
  Random random(seed);
  mlp.parameters.assign(Mlp::parameter_count(mlp.layers), 0.0);
  double* weight = mlp.parameters.data();
  for (std::size_t layer = 1; layer < mlp.layers.size(); ++layer) {
    const std::size_t inputs = mlp.layers[layer - 1], outputs = mlp.layers[layer];
    const Activation kind = mlp.activation(layer);
    const bool last = layer + 1 == mlp.layers.size();

    // Saturating layers share out the range of their inputs; others keep the variance.
    if (!last && (kind == Activation::Tanh || kind == Activation::Sigmoid)) {
      nguyen_widrow(random, weight, inputs, outputs, layer == 1 ? kInputRange : 1);
    } else {
      const double spread = std::sqrt((last ? 1 : 6) / static_cast<double>(inputs));
      for (std::size_t k = 0; k < inputs * outputs; ++k)
        weight[k] = random.uniform(-spread, spread);
    }
    weight += (inputs + 1) * outputs;
  }
}

}  // namespace dashpot
