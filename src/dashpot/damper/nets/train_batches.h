#pragma once
#include <cstdint>
#include <functional>

#include "dashpot/damper/nets/mlp.h"
#include "dashpot/fit_choices.h"

namespace dashpot {

/// The learning rate over the epochs: a linear warm-up from 0, then one of these.
struct Schedule {
  RateSchedule kind = RateSchedule::Constant;
  double warm_up = 0;                          ///< epochs
  double step_epochs = 30, step_factor = 0.1;  ///< Step: every so many epochs, times this
  double final_share = 0;                      ///< Cosine: of the full rate, at the last epoch

  /// Share of the full rate at `epoch` (with its fraction) of `epochs`.
  double share(double epoch, double epochs) const;
};

/// Everything but the samples.
struct BatchTrainOptions {
  Optimiser optimiser = Optimiser::Adam;
  double rate = 1e-3;
  Schedule schedule;
  std::size_t batch = 20;
  int epochs = 100;
  double momentum = 0.9;       ///< Momentum, Adam, AdamW
  double mean_square = 0.999;  ///< RmsProp, Adam, AdamW
  double epsilon = 1e-8;
  double l1 = 0, l2 = 0;  ///< l1 |w|_1 + l2 |w|^2 / 2 is added to the mean squared error
  double decay = 0;       ///< AdamW: share of the weights that goes per step, before the rate
  bool single_precision = true;
  /// Seed of the order of the samples, and of the start when mlp.parameters is empty.
  std::uint64_t seed = 1;
  Stopping stopping;
  std::function<void(int epoch, double rmse)>
      on_epoch;  ///< raw units, while it learned; may throw to stop
  SimdLevel level = simd_levels().back();
};

/// Descent on the mean squared error in mini-batches, standardised units, one thread. Starts from
/// mlp.parameters, or from a start of the seed when these are empty; its layers and scales must be
/// set; one output; samples without groups. The same bits for the same input and level.
TrainReport train_batches(Mlp& mlp, const TrainingSamples& samples,
                          const BatchTrainOptions& options);

}  // namespace dashpot
