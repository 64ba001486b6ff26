#include "dashpot/numerics/global_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <exception>
#include <memory>
#include <nlopt.h>

namespace dashpot {
namespace {

/// The state behind NLopt's void pointer. Exceptions must not travel through C: the first one is
/// kept and thrown again when NLopt has returned.
struct Search {
  const std::function<double(std::span<const double>)>& cost;
  nlopt_opt solver;
  std::exception_ptr failure;
};

double evaluate(unsigned count, const double* x, double*, void* data) {
  constexpr double kVeryBad = 1e300;
  Search& search = *static_cast<Search*>(data);
  if (search.failure) return kVeryBad;
  try {
    const double cost = search.cost({x, count});
    return std::isfinite(cost) ? cost : kVeryBad;
  } catch (...) {
    search.failure = std::current_exception();
    nlopt_force_stop(search.solver);
    return kVeryBad;
  }
}

}  // namespace

std::vector<double> global_search(const std::function<double(std::span<const double>)>& cost,
                                  const SearchBox& box, std::vector<double> start, int evaluations,
                                  std::uint64_t seed) {
  assert(box.lower.size() == start.size() && box.upper.size() == start.size());

  // The random state of NLopt is one per thread, so the seed is set right before the run.
  const auto count = static_cast<unsigned>(start.size());
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> solver(
      nlopt_create(NLOPT_GN_CRS2_LM, count), nlopt_destroy);
  Search search{cost, solver.get(), nullptr};
  nlopt_srand(static_cast<unsigned long>(seed));  // a state of its own in each thread

  nlopt_set_lower_bounds(solver.get(), box.lower.data());
  nlopt_set_upper_bounds(solver.get(), box.upper.data());
  nlopt_set_maxeval(solver.get(), evaluations);
  nlopt_set_min_objective(solver.get(), evaluate, &search);

  // NLopt refuses a start outside of the box.
  for (std::size_t k = 0; k < start.size(); ++k)
    start[k] = std::clamp(start[k], box.lower[k], box.upper[k]);

  // It returns the best point in `start`, also when it was stopped.
  double best = 0;
  nlopt_optimize(solver.get(), start.data(), &best);
  if (search.failure) std::rethrow_exception(search.failure);
  return start;
}

}  // namespace dashpot
