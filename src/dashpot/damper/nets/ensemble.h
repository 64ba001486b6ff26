#pragma once
#include <functional>
#include <span>
#include <vector>

#include "dashpot/damper/nets/mlp_evaluator.h"

namespace dashpot {

/// A network and how its training went.
struct TrainedMlp {
  Mlp mlp;
  TrainReport report;
};

/// Trains `count` copies of a network from the starts that belong to seed, seed + 1, ...
/// `train_one` trains the k-th in place and is called from several threads at a time. The result
/// does not depend on how many.
std::vector<TrainedMlp> train_from_starts(
    const Mlp& mlp, std::size_t count, std::uint64_t seed, int threads,
    const std::function<TrainReport(Mlp& mlp, std::size_t k)>& train_one);

/// The one that did best: on the left-out samples where there were any, else on its training
/// samples. One whose training went to infinity is the worst. `trained` must not be empty.
TrainedMlp& best_of(std::span<TrainedMlp> trained);

/// Networks that answer together: their mean, and how far they lie apart. Owns copies of them; safe
/// from several threads.
class MlpEnsemble {
 public:
  explicit MlpEnsemble(const std::vector<Mlp>& members);

  struct Answer {
    double mean = 0;
    double spread = 0;  ///< standard deviation over the members; 0 with one
  };
  /// At one raw input, as many numbers as the members have inputs. Allocates nothing.
  Answer evaluate(const double* input) const noexcept;

 private:
  std::vector<MlpEvaluator<double>> members_;
};

}  // namespace dashpot
