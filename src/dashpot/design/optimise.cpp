#include "dashpot/design/optimise.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <nlopt.h>

#include "dashpot/base/parallel.h"
#include "dashpot/error.h"
#include "dashpot/numerics/global_search.h"

namespace dashpot {
namespace {

// Searches keep this far inside of the constraints, in shares of the bounds: COBYLA ends on them to
// rounding.
constexpr double kMargin = 1e-7;
constexpr double kFails = 1e9;  // more than any goal that can be

struct Enough {};  // a search for feasibility is at its end

/// One start: remembers the best place it has seen, whatever stops it.
class Search {
 public:
  Search(const DesignProblem& problem, const std::size_t* goal, const OptimiseOptions& options)
      : problem_(problem), goal_(goal), options_(options) {
    const auto of_ride = [](const auto& asked) { return is_of_ride(*asked.quantity); };
    const std::vector<DesignConstraint>& constraints = problem.request().constraints;
    constrains_rides_ = goal && of_ride(problem.request().goals[*goal]) && !constraints.empty() &&
                        std::ranges::none_of(constraints, of_ride);
  }

  struct Seen {
    double value = 0, violation = 0;
    std::vector<double> slack;  // of the constraints that count
  };

  /// relaxed: without the steps of ranges; such a place is no design, and not kept.
  Seen look(std::span<const double> place, bool relaxed = false) {
    if (options_.monitor) options_.monitor->check();
    ++best_.evaluations;
    // Goals that this search does not follow are looked at where a place is better than any before,
    // which must have them.
    const DamperDescription damper = problem_.damper_at(place, relaxed);
    Seen seen = seen_of(problem_.assess_for(damper, goal_));
    if (relaxed) return seen;
    if (problem_.request().goals.size() > (goal_ ? 1 : 0) && is_better(seen))
      seen = seen_of(problem_.assess(damper));
    keep(place, seen);
    return seen;
  }
  /// The rank of a place. Nothing is ridden where the constraints alone set it.
  double look_for_rank(std::span<const double> place) {
    if (constrains_rides_) {
      if (options_.monitor) options_.monitor->check();
      const DamperDescription damper = problem_.damper_at(place);
      const Seen unridden = seen_of(problem_.assess_for(damper, nullptr), nullptr);
      if (unridden.violation > 0 && !best_.place.empty() && rank(unridden) >= best_rank_) {
        ++best_.evaluations;
        return rank(unridden);
      }
    }
    return rank(look(place));
  }
  /// A place that holds the constraints beats any that does not.
  static double rank(const Seen& seen) {
    return seen.violation > 0 ? kFails * (1 + seen.violation) : std::min(seen.value, kFails);
  }
  double best_rank() const { return best_rank_; }
  const OptimiseOptions& options() const { return options_; }
  Optimum& best() { return best_; }

 private:
  Seen seen_of(const Assessment& assessment) const { return seen_of(assessment, goal_); }
  Seen seen_of(const Assessment& assessment, const std::size_t* goal) const {
    Seen seen;
    for (std::size_t k = 0; k < assessment.slack.size(); ++k)
      if (options_.counted.empty() || options_.counted[k])
        seen.slack.push_back(assessment.slack[k] - kMargin);
    if (!assessment.possible || !assessment.known)  // what cannot be drawn is further off
      seen.slack.push_back(assessment.possible ? -1 : -2);
    for (const double slack : seen.slack) seen.violation += std::max(0., -slack);
    seen.value = goal ? value_of(assessment) : 0;
    return seen;
  }
  bool is_better(const Seen& seen) const { return best_.place.empty() || rank(seen) < best_rank_; }
  double value_of(const Assessment& assessment) const {
    if (!assessment.possible || !assessment.known) return kFails;
    const double figure = assessment.goals[*goal_];
    return problem_.request().goals[*goal_].maximise ? -figure : figure;
  }
  void keep(std::span<const double> place, const Seen& seen) {
    if (is_better(seen)) {
      best_rank_ = rank(seen);
      best_.place.assign(place.begin(), place.end());
      best_.violation = seen.violation;
      best_.value = seen.value;
    }
    if (!goal_ && seen.violation == 0) throw Enough();
  }

  const DesignProblem& problem_;
  const std::size_t* goal_;
  const OptimiseOptions& options_;
  bool constrains_rides_;  ///< a goal of a ride, under constraints that need none
  Optimum best_;
  double best_rank_ = HUGE_VAL;
};

/// COBYLA on some of the variables, the others held. NLopt asks for the goal and for the
/// constraints separately: the last place is remembered.
class Polish {
 public:
  Polish(Search& search, std::vector<double> place, std::vector<std::size_t> free, bool relaxed)
      : search_(search), place_(std::move(place)), free_(std::move(free)), relaxed_(relaxed) {
    seen_ = search_.look(place_, relaxed_);
    scale_ = std::max(std::abs(seen_.value), 1e-30);
  }

  /// `radius` of the first steps; looks for each variable. Returns the place reached.
  std::vector<double> run(double radius, int looks) {
    const auto count = static_cast<unsigned>(free_.size());
    if (count == 0) return place_;

    // COBYLA in the unit cube of the free variables, with the constraints that count.
    const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> solver(
        nlopt_create(NLOPT_LN_COBYLA, count), nlopt_destroy);
    solver_ = solver.get();
    nlopt_set_lower_bounds1(solver_, 0);
    nlopt_set_upper_bounds1(solver_, 1);
    nlopt_set_min_objective(solver_, goal, this);
    if (!seen_.slack.empty())
      nlopt_add_inequality_mconstraint(solver_, static_cast<unsigned>(seen_.slack.size()),
                                       constraints, this, nullptr);

    // It ends when its steps are small or its looks are used up.
    nlopt_set_initial_step1(solver_, radius);
    nlopt_set_xtol_abs1(solver_, search_.options().step);
    nlopt_set_maxeval(solver_, looks * static_cast<int>(count + 1));

    // From the place held to the one reached. What the problem threw on the way is thrown again.
    std::vector<double> x;
    for (const std::size_t k : free_) x.push_back(place_[k]);
    double value = 0;
    nlopt_optimize(solver_, x.data(), &value);
    if (failure_) std::rethrow_exception(failure_);
    for (std::size_t k = 0; k < free_.size(); ++k) place_[free_[k]] = x[k];
    return place_;
  }

 private:
  void move(const double* x) {
    // Goal and constraints ask at the same place: only a new one is looked at.
    bool moved = false;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      moved = moved || place_[free_[k]] != x[k];
      place_[free_[k]] = x[k];
    }
    if (!moved || failure_) return;

    // An exception must not cross NLopt's C code: it is kept, and the solver stopped.
    try {
      const std::size_t constraints = seen_.slack.size();
      seen_ = search_.look(place_, relaxed_);
      seen_.slack.resize(constraints, 1);  // where there is no figure there is one more
    } catch (...) {
      failure_ = std::current_exception();
      nlopt_force_stop(solver_);
    }
  }
  static double goal(unsigned, const double* x, double*, void* self) {
    auto& own = *static_cast<Polish*>(self);
    own.move(x);
    return own.seen_.value / own.scale_;
  }
  static void constraints(unsigned count, double* result, unsigned, const double* x, double*,
                          void* self) {
    auto& own = *static_cast<Polish*>(self);
    own.move(x);
    for (unsigned k = 0; k < count; ++k) result[k] = -own.seen_.slack[k];
  }

  Search& search_;
  std::vector<double> place_;
  std::vector<std::size_t> free_;
  bool relaxed_;
  Search::Seen seen_;
  double scale_ = 1;
  nlopt_opt solver_ = nullptr;
  std::exception_ptr failure_;
};

constexpr int kQuickLooks = 30;  // for each variable

/// Variables that COBYLA may move: those of any value and, relaxed, those in steps.
std::vector<std::size_t> movable(const DesignRequest& request, bool relaxed) {
  std::vector<std::size_t> free;
  for (std::size_t k = 0; k < request.variables.size(); ++k)
    if (request.variables[k].levels() == 0 || (relaxed && request.variables[k].step > 0))
      free.push_back(k);
  return free;
}

/// From a place: without steps at first, then with the nearest ones.
void polish(const DesignProblem& problem, Search& search, std::vector<double> place, int looks) {
  constexpr double kWide = 0.05, kNarrow = 0.005;
  const std::vector<std::size_t> all = movable(problem.request(), true),
                                 free = movable(problem.request(), false);
  if (all.size() > free.size())
    place = Polish(search, std::move(place), all, true).run(kWide, looks);
  for (const std::size_t k : all)
    if (problem.request().variables[k].levels() > 0)
      place[k] = problem.place_of_level(k, problem.level_at(k, place[k]));
  Polish(search, std::move(place), free, false)
      .run(all.size() > free.size() ? kNarrow : kWide, looks);
}

/// Levels to try in place of one: the neighbours of a step; all of a choice.
std::vector<std::size_t> other_levels(const DesignVariable& variable, std::size_t level) {
  std::vector<std::size_t> others;
  for (std::size_t other = 0; variable.step == 0 && other < variable.levels(); ++other)
    if (other != level) others.push_back(other);
  if (variable.step > 0 && level > 0) others.push_back(level - 1);
  if (variable.step > 0 && level + 1 < variable.levels()) others.push_back(level + 1);
  return others;
}

/// Polishes anew at each other level of one variable from the best place; whether one was better.
bool step_level(const DesignProblem& problem, Search& search, std::size_t k) {
  const double before = search.best_rank();
  const std::vector<double> place = search.best().place;
  const DesignVariable& variable = problem.request().variables[k];
  for (const std::size_t level : other_levels(variable, problem.level_at(k, place[k]))) {
    std::vector<double> trial = place;
    trial[k] = problem.place_of_level(k, level);
    if (variable.step > 0)
      Polish(search, trial, movable(problem.request(), false), false).run(0.005, kQuickLooks);
    else
      polish(problem, search, trial, kQuickLooks);
  }
  return search.best_rank() < before - 1e-6 * std::abs(before);
}

/// Where a start looks: where there are enough of them, at one fluid. Fluids have their best
/// dampers far apart, and a search among several ends in the one that is good in most places.
SearchBox box_of_start(const DesignProblem& problem, std::size_t start, std::size_t starts) {
  constexpr std::size_t kOfFluid = 2;  // starts, at least
  constexpr double kInside = 0.49;     // of a level's places, either way from their middle
  SearchBox box{std::vector<double>(problem.size(), 0.), std::vector<double>(problem.size(), 1.)};
  for (std::size_t k = 0; k < problem.size(); ++k) {
    const std::size_t fluids = problem.request().variables[k].fluids.size();
    if (fluids < 2 || starts < kOfFluid * fluids) continue;
    const double middle = problem.place_of_level(k, start % fluids);
    box.lower[k] = middle - kInside / static_cast<double>(fluids);
    box.upper[k] = middle + kInside / static_cast<double>(fluids);
  }
  return box;
}

void run_start(const DesignProblem& problem, Search& search, const OptimiseOptions& options,
               std::size_t start) {
  constexpr int kRounds = 4;

  // Controlled random search over the start's box, then COBYLA from its best place.
  const std::size_t size = problem.size();
  global_search([&](std::span<const double> place) { return search.look_for_rank(place); },
                box_of_start(problem, start, static_cast<std::size_t>(options.starts)),
                std::vector<double>(size, 0.5), options.evaluations * static_cast<int>(size),
                options.seed + start);
  polish(problem, search, search.best().place, options.looks);

  // The levels of each variable in turn, until a round over all variables brings nothing; a few
  // rounds at most.
  for (int round = 0; round < kRounds; ++round) {
    bool better = false;
    for (std::size_t k = 0; k < size; ++k)
      if (problem.request().variables[k].levels() > 1)
        better = step_level(problem, search, k) || better;
    if (!better) break;
  }

  // Last, the variables without levels in small steps.
  Polish(search, search.best().place, movable(problem.request(), false), false)
      .run(0.002, options.looks);
}

Optimum run_starts(const DesignProblem& problem, const std::size_t* goal,
                   const OptimiseOptions& options) {
  // Each start has its seed and its own search, so that threads change nothing.
  const auto starts = static_cast<std::size_t>(options.starts);
  std::vector<Search> searches(starts, Search(problem, goal, options));
  std::vector<char> stopped(starts, 0);
  parallel_for(starts, options.threads, [&](std::size_t k) {
    try {
      run_start(problem, searches[k], options, k);
    } catch (const Interrupted&) {
      stopped[k] = 1;
    } catch (const Enough&) {
      return;  // what was sought is found
    }
  });

  // The best of all; the first of equals.
  const auto best = std::ranges::min_element(searches, {}, &Search::best_rank);
  Optimum optimum = best->best();
  optimum.evaluations = 0;
  for (Search& search : searches) optimum.evaluations += search.best().evaluations;
  optimum.stopped = std::ranges::find(stopped, 1) != stopped.end();
  return optimum;
}

}  // namespace

Optimum optimise(const DesignProblem& problem, std::size_t goal, const OptimiseOptions& options) {
  return run_starts(problem, &goal, options);
}

Optimum refine(const DesignProblem& problem, std::size_t goal, std::vector<double> place,
               const OptimiseOptions& options) {
  constexpr double kRadius = 0.1;
  Search search(problem, &goal, options);
  try {
    Polish(search, std::move(place), movable(problem.request(), false), false)
        .run(kRadius, options.looks);
  } catch (const Interrupted&) {
    search.best().stopped = true;
  }
  return search.best();
}

Optimum least_violation(const DesignProblem& problem, const OptimiseOptions& options) {
  return run_starts(problem, nullptr, options);
}

}  // namespace dashpot
