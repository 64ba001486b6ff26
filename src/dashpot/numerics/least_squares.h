#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace dashpot {

/// A problem min 0.5 |r(x)|^2 within bounds, for Levenberg-Marquardt by Ceres. Ceres itself appears
/// in least_squares.cpp only. The order of the unknowns is that of lower, upper and start.
struct LeastSquaresProblem {
  std::size_t residuals = 0;
  /// First residual of each part, ascending from 0; J'J is reported part by part.
  std::vector<std::size_t> parts = {0};
  /// One per unknown; +-infinity allowed; equal: that unknown is fixed.
  std::vector<double> lower, upper;
  /// Residuals at x. Returns false where they cannot be computed (the step is then rejected), and
  /// so counts a residual that is not finite. Called from several threads at a time.
  std::function<bool(std::span<const double> x, std::span<double> r)> residual;
  /// The residuals at x and the Jacobian column by column; a column that is not wanted is nullptr.
  /// Empty: forward differences, one column per task on the farm.
  std::function<bool(std::span<const double> x, std::span<double> r,
                     std::span<double* const> columns)>
      jacobian;
};

/// How a step within bounds is shortened along itself before it is judged.
enum class LineSearch {
  ByJacobians,  ///< at a Jacobian for each trial
  ByResiduals   ///< at the residuals alone for each
};

/// When to stop and how to differentiate.
struct LeastSquaresOptions {
  int max_iterations = 100;
  double function_tolerance = 1e-8;  ///< stop when the cost falls by less than this share
  double difference_step = 1e-6;     ///< relative to max(|x|, 1)
  double first_radius = 1e4;         ///< of the trust region; small ones hold the first steps back
  int threads = 0;                   ///< results do not depend on it
  LineSearch line_search = LineSearch::ByJacobians;
  bool normal_equations = false;  ///< quicker with many unknowns, at half the digits
  int hopeless_after = 0;         ///< gives up when after so many iterations (0: never) ...
  double hopeless_cost = 0;       ///< ... the cost is still above this
  /// `x`: the best so far; may throw to stop.
  std::function<void(int iteration, double cost, std::span<const double> x)> on_iteration;
};

/// How the search ended. n unknowns, m residuals: normal_matrix is n x n, gradient n; rows and
/// columns of fixed unknowns are zero.
struct LeastSquaresReport {
  bool converged = false;
  std::string message;
  int iterations = 0;
  double cost = 0;  ///< 0.5 |r|^2; infinity when the residuals cannot be computed at the start
  std::vector<double> x;
  std::vector<double> normal_matrix;  ///< J'J at the end, row by row; empty when there is no J
  std::vector<std::vector<double>> part_matrices;  ///< the same of each part of the residuals
  std::vector<double> gradient;                    ///< J'r at the end, likewise
};

/// Solves it from `start`, one number per unknown, which is moved into the bounds first. Not
/// converging is a status in the report; exceptions of the callbacks end the search and are passed
/// on. The same input gives the same bits, whatever the number of threads.
LeastSquaresReport solve(const LeastSquaresProblem& problem, std::vector<double> start,
                         const LeastSquaresOptions& options = {});

/// Cost, J'J and J'r at x, without a search; x is moved into the bounds first.
LeastSquaresReport describe_at(const LeastSquaresProblem& problem, std::vector<double> x,
                               const LeastSquaresOptions& options = {});

}  // namespace dashpot
