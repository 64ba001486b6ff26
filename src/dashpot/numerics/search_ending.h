#pragma once
#include <string>

namespace dashpot {

/// How a search ended, in the words of reports; `detail` is what the solver says of one that broke
/// down.
inline std::string search_ending(bool converged, bool reached_limit, const std::string& detail) {
  if (converged) return "converged";
  return reached_limit ? "iteration limit reached" : "the search broke down: " + detail;
}

}  // namespace dashpot
