#include "dashpot/numerics/minimise.h"

#include <array>

#include "dashpot/error.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Rosenbrock's valley: its minimum is 0 at (1, 1).
bool valley(std::span<const double> x, double& value, std::span<double> gradient) {
  const double a = 1 - x[0], b = x[1] - x[0] * x[0];
  value = a * a + 100 * b * b;
  gradient[0] = -2 * a - 400 * x[0] * b;
  gradient[1] = 200 * b;
  return true;
}

}  // namespace

TEST_CASE("L-BFGS goes through Rosenbrock's valley") {
  const MinimiseReport report = minimise(valley, {-1.2, 1}, {.function_tolerance = 1e-16});
  CHECK(report.converged);
  CHECK_CLOSE(report.x[0], 1, 0, 1e-6);
  CHECK_CLOSE(report.x[1], 1, 0, 1e-6);
  CHECK_CLOSE(report.value, 0, 0, 1e-12);
}

TEST_CASE("a listener ends the search, and its exception comes out") {
  MinimiseOptions options;
  options.on_iteration = [](int iteration, double, std::span<const double>) {
    return iteration < 3;
  };
  CHECK(minimise(valley, {-1.2, 1}, options).iterations == 3);
  options.on_iteration = [](int, double, std::span<const double>) -> bool { throw Interrupted(); };
  CHECK_THROWS_AS(minimise(valley, {-1.2, 1}, options), Interrupted);
  const SmoothFunction fails = [](std::span<const double>, double&, std::span<double>) -> bool {
    throw Error("f", "fails");
  };
  CHECK_THROWS_AS(minimise(fails, {0.0}), Error);
}

TEST_CASE("a function that cannot be computed at the start does not converge") {
  const SmoothFunction never = [](std::span<const double>, double&, std::span<double>) {
    return false;
  };
  CHECK_FALSE(minimise(never, {0.0}).converged);
}
