#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace dashpot {

/// A multilayer perceptron: tanh hidden layers, linear output, inputs and output standardised inside.
/// All weights stand in one flat vector, layer after layer: W row by row (one row per neuron), then b.
struct Mlp {
  std::vector<std::size_t> layers;  ///< inputs, hidden ..., 1
  std::vector<double> parameters;
  std::vector<double> input_mean, input_scale;  ///< standardised = (raw - mean) / scale
  double output_mean = 0, output_scale = 1;     ///< raw = mean + scale * network

  static std::size_t parameter_count(const std::vector<std::size_t>& layers);
  static constexpr std::size_t kMaxWidth = 128;

  /// Output at one raw input, in raw units. Allocates nothing. Widths up to kMaxWidth.
  double evaluate(const double* input) const noexcept;
};

/// Nguyen-Widrow-like random weights from the seed; scales must be set already.
void initialise(Mlp& mlp, std::uint64_t seed);

/// Samples to train on: `inputs` row by row (samples x inputs), raw units.
struct TrainingSamples {
  std::vector<double> inputs;
  std::vector<double> targets;
  std::vector<std::size_t> group;  ///< per sample: which offset it shares; empty: no offsets
  std::size_t groups = 0;
};

struct TrainOptions {
  int max_iterations = 200;
  double tolerance = 1e-7;     ///< stop when the cost falls by less than this share over 5 iterations
  double weight_decay = 1e-6;  ///< on standardised weights, relative to the mean squared error of 1
  std::uint64_t seed = 1;
};

struct TrainReport {
  bool converged = false;
  int iterations = 0;
  double rmse = 0;              ///< raw units, offsets removed
  std::vector<double> offsets;  ///< raw units, one per group, mean zero... added to the network's output
};

/// Full-batch Levenberg-Marquardt on the mean squared error, with one free offset per group (a
/// declared nuisance, eliminated exactly by centring residuals and Jacobian per group).
TrainReport train(Mlp& mlp, const TrainingSamples& samples, const TrainOptions& options);

}  // namespace dashpot
