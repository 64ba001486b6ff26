#pragma once
#include <algorithm>

#include "dashpot/identify.h"

namespace dashpot {

/// A report without model on trainings that each hold a `report` of their own: whether all
/// converged, the most iterations, the mean error.
template <class Members>
FitReport report_of_members(const Members& members) {
  FitReport all{.status = FitReport::Status::Converged, .message = "converged"};
  for (const auto& member : members) {
    all.iterations = std::max(all.iterations, member.report.iterations);
    all.training_rmse += member.report.rmse / static_cast<double>(members.size());
    if (member.report.converged) continue;
    all.status = FitReport::Status::IterationLimit;
    all.message = "iteration limit reached";
  }
  return all;
}

}  // namespace dashpot
