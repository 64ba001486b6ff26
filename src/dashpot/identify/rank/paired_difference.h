#pragma once
#include <optional>
#include <span>
#include <vector>

#include "dashpot/rank.h"

// Which of two models is better can only be told from left-out parts that have little to do with
// one another. What every part adds to the error of one model, less what it adds to that of the
// other, is one number per part, and Student's t interval holds the sum of those to come. Parts
// differ in how hard they are by much more than models do, hence the pairs.
//
// In simulation, over 4, 5, 10 and 20 parts whose difficulty is spread log-normally (0.7) and whose
// errors are spread once more (0.5), the 90 % interval covers 94 to 91 % where both models are
// equally good and 90 to 89 % where one is worse by 30 %, and 92 to 91 % of differences with
// Student's t distribution of 3 degrees of freedom. Where one model is twice as bad it covers 82 to
// 85 % only: then the interval is somewhat short, but 0 is far from it. A bootstrap over so few
// parts covers less in all these cases.
//
// Fits of different folds share records, which the interval does not know. It compares two models
// that were named beforehand: that the first of many is the best by luck is seen by the many that
// cannot be told from it.
namespace dashpot {

inline constexpr double kPairedLevel = 0.9;  ///< that an interval claims

/// What each unit adds to the pooled ESR, %; the parts add up to it. Units are the folds, where
/// there are several; else the stretches of the left-out records. Empty where a record diverged.
std::vector<double> esr_parts(std::span<const Evaluation> folds);

/// From the parts of both models, unit by unit. Nothing with fewer than two units.
std::optional<PairedDifference> paired_difference(std::span<const double> esr_parts,
                                                  std::span<const double> leader_parts);

}  // namespace dashpot
