#pragma once
#include <functional>
#include <vector>

#include "dashpot/damper/nets/mlp.h"

namespace dashpot {

/// Rows of regressors in the order of time: what a network with fed-back forces is trained on. The
/// fed-back columns, the last `feedback.size()` ones, hold measured forces.
struct NarxSamples {
  TrainingSamples rows;                ///< raw units
  std::vector<std::size_t> stretches;  ///< the row at which each unbroken stretch begins
  std::vector<std::size_t> feedback;   ///< lags
};

struct NarxTrainOptions {
  int max_iterations = 40;
  double tolerance = 1e-4;  ///< stop when the cost falls by less than this share
  double weight_decay =
      1e-4;  ///< on squared weights; a residual of the size of the output's scale costs 1
  double offset_decay = 1e-3;  ///< as TrainOptions
  /// Rows over which the network runs on its own forces, from measured ones on (see washout):
  /// derivatives reach no further back. 0: whole stretches.
  std::size_t window = 0;
  /// Rows at the beginning of each window that are not scored. When there are any, the window
  /// begins with the output's mean for the forces before it, not with measured ones: so the network
  /// learns to forget its start.
  std::size_t washout = 0;
  std::size_t most_residuals = 2500;   ///< every so many-th row is scored, so that they are no more
  std::function<void()> on_iteration;  ///< may throw to stop
};

/// Free run from series-parallel weights: Levenberg-Marquardt with exact derivatives, which are
/// carried along with the forces. Starts from mlp.parameters; a fed-back column must have the
/// output's mean and scale. The same bits for the same input.
TrainReport train_free_run(Mlp& mlp, const NarxSamples& samples, const NarxTrainOptions& options);

/// The same cost by L-BFGS, its gradient by back-propagation through the time of each window.
TrainReport train_through_time(Mlp& mlp, const NarxSamples& samples,
                               const NarxTrainOptions& options);

/// Root mean squared free-run residual, raw units, offsets at their best.
double free_run_rmse(const Mlp& mlp, const NarxSamples& samples, const NarxTrainOptions& options);

/// Mean squared free-run residual + weight_decay |w|^2, standardised units, offsets at their best,
/// and its gradient: by derivatives carried along, and back through time.
struct NarxCost {
  double cost = 0;
  std::vector<double> gradient;
};
NarxCost narx_cost_forward(const Mlp& mlp, const NarxSamples& samples,
                           const NarxTrainOptions& options);
NarxCost narx_cost_backward(const Mlp& mlp, const NarxSamples& samples,
                            const NarxTrainOptions& options);

}  // namespace dashpot
