#include "dashpot/numerics/least_squares.h"

#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <limits>
#include <unistd.h>

#include "dashpot/base/error.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A problem of NIST's Statistical Reference Datasets (nonlinear regression): certified to 11 digits.
struct Certified {
  std::function<double(std::span<const double> b, double x)> model;
  std::vector<double> start, values, deviations;
  double squares;  ///< residual sum of squares
  std::vector<double> x, y;
};

Certified misra1a() {
  return {[](std::span<const double> b, double x) { return b[0] * (1 - std::exp(-b[1] * x)); },
          {500, 1e-4},
          {2.3894212918e+02, 5.5015643181e-04},
          {2.7070075241e+00, 7.2668688436e-06},
          1.2455138894e-01,
          {77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0},
          {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78}};
}

Certified mgh09() {
  return {[](std::span<const double> b, double x) {
            return b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3]);
          },
          {0.25, 0.39, 0.415, 0.39},
          {1.9280693458e-01, 1.9128232873e-01, 1.2305650693e-01, 1.3606233068e-01},
          {1.1435312227e-02, 1.9633220911e-01, 8.0842031232e-02, 9.0025542308e-02},
          3.0750560385e-04,
          {4, 2, 1, 0.5, 0.25, 0.167, 0.125, 0.1, 0.0833, 0.0714, 0.0625},
          {0.1957, 0.1947, 0.1735, 0.16, 0.0844, 0.0627, 0.0456, 0.0342, 0.0323, 0.0235, 0.0246}};
}

Certified thurber() {
  return {
      [](std::span<const double> b, double x) {
        return (b[0] + x * (b[1] + x * (b[2] + x * b[3]))) / (1 + x * (b[4] + x * (b[5] + x * b[6])));
      },
      {1000, 1000, 400, 40, 0.7, 0.3, 0.03},
      {1.2881396800e+03, 1.4910792535e+03, 5.8323836877e+02, 7.5416644291e+01, 9.6629502864e-01,
       3.9797285797e-01, 4.9727297349e-02},
      {4.6647963344e+00, 3.9571156086e+01, 2.8698696102e+01, 5.5675370270e+00, 3.1333340687e-02,
       1.4984928198e-02, 6.5842344623e-03},
      5.6427082397e+03,
      {-3.067, -2.981, -2.921, -2.912, -2.840, -2.797, -2.702, -2.699, -2.633, -2.481, -2.363, -2.322, -1.501,
       -1.460, -1.274, -1.212, -1.100, -1.046, -0.915, -0.714, -0.566, -0.545, -0.400, -0.309, -0.109, -0.103,
       0.010,  0.119,  0.377,  0.790,  0.963,  1.006,  1.115,  1.572,  1.841,  2.047,  2.200},
      {80.574,   84.248,   87.264,   87.195,   89.076,   89.608,   89.868,   90.101,   92.405,   95.854,
       100.696,  101.060,  401.672,  390.724,  567.534,  635.316,  733.054,  759.087,  894.206,  990.785,
       1090.109, 1080.914, 1122.643, 1178.351, 1260.531, 1273.514, 1288.339, 1327.543, 1353.863, 1414.509,
       1425.208, 1421.384, 1442.962, 1464.350, 1468.705, 1447.894, 1457.628}};
}

/// Unknowns are the parameters divided by their start, so that all are of order 1.
LeastSquaresProblem scaled(const Certified& nist) {
  LeastSquaresProblem problem;
  problem.residuals = nist.y.size();
  problem.lower.assign(nist.start.size(), -kInfinity);
  problem.upper.assign(nist.start.size(), kInfinity);
  problem.residual = [&nist](std::span<const double> u, std::span<double> r) {
    std::vector<double> b(u.begin(), u.end());
    for (std::size_t k = 0; k < b.size(); ++k) b[k] *= nist.start[k];
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = nist.model(b, nist.x[i]) - nist.y[i];
    return true;
  };
  return problem;
}

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

TEST_CASE("NIST problems: certified values, standard deviations and sums of squares") {
  for (const Certified& nist : {misra1a(), mgh09(), thurber()}) {
    const std::size_t n = nist.start.size();
    const LeastSquaresProblem problem = scaled(nist);
    LeastSquaresOptions options;
    options.max_iterations = 500;
    options.function_tolerance = 1e-15;
    const LeastSquaresReport report = solve(problem, std::vector<double>(n, 1.0), options);
    CHECK(report.converged);
    CHECK_CLOSE(2 * report.cost, nist.squares, 1e-9, 0);
    const SymmetricInverse covariance = invert_symmetric(report.normal_matrix, n);
    const double variance = 2 * report.cost / static_cast<double>(nist.y.size() - n);
    for (std::size_t k = 0; k < n; ++k) {
      // Forward differences of step 1e-6 leave about 1e-5 in the deviations.
      CHECK_CLOSE(report.x[k] * nist.start[k], nist.values[k], 2e-5, 0);
      CHECK_CLOSE(std::sqrt(variance * covariance.inverse[k * n + k]) * nist.start[k], nist.deviations[k],
                  1e-4, 0);
    }
  }
}

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

TEST_CASE("the same bits on any number of threads") {
  const Certified nist = thurber();
  const std::vector<double> start(7, 1.0);
  const LeastSquaresReport one = solve(scaled(nist), start, {.threads = 1});
  const LeastSquaresReport four = solve(scaled(nist), start, {.threads = 4});
  CHECK(one.x == four.x);
  CHECK(one.normal_matrix == four.normal_matrix);
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
  options.on_iteration = [&](int iteration, double) {
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
