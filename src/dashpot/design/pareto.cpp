#include "dashpot/design/pareto.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/moead.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/utils/multi_objective.hpp>

#include "dashpot/base/parallel.h"
#include "dashpot/base/random.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr double kFailsFront = 1e6;  // in units of the goals' extent
using Places = std::vector<pagmo::vector_double>;

/// The problem as pagmo sees it; a place that fails is worse in every goal than any that holds.
struct PagmoProblem {
  const FrontProblem* problem = nullptr;
  std::atomic<std::size_t>* evaluations = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& place) const {
    ++*evaluations;
    FrontProblem::Value value = problem->evaluate(place);
    if (value.violation > 0)
      return pagmo::vector_double(problem->goals, kFailsFront * (1 + value.violation));
    for (std::size_t k = 0; k < value.goals.size(); ++k) value.goals[k] /= problem->scale[k];
    return value.goals;
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(problem->size, 0.), pagmo::vector_double(problem->size, 1.)};
  }
  pagmo::vector_double::size_type get_nobj() const { return problem->goals; }
};

/// A generation at a time on Dashpot's threads.
struct ParallelEvaluation {
  int threads = 0;

  pagmo::vector_double operator()(const pagmo::problem& problem,
                                  const pagmo::vector_double& places) const {
    const std::size_t size = problem.get_nx(), goals = problem.get_nobj(),
                      count = places.size() / size;
    const auto& own = *problem.extract<PagmoProblem>();
    pagmo::vector_double all(count * goals);
    parallel_for(count, threads, [&](std::size_t k) {
      const auto* place = places.data() + k * size;
      std::ranges::copy(own.fitness({place, place + size}),
                        all.begin() + static_cast<std::ptrdiff_t>(k * goals));
    });
    return all;
  }
};

/// The places seen that hold the constraints and that none beats, thinned where they crowd.
class Archive {
 public:
  explicit Archive(std::size_t most) : most_(most) {}
  void add(const pagmo::population& population) {
    for (std::size_t k = 0; k < population.size(); ++k)
      if (const auto& goals = population.get_f()[k]; goals[0] < kFailsFront)
        insert(population.get_x()[k], goals);
    if (places_.size() <= most_) return;
    std::vector<std::size_t> kept = pagmo::select_best_N_mo(goals_, most_);
    std::ranges::sort(kept);
    Places places, goals;
    for (const std::size_t k : kept) {
      places.push_back(places_[k]);
      goals.push_back(goals_[k]);
    }
    places_.swap(places);
    goals_.swap(goals);
  }
  const Places& places() const { return places_; }

 private:
  void insert(const pagmo::vector_double& place, const pagmo::vector_double& goals) {
    for (const auto& known : goals_)
      if (known == goals || pagmo::pareto_dominance(known, goals)) return;

    // Drops those that the new place dominates, the others keeping their order.
    std::size_t kept = 0;
    for (std::size_t k = 0; k < goals_.size(); ++k) {
      if (pagmo::pareto_dominance(goals, goals_[k])) continue;
      if (kept != k) {
        goals_[kept].swap(goals_[k]);
        places_[kept].swap(places_[k]);
      }
      ++kept;
    }

    // The new place, which none of them dominates, joins them.
    goals_.resize(kept);
    places_.resize(kept);
    goals_.push_back(goals);
    places_.push_back(place);
  }

  std::size_t most_;
  Places places_, goals_;
};

pagmo::population first_population(const FrontProblem& problem, const FrontOptions& options,
                                   const PagmoProblem& seen) {
  // NSGA-II wants a multiple of four.
  const std::size_t size = std::max<std::size_t>(24, (options.points + 3) / 4 * 4);

  // The starts given, filled up with random places.
  Random random(options.seed);
  Places places = problem.starts;
  places.resize(std::min(places.size(), size));
  while (places.size() < size) {
    places.emplace_back(problem.size);
    for (double& part : places.back()) part = random.uniform();
  }

  // All are evaluated side by side; the population gets them with their goals.
  std::vector<pagmo::vector_double> goals(size);
  parallel_for(size, options.threads, [&](std::size_t k) { goals[k] = seen.fitness(places[k]); });
  pagmo::population population{pagmo::problem(seen), 0u, static_cast<unsigned>(options.seed)};
  for (std::size_t k = 0; k < size; ++k) population.push_back(places[k], goals[k]);
  return population;
}

pagmo::algorithm algorithm_of(const FrontProblem& problem, const FrontOptions& options) {
  const auto seed = static_cast<unsigned>(options.seed);
  if (options.method == FrontMethod::Moead)
    return pagmo::algorithm(pagmo::moead(1u, problem.goals == 2 ? "grid" : "low discrepancy",
                                         "tchebycheff", 20u, 1.0, 0.5, 20., 0.9, 2u, true, seed));
  pagmo::nsga2 method(1u, 0.95, 10., 1. / static_cast<double>(problem.size), 50., seed);
  method.set_bfe(pagmo::bfe(ParallelEvaluation{options.threads}));
  return pagmo::algorithm(method);
}

}  // namespace

Front pareto_front(const FrontProblem& problem, const FrontOptions& options) {
  std::atomic<std::size_t> evaluations = 0;
  Archive archive(options.points);
  Front front;

  // A generation at a time; the archive keeps the best of all of them.
  try {
    pagmo::population population = first_population(problem, options, {&problem, &evaluations});
    const pagmo::algorithm algorithm = algorithm_of(problem, options);
    archive.add(population);
    for (int k = 0; k < options.generations; ++k) {
      if (options.monitor)
        options.monitor->report("front of " + std::to_string(archive.places().size()) + " designs",
                                static_cast<double>(k) / options.generations);
      population = algorithm.evolve(population);
      archive.add(population);
    }
  } catch (const Interrupted&) {
    front.stopped = true;
  }

  // A search that was stopped returns the front so far.
  front.places = archive.places();
  front.evaluations = evaluations;
  return front;
}

}  // namespace dashpot
