#pragma once
#include <functional>
#include <string>
#include <vector>

#include "dashpot/rank.h"

namespace dashpot {

/// A model of a ranking that was just judged, before it has a place, what it costs per step and how
/// far it lies behind the first. Called from one thread at a time.
using OnJudged = std::function<void(const RankedModel& model)>;

/// As rank(), which also tells of each model as soon as its last fit has ended.
Ranking rank_and_tell(const std::vector<std::string>& models, const Dataset& dataset,
                      const LeaveOut& leave_out, const IdentifyOptions& options, FitStore* store,
                      OnJudged on_judged);

}  // namespace dashpot
