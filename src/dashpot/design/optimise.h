#pragma once
#include <cstdint>
#include <vector>

#include "dashpot/design/design_problem.h"
#include "dashpot/monitor.h"

namespace dashpot {

/// How the least of one number is sought: of a goal, or of the constraints' violation.
struct OptimiseOptions {
  std::uint64_t seed = 1;
  int starts = 6;         ///< searches of their own, beside each other
  int evaluations = 400;  ///< of the global search, for each variable
  int looks = 200;        ///< of each local search, for each variable
  double step = 1e-9;     ///< at which a local search ends, in shares of the ranges
  int threads = 0;        ///< results do not depend on it
  const Monitor* monitor = nullptr;
  /// Constraints that count; empty: all.
  std::vector<bool> counted;
};

/// The best place of all starts.
struct Optimum {
  std::vector<double> place;  ///< in the unit cube; empty: stopped before anything was seen
  double violation = 0;       ///< of what counts
  double value = 0;           ///< of the goal, SI; a figure to be made large has its sign turned
  std::size_t evaluations = 0;
  bool stopped = false;  ///< the user asked to stop: the best so far
};

/// Makes the goal best under the constraints. Each start: controlled random search, in one fluid
/// where there are two starts or more for each, in which a damper that holds the constraints beats
/// any that does not; COBYLA, at first as if ranges had no steps; then the other levels of each
/// variable in turn, with COBYLA on the rest. All by NLopt.
Optimum optimise(const DesignProblem& problem, std::size_t goal, const OptimiseOptions& options);

/// Makes the goal better from a place, by COBYLA on the variables without levels; of the options
/// those of a local search count.
Optimum refine(const DesignProblem& problem, std::size_t goal, std::vector<double> place,
               const OptimiseOptions& options);

/// The place of least violation; ends where it finds none.
Optimum least_violation(const DesignProblem& problem, const OptimiseOptions& options);

}  // namespace dashpot
