#pragma once
#include <string>
#include <vector>

#include "dashpot/design/optimise.h"

namespace dashpot {

/// Why a request has no design. Figures in SI, in the unit of their constraint's quantity.
struct Conflict {
  bool undrawable = false;     ///< no damper of the ranges can be drawn, whatever is asked of it
  std::string why_undrawable;  ///< of the damper nearest to one; empty: its tolerances are why
  /// A model refuses the force of every damper of the ranges that can be drawn, or a goal has no
  /// figure there.
  bool refused = false;
  /// Indices of constraints that cannot hold together, while any one less can.
  std::vector<std::size_t> members;
  /// The best figure of each member while the other members hold; NaN where none was found.
  std::vector<double> reached;
  /// Place of the unit cube that holds all constraints after all, found on the way; else empty.
  std::vector<double> design;
  Optimum nearest;  ///< the place of least violation of all constraints
  std::size_t evaluations = 0;
  bool stopped = false;  ///< the user asked to stop: members may be more than needed
};

/// Deletion filter (Chinneck and Dravnieks 1991): each constraint is left out in turn, for good
/// where the rest cannot hold without it. Whether constraints can hold is what a search finds: a
/// set of rare designs may be called a conflict. `found`: the damper of least violation, whose
/// constraints are tried first.
Conflict find_conflict(const DesignProblem& problem, const Optimum& found,
                       const OptimiseOptions& options);

/// One line for each member: "force at least 3000 N at ...: 2100 N at most while the others hold".
std::string describe(const Conflict& conflict, const DesignRequest& request);

}  // namespace dashpot
