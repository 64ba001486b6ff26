#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "dashpot/monitor.h"

namespace dashpot {

enum class FrontMethod {
  Nsga2,  ///< Deb and others 2002
  Moead   ///< Zhang and Li 2007, with differential evolution (Li and Zhang 2009)
};

/// Several numbers to be made small over the unit cube, under constraints.
struct FrontProblem {
  struct Value {
    std::vector<double> goals;
    double violation = 0;  ///< 0: the constraints hold
  };
  std::size_t size = 0, goals = 0;
  std::function<Value(std::span<const double> place)> evaluate;  ///< called from several threads
  std::vector<double> scale;                                     ///< the extent of each goal, about
  std::vector<std::vector<double>> starts;  ///< places to start from, beside random ones
};

/// How the front is sought.
struct FrontOptions {
  FrontMethod method = FrontMethod::Nsga2;
  std::size_t points = 200;
  int generations = 100;
  std::uint64_t seed = 1;
  int threads = 0;  ///< results do not depend on it
  const Monitor* monitor = nullptr;
};

/// The places found, best in one goal or another.
struct Front {
  std::vector<std::vector<double>> places;  ///< of which none is better than another in all goals
  std::size_t evaluations = 0;
  bool stopped = false;  ///< the user asked to stop: the front so far
};

/// At most `points` places that hold the constraints, spread over the front. A place that does not
/// hold them is worse than any that does. By pagmo2.
Front pareto_front(const FrontProblem& problem, const FrontOptions& options);

}  // namespace dashpot
