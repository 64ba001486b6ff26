#pragma once
#include "dashpot/damper/nets/ensemble.h"
#include "dashpot/identify.h"

namespace dashpot {

/// Records as samples of a network.
using SamplesOf = std::function<TrainingSamples(const std::vector<Record>&)>;

struct TrainedEnsemble {
  FitReport::Status status = FitReport::Status::Failed;
  std::string message;
  std::vector<Mlp> members;
  int iterations = 0;  ///< of the member that took the most
  double rmse = 0;     ///< N, mean of the members, on what they were trained on
};

/// Trains networks from `start` (layers, activations and scales) on records as options.network
/// says: each member is the best of options.starts starts. Early stopping holds back another part
/// of the records for each member (trial_folds), and its starts are compared there. The same bits
/// for any number of threads.
TrainedEnsemble train_networks(const Mlp& start, const std::vector<Record>& training,
                               const SamplesOf& samples_of, const IdentifyOptions& options);

}  // namespace dashpot
