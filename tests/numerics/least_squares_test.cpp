#include "dashpot/numerics/least_squares.h"

#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <limits>
#include <unistd.h>

#include "dashpot/error.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Rosenbrock's function as residuals 10 (y - x^2) and 1 - x, with its Jacobian.
LeastSquaresProblem rosenbrock() {
  LeastSquaresProblem problem;
  problem.residuals = 2;
  problem.lower = {-kInfinity, -kInfinity};
  problem.upper = {kInfinity, kInfinity};

  problem.residual = [](std::span<const double> x, std::span<double> r) {
    r[0] = 10 * (x[1] - x[0] * x[0]);
    r[1] = 1 - x[0];
    return true;
  };

  problem.jacobian = [residual = problem.residual](std::span<const double> x, std::span<double> r,
                                                   std::span<double* const> columns) {
    if (columns[0]) columns[0][0] = -20 * x[0], columns[0][1] = -1;
    if (columns[1]) columns[1][0] = 10, columns[1][1] = 0;
    return residual(x, r);
  };
  return problem;
}

}  // namespace

TEST_CASE("Rosenbrock: free, with its Jacobian, bounded, and with a fixed unknown") {
  LeastSquaresProblem problem = rosenbrock();
  LeastSquaresReport report = solve(problem, {-1.2, 1}, {.function_tolerance = 1e-16});
  CHECK(report.converged);
  CHECK(report.iterations > 3);
  CHECK_CLOSE(report.x[0], 1, 1e-8, 0);
  CHECK_CLOSE(report.normal_matrix[0], 401, 1e-7, 0);  // J = [[-20, 10], [-1, 0]]
  CHECK_CLOSE(report.normal_matrix[1], -200, 1e-7, 0);

  // With x <= 0.5 the minimum lies at (0.5, 0.25), cost 0.5 * 0.5^2; differences must step inwards.
  problem.jacobian = nullptr;
  problem.upper[0] = 0.5;
  problem.residual = [inner = problem.residual](std::span<const double> x, std::span<double> r) {
    CHECK(x[0] <= 0.5);
    return inner(x, r);
  };
  report = solve(problem, {3, 1}, {.function_tolerance = 1e-14, .threads = 1});
  CHECK(report.converged);
  CHECK_CLOSE(report.x[0], 0.5, 1e-9, 0);
  CHECK_CLOSE(report.x[1], 0.25, 1e-6, 0);
  CHECK_CLOSE(report.cost, 0.125, 1e-9, 0);

  // x fixed at -1: y = 1.
  problem.lower[0] = problem.upper[0] = -1;
  report = solve(problem, {-1, 5});
  CHECK(report.x[0] == -1);
  CHECK_CLOSE(report.x[1], 1, 1e-6, 0);
  CHECK(report.normal_matrix[0] == 0);
}

TEST_CASE("residuals that fail: avoided on the way, reported at the start, silent on stderr") {
  LeastSquaresProblem problem;
  problem.residuals = 1;
  problem.lower = {-kInfinity};
  problem.upper = {kInfinity};
  problem.residual = [](std::span<const double> x, std::span<double> r) {
    r[0] = std::log(x[0]);  // the first full step from 3 goes to x < 0
    return x[0] > 0;
  };
  const TemporaryFolder folder;
  const auto log = folder.path() / "stderr";
  const int saved = dup(STDERR_FILENO), file = open(log.c_str(), O_WRONLY | O_CREAT, 0600);
  dup2(file, STDERR_FILENO);
  const LeastSquaresReport reached = solve(problem, {30}, {.function_tolerance = 1e-14});
  const LeastSquaresReport failed = solve(problem, {-1});
  problem.residual = [](std::span<const double>, std::span<double> r) { return r[0] = NAN, true; };
  const LeastSquaresReport not_finite = solve(problem, {1});
  dup2(saved, STDERR_FILENO);
  close(file), close(saved);

  CHECK(reached.converged);
  CHECK_CLOSE(reached.x[0], 1, 1e-6, 0);
  CHECK_FALSE(failed.converged);
  CHECK(failed.message == "the residuals cannot be computed at the start");
  CHECK(failed.x == std::vector<double>{-1});
  CHECK(failed.cost == kInfinity);
  CHECK_FALSE(not_finite.converged);
  CHECK(not_finite.normal_matrix.empty());
  std::ifstream printed(log);
  CHECK(std::string(std::istreambuf_iterator<char>(printed), {}) == "");
}

TEST_CASE("what callbacks throw comes out") {
  LeastSquaresProblem problem = rosenbrock();
  int last = -1;
  LeastSquaresOptions options;
  options.on_iteration = [&](int iteration, double, std::span<const double>) {
    last = iteration;
    if (iteration == 2) throw Interrupted();
  };
  CHECK_THROWS_AS(solve(problem, {-1.2, 1}, options), Interrupted);
  CHECK(last == 2);
  problem.residual = [](std::span<const double>, std::span<double>) -> bool {
    throw Error("record 3", "no");
  };
  problem.jacobian = nullptr;
  CHECK(message_of([&] { solve(problem, {-1.2, 1}); }).find("record 3") != std::string::npos);
}

TEST_CASE("the iteration limit is reported, with the best point so far") {
  const LeastSquaresReport report = solve(rosenbrock(), {-1.2, 1}, {.max_iterations = 3});
  CHECK_FALSE(report.converged);
  CHECK(report.iterations == 3);
  CHECK(report.cost < 12.1);  // at the start: 0.5 * 24.2
}

TEST_CASE("a point is described as the end of a search that goes nowhere") {
  const LeastSquaresProblem problem = rosenbrock();
  const LeastSquaresReport end = solve(problem, {-1.2, 1});
  const LeastSquaresReport there = describe_at(problem, end.x);
  CHECK(there.x == end.x);
  CHECK(there.cost == end.cost);
  CHECK(there.normal_matrix == end.normal_matrix);
  CHECK(there.part_matrices == end.part_matrices);
  CHECK(there.gradient == end.gradient);
}
