#include "dashpot/design/conflict.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

Optimum nearest_of(const DesignProblem& problem, const std::vector<bool>& counted,
                   OptimiseOptions options, Conflict& conflict) {
  options.counted = counted;
  const Optimum optimum = least_violation(problem, options);
  conflict.evaluations += optimum.evaluations;
  conflict.stopped = conflict.stopped || optimum.stopped;
  return optimum;
}

bool can_hold(const DesignProblem& problem, const std::vector<bool>& counted,
              const OptimiseOptions& options, Conflict& conflict) {
  return nearest_of(problem, counted, options, conflict).violation == 0;
}

/// The best figure of a constraint while the other members hold, and its place.
Optimum best_of(const DesignProblem& problem, std::size_t constraint, OptimiseOptions options) {
  DesignRequest asked = problem.request();
  const DesignConstraint& own = asked.constraints[constraint];
  asked.goals = {{own.quantity, own.at, own.at_least, own.by}};
  options.counted[constraint] = false;
  return optimise(DesignProblem(asked, problem.model(), options.seed, problem.second()), 0,
                  options);
}

/// The constraints that fail at the place of least violation or lie on their bounds, where these
/// alone conflict; else all.
std::vector<bool> first_members(const DesignProblem& problem, const OptimiseOptions& options,
                                Conflict& conflict) {
  constexpr double kNear = 0.01;
  const Assessment nearest = problem.assess(problem.damper_at(conflict.nearest.place));
  std::vector<bool> near;
  for (const double slack : nearest.slack) near.push_back(slack < kNear);
  return can_hold(problem, near, options, conflict) ? std::vector<bool>(near.size(), true) : near;
}

/// Why a damper cannot be drawn; empty where it can.
std::string why_undrawable(const DamperDescription& damper) {
  try {
    require_possible(damper, "");
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

void add_reached(const DesignProblem& problem, const std::vector<bool>& counted,
                 OptimiseOptions options, Conflict& conflict) {
  options.counted = counted;
  for (const std::size_t k : conflict.members) {
    const Optimum optimum = best_of(problem, k, options);
    const bool known = !conflict.stopped && !optimum.place.empty() && optimum.violation == 0;
    conflict.evaluations += optimum.evaluations;
    conflict.stopped = conflict.stopped || optimum.stopped;
    conflict.reached.push_back(!known                                      ? NAN
                               : problem.request().constraints[k].at_least ? -optimum.value
                                                                           : optimum.value);
    // A search for one figure may find what the search for all constraints has missed.
    if (known && problem.assess(problem.damper_at(optimum.place)).holds())
      conflict.design = optimum.place;
  }
}

}  // namespace

Conflict find_conflict(const DesignProblem& problem, const Optimum& found,
                       const OptimiseOptions& asked) {
  const std::size_t count = problem.request().constraints.size();
  Conflict conflict;
  conflict.nearest = found;

  // Many searches follow, each for something easier than the whole.
  OptimiseOptions options = asked;
  options.starts = options.starts * 2 / 3;
  options.evaluations = options.evaluations * 5 / 8;

  // With no constraint counted, only dampers that cannot be drawn, or are refused, stand in the
  // way.
  const Optimum any = nearest_of(problem, std::vector<bool>(count, false), options, conflict);
  if (any.violation > 0) {
    const DamperDescription nearest = problem.damper_at(any.place);
    const bool drawable = problem.assess(nearest).possible;
    conflict.undrawable = !conflict.stopped && !drawable;
    conflict.why_undrawable = why_undrawable(nearest);
    conflict.refused = !conflict.stopped && drawable;
    return conflict;
  }

  // The deletion filter: a constraint goes for good where the rest conflict without it.
  std::vector<bool> counted = first_members(problem, options, conflict);
  for (std::size_t k = 0; k < count && !conflict.stopped; ++k) {
    if (!counted[k]) continue;
    if (options.monitor)
      options.monitor->report("which constraints conflict",
                              static_cast<double>(k) / static_cast<double>(count));
    counted[k] = false;
    if (can_hold(problem, counted, options, conflict)) counted[k] = true;
  }

  // Each constraint that is left is needed for the conflict. How far could each come?
  for (std::size_t k = 0; k < count; ++k)
    if (counted[k]) conflict.members.push_back(k);
  add_reached(problem, counted, options, conflict);
  return conflict;
}

std::string describe(const Conflict& conflict, const DesignRequest& request) {
  if (conflict.undrawable)
    return std::string("no damper of these ranges can be ") +
           (request.share > 0 ? "made within its tolerances" : "drawn") + ": " +
           (conflict.why_undrawable.empty() ? "the parts do not fit into each other"
                                            : conflict.why_undrawable);
  if (conflict.refused)
    return "none of the dampers of these ranges that were tried has a force that its models do not "
           "refuse, and goals that have a figure";
  std::string text;
  for (std::size_t m = 0; m < conflict.members.size(); ++m) {
    const DesignConstraint& own = request.constraints[conflict.members[m]];
    text += describe(own);
    if (std::isfinite(conflict.reached[m]))
      text += ": " + shown_figure(conflict.reached[m], own.quantity->unit) +
              (own.at_least ? " at most" : " at least") +
              (conflict.members.size() > 1 ? " while the others hold" : "");
    text += '\n';
  }
  return text;
}

}  // namespace dashpot
