#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "dashpot/damper/nets/kernel.h"

namespace dashpot {

/// A multilayer perceptron, inputs and output standardised inside. All weights stand in one flat
/// vector, layer after layer: W row by row (one row per neuron), then b. Plain data, in the order
/// in which files hold it; MlpEvaluator, PaddedNetwork and SampleLayers are its fast forms.
struct Mlp {
  std::vector<std::size_t> layers;  ///< inputs, hidden ..., 1
  /// One of each layer behind the inputs; empty: tanh ..., tanh, identity.
  std::vector<Activation> activations;
  std::vector<double> parameters;
  std::vector<double> input_mean, input_scale;  ///< standardised = (raw - mean) / scale
  double output_mean = 0, output_scale = 1;     ///< raw = mean + scale * network

  static std::size_t parameter_count(const std::vector<std::size_t>& layers);
  static constexpr std::size_t kMaxWidth = dashpot::kMaxWidth;

  /// Activation of layer 1 ... layers.size() - 1.
  Activation activation(std::size_t layer) const;

  /// Output at one raw input, in raw units. Plain and by the standard library, as the reference for
  /// the fast forms. Allocates nothing. Widths up to kMaxWidth.
  double evaluate(const double* input) const noexcept;
};

/// Hidden layers of one activation and a linear output, as yet without weights and scales: where
/// `parameters` are empty, the trainers draw the first ones.
Mlp without_weights(std::size_t inputs, const std::vector<std::size_t>& hidden, Activation kind);

/// Random weights from the seed. Hidden tanh and sigmoid layers in the manner of Nguyen and Widrow
/// (IJCNN 1990): each neuron's slope lies somewhere in the range of its inputs, and together they
/// cover it. Others so that the variance passes through (He et al., ICCV 2015), biases 0.
void initialise(Mlp& mlp, std::uint64_t seed);

/// Samples to train on: `inputs` row by row (samples x inputs), raw units.
struct TrainingSamples {
  std::vector<double> inputs;
  std::vector<double> targets;
  std::vector<std::size_t> group;  ///< per sample: which offset it shares; empty: no offsets
  std::size_t groups = 0;
};

/// When to stop before a network learns the noise: when the left-out samples have not been met
/// better for `patience` epochs (or steps of Levenberg-Marquardt or L-BFGS) in a row. Training then
/// gives the best network, not the last.
struct Stopping {
  const TrainingSamples* left_out = nullptr;  ///< null: never
  int patience = 20;
};

struct TrainOptions {
  int max_iterations = 400;
  double tolerance = 1e-5;  ///< stop when the cost falls by less than this share over 5 steps
  /// On standardised weights, relative to the mean squared error of 1. With less, networks that saw
  /// three levels of current invent forces between them; with more, they round off the knee.
  double weight_decay = 3e-4;
  /// The same on offsets: where records held at one current leave open what is offset and what is
  /// the current's effect, it is the current's effect.
  double offset_decay = 1e-3;
  std::uint64_t seed = 1;  ///< of the start, when mlp.parameters is empty
  int threads = 1;         ///< results do not depend on it
  /// Weight decay found from the data, starting from weight_decay: MacKay's evidence (Neural
  /// Computation 1992) in the Gauss-Newton approximation of Foresee and Hagan (ICNN 1997), MATLAB's
  /// trainbr.
  bool bayesian = false;
  Stopping stopping;
  std::function<void(int iteration, double rmse)> on_iteration;  ///< raw units; may throw to stop
};

struct TrainReport {
  bool converged = false;
  int iterations = 0;
  double rmse = 0;  ///< raw units, offsets removed
  /// Raw units, one per group, mean zero; added to the network's output.
  std::vector<double> offsets;
  bool stopped_early = false;
  double left_out_rmse = 0;         ///< raw units; 0 when nothing was left out
  double weight_decay = 0;          ///< of the last step of train()
  double effective_parameters = 0;  ///< how many of them the data determine; with `bayesian`
};

/// Full-batch Levenberg-Marquardt on the mean squared error, with one free offset per group (a
/// declared nuisance, eliminated exactly by centring residuals and Jacobian per group). For
/// networks of up to a few hundred weights; train_lbfgs() and train_batches() take larger ones.
///
/// Starts from mlp.parameters, or from a start of the seed when these are empty; its layers and
/// scales must be set. The mean offset goes into the network. The same bits for the same input,
/// whatever the number of threads.
TrainReport train(Mlp& mlp, const TrainingSamples& samples, const TrainOptions& options);

}  // namespace dashpot
