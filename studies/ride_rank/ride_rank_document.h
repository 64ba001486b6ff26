#pragma once
#include <span>

#include "dashpot/report/document.h"
#include "studies/ride_rank/ride_rank_study.h"

namespace dashpot {

/// Rank correlations with the true error of the ride, of what was predicted and of ESR: over all
/// cases, by true damper, road and controller; and each model in each ride.
Document ride_rank_document(std::span<const RideRankCase> cases,
                            const RideRankStudyOptions& options);
Value ride_rank_json(std::span<const RideRankCase> cases);

}  // namespace dashpot
