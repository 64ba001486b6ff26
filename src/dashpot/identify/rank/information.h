#pragma once
#include <optional>
#include <vector>

#include "dashpot/rank.h"

// Information criteria of the laws of a ranking: whether a better fit is worth the parameters that
// it takes. docs/compare.md says of what likelihood they are, and where that ends.
namespace dashpot {

/// What a law's final fit leaves on its own records, which must still hold their curves; nothing
/// where the fit does not maximise a likelihood alone: no law, prior knowledge, no convergence.
std::optional<FitLikelihood> likelihood_of(const RankedModel& ranked,
                                           const IdentifyOptions& options);

/// Of one law: Akaike's and Schwarz's criteria of Gaussian errors that are independent after so
/// many samples, the same number for all laws of a ranking.
struct InformationCriteria {
  double independent = 0;     ///< samples that count as independent: all over that number
  double log_likelihood = 0;  ///< -independent / 2 (ln(2 pi mean square) + 1)
  double aic = 0;             ///< 2 parameters - 2 log_likelihood
  double bic = 0;             ///< ln(independent) parameters - 2 log_likelihood
};

/// In the order of the ranking's models; nothing for those without a likelihood. The correlation
/// length is that of the law that fits best, whose residual is nearest to noise.
std::vector<std::optional<InformationCriteria>> information_criteria(const Ranking& ranking);

}  // namespace dashpot
