#include "dashpot/damper/nets/standardise.h"

#include <cmath>
#include <tuple>

namespace dashpot {

std::pair<double, double> mean_and_scale(const std::vector<double>& values, std::size_t first,
                                         std::size_t stride) {
  double sum = 0, square = 0;
  std::size_t n = 0;
  for (std::size_t k = first; k < values.size(); k += stride, ++n) sum += values[k];
  const double mean = sum / static_cast<double>(n);
  for (std::size_t k = first; k < values.size(); k += stride)
    square += (values[k] - mean) * (values[k] - mean);
  const double deviation = std::sqrt(square / static_cast<double>(n));
  return {mean, deviation > 1e-12 * (std::abs(mean) + 1e-300) ? deviation : 1.0};
}

void standardise(Mlp& mlp, const TrainingSamples& samples) {
  const std::size_t inputs = mlp.layers.front();
  mlp.input_mean.clear();
  mlp.input_scale.clear();
  for (std::size_t k = 0; k < inputs; ++k) {
    const auto [mean, scale] = mean_and_scale(samples.inputs, k, inputs);
    mlp.input_mean.push_back(mean);
    mlp.input_scale.push_back(scale);
  }
  std::tie(mlp.output_mean, mlp.output_scale) = mean_and_scale(samples.targets, 0, 1);
}

Mlp untrained(std::size_t inputs, const std::vector<std::size_t>& hidden, Activation kind,
              const TrainingSamples& samples) {
  Mlp mlp = without_weights(inputs, hidden, kind);
  standardise(mlp, samples);
  return mlp;
}

}  // namespace dashpot
