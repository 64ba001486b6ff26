#include "dashpot/damper/neural/mlp.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "dashpot/base/random.h"
#include "dashpot/damper/neural/tanh.h"

namespace dashpot {

std::size_t Mlp::parameter_count(const std::vector<std::size_t>& layers) {
  std::size_t count = 0;
  for (std::size_t layer = 1; layer < layers.size(); ++layer)
    count += (layers[layer - 1] + 1) * layers[layer];
  return count;
}

double Mlp::evaluate(const double* input) const noexcept {
  double buffers[2][kMaxWidth];
  double *from = buffers[0], *to = buffers[1];
  for (std::size_t i = 0; i < layers.front(); ++i) from[i] = (input[i] - input_mean[i]) / input_scale[i];

  const double* weight = parameters.data();
  for (std::size_t layer = 1; layer < layers.size(); ++layer) {
    const std::size_t inputs = layers[layer - 1], outputs = layers[layer];
    const double* bias = weight + inputs * outputs;
    for (std::size_t n = 0; n < outputs; ++n) {
      to[n] = bias[n];
      for (std::size_t i = 0; i < inputs; ++i) to[n] += *weight++ * from[i];
    }
    if (layer + 1 < layers.size())
      for (std::size_t n = 0; n < outputs; ++n) to[n] = branchless_tanh(to[n]);
    weight = bias + outputs;
    std::swap(from, to);
  }
  return output_mean + output_scale * from[0];
}

void initialise(Mlp& mlp, std::uint64_t seed) {
  assert(mlp.layers.size() >= 2 && mlp.layers.back() == 1);
  constexpr double kInputRange = 2;  // standardised inputs lie within about two standard deviations
  Random random(seed);
  mlp.parameters.assign(Mlp::parameter_count(mlp.layers), 0.0);
  double* weight = mlp.parameters.data();
  for (std::size_t layer = 1; layer + 1 < mlp.layers.size(); ++layer) {
    const std::size_t inputs = mlp.layers[layer - 1], outputs = mlp.layers[layer];
    const double steepness = 0.7 * std::pow(static_cast<double>(outputs), 1.0 / static_cast<double>(inputs));
    const double range = layer == 1 ? kInputRange : 1;
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
    weight = bias + outputs;
  }
  const double spread = 1 / std::sqrt(static_cast<double>(mlp.layers[mlp.layers.size() - 2]));
  while (weight != &mlp.parameters.back()) *weight++ = random.uniform(-spread, spread);
}

}  // namespace dashpot
