#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace dashpot {

/// A smooth function without bounds: writes its value at x and its gradient there, one number per
/// unknown. Returns false where it cannot be computed; the line search then takes a smaller step.
using SmoothFunction =
    std::function<bool(std::span<const double> x, double& value, std::span<double> gradient)>;

/// When to stop.
struct MinimiseOptions {
  int max_iterations = 500;
  double function_tolerance = 1e-9;  ///< stop when the value falls by less than this share
  int memory = 20;                   ///< steps that shape the Hessian
  /// After each step with the point reached; may throw to stop, false ends the search there.
  std::function<bool(int iteration, double value, std::span<const double> x)> on_iteration;
};

/// How the search ended: `x` is the best point, `value` the function there.
struct MinimiseReport {
  bool converged = false;
  std::string message;
  int iterations = 0;
  double value = 0;
  std::vector<double> x;
};

/// L-BFGS with a line search after Wolfe, by Ceres. Not converging is a status in the report;
/// exceptions of the callbacks end the search and are passed on.
MinimiseReport minimise(const SmoothFunction& function, std::vector<double> start,
                        const MinimiseOptions& options = {});

}  // namespace dashpot
