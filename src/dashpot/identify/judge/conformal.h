#pragma once
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "dashpot/damper/force_band.h"
#include "dashpot/evaluate.h"
#include "dashpot/identify/judge/left_out_parts.h"

namespace dashpot {

// Prediction intervals of the force from the errors of a model on records that its fit did not see:
// split and cross-conformal prediction, locally weighted (Lei et al. 2018), over groups (Dunn,
// Wasserman, Ramdas 2022).
//
// The mean |error| on the records of the fit, by speed and drive, gives the shape of the band; the
// errors on left-out records, as multiples of that shape, give its factor. A shape learnt on the
// fit's own records knows every level of the drive, whereas what was left out may hold one level
// only. The members of an ensemble agree where they have learnt the same and disagree where they
// have not been: their spread is added to the shape, in quadrature, with the same factor.
//
// What holds. Samples of a record are correlated, and records that were left out together (a
// condition, a level of the drive) share what makes them unlike the rest: at best such parts are
// exchangeable. Each part therefore counts as one, and within it each record, whatever its length.
// Parts differ in how hard they are, which a quantile over all of them does not predict for the
// next one: the factor is widened by as much as bands from all parts but one must be to cover, on
// average, the one that they were made without. In simulation, with errors of parts spread by a
// factor of up to 2 (log-normal, 0.7), that covers 90 to 92 % of a new part from 3 parts on, where
// the plain quantile covers 87 to 90 %. A single new record can be far from that; hence the
// measured coverage in every report, with the worst record. Nothing is promised outside the domain:
// a part at the edge of what was recorded is harder than those within, and no other part shows by
// how much. Factors come from models fitted on a part of the records and serve the one fitted on
// all. The band is about the model's force with the record's offset, where that is a free nuisance.
//
// A judged fold gives no error to its own band, but the fits of the other folds have seen its
// records, so that this is approximate across folds. Of ends of records, which one fit has not
// seen, each part is covered by the band of the others; what that says of another recording is
// said by as few stretches of time as there are.

constexpr double kCoverage = 0.9;  ///< what an interval claims

/// The shape: mean |error| of a model on the records of its fit, N, by speed and drive. Classes
/// with few samples lean on those of the same speed, and these on all. Nothing without a finite
/// sample.
std::optional<ForceBand> error_shape(const std::vector<RecordResult>& training);

/// |error| / shape of each scored sample of a part that was left out at once; one group per record,
/// none for one that diverged.
using ErrorGroups = std::vector<std::vector<double>>;
ErrorGroups relative_errors(const std::vector<RecordResult>& left_out, const ForceBand& shape);
/// The same of one part, with one group at most.
ErrorGroups relative_errors(const LeftOutPart& part, const ForceBand& shape);

/// The least factor q with mean over parts, and in them over groups, of (errors <= q) / (size + 1)
/// >= level: for one group the split conformal rank, ceil((n + 1) level). Nothing when no factor
/// reaches it: too few samples. Parts without groups do not count.
std::optional<double> conformal_factor(const std::vector<ErrorGroups>& parts,
                                       double level = kCoverage);

/// How much wider than conformal_factor() of all other parts a band must be for the mean coverage
/// of the part that it was made without to reach the level. The records of a single part stand for
/// parts; 1 where there is one record.
std::optional<double> widening(const std::vector<ErrorGroups>& parts, double level = kCoverage);

/// The shape made as wide as the parts ask, widened for one that is new.
std::optional<ForceBand> conformal_band(const std::optional<ForceBand>& shape,
                                        const std::vector<ErrorGroups>& parts);

/// How much of a record, or of a stretch of it, a band covers; nothing of one that diverged.
Coverage coverage(const RecordResult& record, const ForceBand& band);
Coverage coverage(const LeftOutPart& part, const ForceBand& band);

/// The interval of a model on records that it was not fitted on, from these records alone, which
/// are parts for one another. Each record is given the band that all of them ask for, and the
/// coverage of bands that were made without the part which they cover. Returns the errors.
std::vector<ErrorGroups> cover_by_parts(const ForceBand& shape,
                                        std::vector<RecordResult>& left_out);

}  // namespace dashpot
