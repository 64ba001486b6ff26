#pragma once
#include <span>

#include "dashpot/damper/inverse/inverse_run.h"
#include "dashpot/damper/inverse/network_presets.h"
#include "dashpot/monitor.h"

namespace dashpot {

/// Settings for teaching a network to invert a damper.
struct InverseTraining {
  double spacing = 5e-3;  ///< s between two delays
  double current_min = 0, current_max = 1;
  std::size_t samples = 6000;  ///< drawn from all runs in proportion to their weights
  /// Least weight of a sample, as a share of the mean weight: it keeps the answers in order where
  /// the current makes no difference.
  double least_weight = 0.02;
  double weight_decay = 1e-6;
  int iterations = 150;  ///< of Levenberg-Marquardt, per round
  /// Beyond the first: with the fed-back currents that the network itself gave along the runs. The
  /// true ones nearly are the answer, so that a network which only saw those clings to its own
  /// mistakes.
  int rounds = 3;
  std::uint64_t seed = 1;
  int threads = 1;
  Monitor monitor;
};

/// A network and how well it answers along runs, in free run on its own past answers.
struct TaughtInverse {
  InverseNetwork network;
  double training_rmse = 0, left_out_rmse = 0;  ///< A, weighted as the runs are
};

/// Levenberg-Marquardt with early stopping on the left-out runs; of the rounds the one that is best
/// there in free run. Throws Error when the runs' samples cannot serve the delays or no sample
/// counts.
TaughtInverse train_inverse(const InverseNetworkPreset& preset,
                            std::span<const InverseRun> training,
                            std::span<const InverseRun> left_out, const InverseTraining& options);

/// The network's currents along a run, in free run.
std::vector<double> answers(const InverseNetwork& network, const InverseRun& run);
/// Root of the weighted mean squared error of currents along runs, A.
double weighted_error(std::span<const InverseRun> runs,
                      std::span<const std::vector<double>> currents);

}  // namespace dashpot
