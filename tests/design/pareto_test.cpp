#include "dashpot/design/pareto.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "dashpot/error.h"
#include "support.h"

using namespace dashpot;

namespace {

/// ZDT1 (Zitzler, Deb, Thiele 2000) in four variables: its front is f2 = 1 - sqrt(f1), the others
/// 0. Held: f1 from 0.1 on.
FrontProblem zdt1() {
  FrontProblem problem{.size = 4, .goals = 2, .scale = {1, 1}};
  problem.evaluate = [](std::span<const double> x) {
    const double g = 1 + 9 * (x[1] + x[2] + x[3]) / 3;
    return FrontProblem::Value{{x[0], g * (1 - std::sqrt(x[0] / g))}, std::max(0., 0.1 - x[0])};
  };
  return problem;
}

}  // namespace

TEST_CASE("pareto: both methods come to the front of ZDT1, within its constraint") {
  for (const FrontMethod method : {FrontMethod::Nsga2, FrontMethod::Moead}) {
    const FrontProblem problem = zdt1();
    const Front front =
        pareto_front(problem, {.method = method, .points = 40, .generations = 150, .threads = 1});
    REQUIRE(front.places.size() == 40);
    double first = 1, last = 0;
    for (const auto& place : front.places) {
      const std::vector<double> goals = problem.evaluate(place).goals;
      CHECK(goals[0] >= 0.1);
      CHECK_CLOSE(goals[1], 1 - std::sqrt(goals[0]), 0, method == FrontMethod::Nsga2 ? 0.03 : 0.1);
      first = std::min(first, goals[0]);
      last = std::max(last, goals[0]);
    }
    CHECK(first < 0.12);
    CHECK(last > 0.95);
  }
}

TEST_CASE("pareto: the same front on any number of threads, and what is there when stopped") {
  const FrontProblem problem = zdt1();
  FrontOptions options{.points = 16, .generations = 10, .threads = 1};
  const Front one = pareto_front(problem, options);
  options.threads = 3;
  CHECK(pareto_front(problem, options).places == one.places);
  std::atomic<bool> stop = false;
  const Monitor monitor{[&](const Progress& progress) { stop = progress.fraction > 0.5; }, &stop};
  options.monitor = &monitor;
  const Front stopped = pareto_front(problem, options);
  CHECK(stopped.stopped);
  CHECK(!stopped.places.empty());
}
