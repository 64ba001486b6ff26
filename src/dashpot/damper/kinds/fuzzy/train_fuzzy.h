#pragma once
#include <functional>

#include "dashpot/damper/kinds/fuzzy/sugeno.h"
#include "dashpot/damper/nets/mlp.h"

namespace dashpot {

/// All penalties are per sample, in standardised units: a residual of the size of the data's scale
/// costs 1.
struct FuzzyTrainOptions {
  int max_iterations = 100;  ///< 0: the consequents alone, the memberships stay
  double tolerance = 1e-4;   ///< stop when the cost falls by less than this share over 5 steps
  double ridge = 1e-4;       ///< on squared consequents: keeps rules that see few samples tame
  double premise_decay =
      1e-4;  ///< on squared moves of centres and of logarithms of widths and slopes
  double offset_decay = 1e-3;                       ///< as TrainOptions::offset_decay
  std::function<void(int iteration)> on_iteration;  ///< may throw to stop
};

/// Hybrid learning: for any memberships the consequents (and one free offset per group, a declared
/// nuisance) follow from linear least squares; the memberships follow Levenberg-Marquardt on what
/// that leaves (variable projection, Golub & Pereyra 1973, with Kaufman's Jacobian, 1975) instead
/// of Jang's steepest descent. Starts from the model's memberships. The same bits for the same
/// input.
TrainReport train(Sugeno& model, const TrainingSamples& samples, const FuzzyTrainOptions& options);

/// Half the gradient of the cost of train(), consequents and offsets at their best, by centre, ln
/// width and ln |slope| of each membership, at the model's memberships.
struct ReducedCost {
  double cost = 0;
  std::vector<double> gradient;
};
ReducedCost reduced_cost(Sugeno model, const TrainingSamples& samples,
                         const FuzzyTrainOptions& options);

}  // namespace dashpot
