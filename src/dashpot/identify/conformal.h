#pragma once
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "dashpot/damper/force_band.h"
#include "dashpot/identify/evaluate.h"

namespace dashpot {

// Prediction intervals of the force from the errors of a model on records that its fit did not see: split and
// cross-conformal prediction, locally weighted (Lei et al. 2018), over groups (Dunn, Wasserman, Ramdas 2022).
//
// The mean |error| on the records of the fit, by speed and drive, gives the shape of the band; the errors on
// left-out records, as multiples of that shape, give its factor. A shape learnt on the fit's own records
// knows every level of the drive, whereas what was left out may hold one level only.
//
// What holds. Samples of a record are correlated and share the record's conditions: they are not
// exchangeable, whole records are at best. Each record therefore counts as one, whatever its length, and the
// finite-sample guarantee is about records: if a new record is exchangeable with the K that the factor comes
// from, the band covers on average at least level * K / (K + 1) of its samples, and about `level` of them.
// With few or strongly unlike records a single new one can be far from that; hence the measured coverage in
// every report, with the worst record. Nothing is promised outside the domain. Factors come from models
// fitted on a part of the records and serve the one fitted on all: cross-conformal, without the jackknife+'s
// worst-case bound. The band is about the model's force with the record's offset, where that is a free
// nuisance.
//
// Two limits. Records of one condition are alike: where conditions are new, K counts conditions, not records.
// And a judged fold gives no error to its own band, but the fits of the other folds have seen its records, so
// that the bound above, exact for one split, is approximate across folds.

constexpr double kCoverage = 0.9;  ///< what an interval claims

/// The shape: mean |error| of a model on the records of its fit, N, by speed and drive. Classes with few
/// samples lean on those of the same speed, and these on all. Nothing without a finite sample.
std::optional<ForceBand> error_shape(const std::vector<RecordResult>& training);

/// |error| / shape of each scored sample; one group per record, none for one that diverged.
using ErrorGroups = std::vector<std::vector<double>>;
ErrorGroups relative_errors(const std::vector<RecordResult>& left_out, const ForceBand& shape);

/// The least factor q with mean over groups of (errors <= q) / (size + 1) >= level: for one group the split
/// conformal rank, ceil((n + 1) level). Nothing when no factor reaches it: too few samples.
std::optional<double> conformal_factor(const ErrorGroups& groups, double level = kCoverage);

/// The shape made as wide as the groups ask.
std::optional<ForceBand> conformal_band(const std::optional<ForceBand>& shape, const ErrorGroups& groups);

}  // namespace dashpot
