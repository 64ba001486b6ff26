#pragma once
#include <string>

#include <ceres/types.h>

namespace dashpot {

/// How a search ended, in the words of reports; `detail` is what Ceres says of one that broke down.
inline std::string ceres_ending(ceres::TerminationType ending, const std::string& detail) {
  if (ending == ceres::CONVERGENCE) return "converged";
  if (ending == ceres::NO_CONVERGENCE) return "iteration limit reached";
  return "the search broke down: " + detail;
}

}  // namespace dashpot
