#include "dashpot/design/conflict.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"

namespace dashpot {
namespace {

bool can_hold(const DesignProblem& problem, const std::vector<bool>& counted, OptimiseOptions options,
              Conflict& conflict) {
  options.counted = counted;
  const Optimum optimum = least_violation(problem, options);
  conflict.evaluations += optimum.evaluations;
  conflict.stopped = conflict.stopped || optimum.stopped;
  return optimum.violation == 0;
}

/// The constraint's figure as a goal, made as good as it can be.
double best_figure(const DesignRequest& request, const DesignModel& model, std::size_t constraint,
                   OptimiseOptions options) {
  const DesignConstraint& own = request.constraints[constraint];
  DesignRequest asked = request;
  asked.goals = {{own.quantity, own.at, own.at_least}};
  const DesignProblem problem(asked, model, options.seed);
  options.counted[constraint] = false;
  const Optimum optimum = optimise(problem, 0, options);
  if (optimum.place.empty() || optimum.violation > 0) return NAN;
  return own.at_least ? -optimum.value : optimum.value;
}

}  // namespace

Conflict find_conflict(const DesignProblem& problem, const Optimum& found, const OptimiseOptions& options) {
  const DesignRequest& request = problem.request();
  const std::size_t count = request.constraints.size();
  Conflict conflict;
  conflict.nearest = found;
  std::vector<bool> counted(count, true);
  if (!can_hold(problem, std::vector<bool>(count, false), options, conflict)) {
    conflict.undrawable = !conflict.stopped;
    return conflict;
  }
  for (std::size_t k = 0; k < count && !conflict.stopped; ++k) {
    if (options.monitor)
      options.monitor->report("which constraints conflict", static_cast<double>(k) / static_cast<double>(count));
    counted[k] = false;
    if (can_hold(problem, counted, options, conflict)) counted[k] = true;
  }
  for (std::size_t k = 0; k < count; ++k)
    if (counted[k]) conflict.members.push_back(k);
  OptimiseOptions rest = options;
  rest.counted = counted;
  for (const std::size_t k : conflict.members)
    conflict.reached.push_back(conflict.stopped ? NAN : best_figure(request, problem.model(), k, rest));
  return conflict;
}

std::string describe(const Conflict& conflict, const DesignRequest& request) {
  if (conflict.undrawable) return "no damper of these ranges can be drawn: the parts do not fit into each other";
  std::string text;
  for (std::size_t m = 0; m < conflict.members.size(); ++m) {
    const DesignConstraint& own = request.constraints[conflict.members[m]];
    text += describe(own);
    if (std::isfinite(conflict.reached[m]))
      text += ": " + format_number(conflict.reached[m]) +
              (own.quantity->unit == "1" ? "" : ' ' + std::string(own.quantity->unit)) +
              (own.at_least ? " at most" : " at least") + (conflict.members.size() > 1 ? " while the others hold" : "");
    text += '\n';
  }
  return text;
}

}  // namespace dashpot
