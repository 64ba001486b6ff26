#pragma once
#include "dashpot/damper/nets/mlp.h"

namespace dashpot {

/// Everything but the samples; TrainOptions explains what both have.
struct LbfgsOptions {
  int max_iterations = 500;
  double tolerance = 1e-9;     ///< stop when the cost falls by less than this share
  double weight_decay = 3e-4;  ///< as TrainOptions
  double offset_decay = 1e-3;  ///< as TrainOptions
  std::uint64_t seed = 1;      ///< of the start, when mlp.parameters is empty
  int threads = 1;             ///< results do not depend on it
  Stopping stopping;
  std::function<void(int iteration, double rmse)> on_iteration;  ///< raw units; may throw to stop
  SimdLevel level = simd_levels().back();
};

/// Full-batch L-BFGS on mean squared error + weight_decay |w|^2, double precision: for networks
/// with so many weights that the normal equations of train() cost too much. Offsets of groups as
/// train() has them: each evaluation takes the best ones for its weights. Starts as train() does.
/// The same bits for the same input and level, whatever the number of threads.
TrainReport train_lbfgs(Mlp& mlp, const TrainingSamples& samples, const LbfgsOptions& options);

}  // namespace dashpot
