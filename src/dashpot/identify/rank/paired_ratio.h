#pragma once
#include <optional>
#include <span>
#include <vector>

#include "dashpot/rank.h"

// Which of two models is better can only be told from left-out parts that have little to do with
// one another. Such a part is harder than another for both models, and an error that is twice as
// great on an easy one tells as much as on a hard one: so the logarithm of the ratio of both errors
// is one number per part, and Student's t interval holds its mean.
//
// In simulation, over 4, 5, 10 and 20 parts, the 90 % interval covers 90 to 91 % where errors scale
// (difficulty spread log-normally by 0.7, errors by 0.5), whatever their ratio; 90 to 92 % where
// they have the tails of Student's t with 3 degrees of freedom, and 90 to 91 % where they add up to
// what noise leaves (tests/identify/rank/paired_ratio_test.cpp, with -s). The difference of the
// pooled errors is no such measure: a part that is hard for both models makes its interval so wide
// that a model five times as bad on every part is often not told apart.
//
// Fits of different folds share records, which the interval does not know. It compares two models
// that were named beforehand: that the first of many is the best by luck is seen by the many that
// cannot be told from it.
namespace dashpot {

inline constexpr double kPairedLevel = 0.9;  ///< that an interval claims

/// Fewer divisions tell nothing by Student's t, of which two need 6.3 deviations: then the records
/// within them are the units, though those of a division share a fit.
inline constexpr std::size_t kFewestDivisions = 4;

/// What each unit adds to the pooled ESR, %; the parts add up to it. Units are the folds, where
/// there are enough; else the left-out records or stretches of them (left_out_parts()). Empty where
/// a record diverged.
std::vector<double> esr_parts(std::span<const Evaluation> folds);

/// From the parts of both models, unit by unit. Nothing with fewer than two units.
std::optional<PairedRatio> paired_ratio(std::span<const double> esr_parts,
                                        std::span<const double> leader_parts);

}  // namespace dashpot
