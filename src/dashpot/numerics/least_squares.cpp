#include "dashpot/numerics/least_squares.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <exception>
#include <limits>
#include <numeric>

#include <ceres/ceres.h>

#include "dashpot/base/parallel.h"
#include "dashpot/numerics/quiet_ceres.h"
#include "dashpot/numerics/search_ending.h"

namespace dashpot {
namespace {

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

/// The whole problem as one Ceres residual block. Every unknown is a parameter block of its own, so
/// that Ceres asks for the Jacobian column by column and a fixed unknown is simply a constant
/// block. Exceptions must not travel through Ceres: the first one is kept in `failure`.
class WholeProblem final : public ceres::CostFunction {
 public:
  WholeProblem(const LeastSquaresProblem& problem, const LeastSquaresOptions& options,
               std::exception_ptr& failure)
      : problem_(problem), options_(options), failure_(failure) {
    set_num_residuals(static_cast<int>(problem.residuals));
    mutable_parameter_block_sizes()->assign(problem.lower.size(), 1);
  }

  bool Evaluate(double const* const* unknowns, double* residuals, double** columns) const override {
    std::vector<double> x(problem_.lower.size());
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = *unknowns[k];
    return evaluate(x, {residuals, problem_.residuals}, columns);
  }

  /// columns: nullptr, or one pointer per unknown, nullptr where its column is not wanted.
  bool evaluate(std::span<const double> x, std::span<double> r, double** columns) const {
    if (failure_) return false;
    try {
      if (!columns) return residual(x, r);
      return problem_.jacobian ? analytic(x, r, columns) : differences(x, r, columns);
    } catch (...) {
      failure_ = std::current_exception();
      return false;
    }
  }

 private:
  bool residual(std::span<const double> x, std::span<double> r) const {
    return problem_.residual(x, r) && all_finite(r);
  }

  bool analytic(std::span<const double> x, std::span<double> r, double** columns) const {
    if (!problem_.jacobian(x, r, {columns, x.size()}) || !all_finite(r)) return false;
    return std::all_of(columns, columns + x.size(),
                       [&](const double* c) { return !c || all_finite({c, r.size()}); });
  }

  bool differences(std::span<const double> x, std::span<double> r, double** columns) const {
    if (!residual(x, r)) return false;
    std::atomic<bool> complete = true;
    parallel_for(x.size(), options_.threads, [&](std::size_t k) {
      if (columns[k] && !difference_column(x, r, k, {columns[k], r.size()})) complete = false;
    });
    return complete;
  }

  /// Steps up, or down when a bound leaves more room there; the other way when the residuals fail.
  bool difference_column(std::span<const double> x, std::span<const double> r, std::size_t k,
                         std::span<double> column) const {
    const double step = options_.difference_step * std::max(std::abs(x[k]), 1.0);
    const double up = std::min(x[k] + step, problem_.upper[k]);
    const double down = std::max(x[k] - step, problem_.lower[k]);
    const bool upward = problem_.upper[k] >= x[k] + step || up - x[k] >= x[k] - down;
    std::vector<double> moved(x.begin(), x.end());
    for (const double target : upward ? std::array{up, down} : std::array{down, up}) {
      moved[k] = target;
      if (target == x[k] || !residual(moved, column)) continue;
      for (std::size_t i = 0; i < r.size(); ++i) column[i] = (column[i] - r[i]) / (target - x[k]);
      return true;
    }
    return false;
  }

  const LeastSquaresProblem& problem_;
  const LeastSquaresOptions& options_;
  std::exception_ptr& failure_;
};

/// Unknowns that a bound holds at x (a fixed unknown is held by both).
std::vector<bool> held_by_bounds(const LeastSquaresProblem& problem, const std::vector<double>& x) {
  std::vector<bool> held(x.size());
  for (std::size_t k = 0; k < x.size(); ++k)
    held[k] = x[k] == problem.lower[k] || x[k] == problem.upper[k];
  return held;
}

/// Passes iterations on; stops Ceres once a callback has thrown, or when another unknown arrives at
/// a bound.
class LeastSquaresListener final : public ceres::IterationCallback {
 public:
  LeastSquaresListener(const LeastSquaresProblem& problem, const LeastSquaresOptions& options,
                       const LeastSquaresReport& report, std::exception_ptr& failure)
      : problem_(problem), options_(options), report_(report), failure_(failure) {}

  void set_held(const std::vector<bool>& held) { held_ = held; }
  bool hopeless() const { return hopeless_; }

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    try {
      if (!failure_ && options_.on_iteration)
        options_.on_iteration(report_.iterations + summary.iteration, summary.cost, report_.x);
    } catch (...) {
      failure_ = std::current_exception();
    }
    if (failure_) return ceres::SOLVER_ABORT;
    hopeless_ = options_.hopeless_after > 0 && summary.cost > options_.hopeless_cost &&
                report_.iterations + summary.iteration >= options_.hopeless_after;
    if (hopeless_) return ceres::SOLVER_ABORT;
    const bool arrived = held_by_bounds(problem_, report_.x) != held_;
    return arrived && summary.iteration > 0 ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                            : ceres::SOLVER_CONTINUE;
  }

 private:
  const LeastSquaresProblem& problem_;
  const LeastSquaresOptions& options_;
  const LeastSquaresReport& report_;
  std::exception_ptr& failure_;
  std::vector<bool> held_;
  bool hopeless_ = false;
};

ceres::Solver::Options ceres_options(const LeastSquaresOptions& options,
                                     LeastSquaresListener& listener) {
  ceres::Solver::Options result;
  result.linear_solver_type =
      options.normal_equations ? ceres::DENSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
  result.max_num_iterations = options.max_iterations;
  result.initial_trust_region_radius = options.first_radius;
  result.function_tolerance = options.function_tolerance;
  if (options.line_search == LineSearch::ByResiduals)
    result.line_search_interpolation_type = ceres::QUADRATIC;
  result.max_num_consecutive_invalid_steps = 50;  // residuals may fail in a large part of the space
  result.update_state_every_iteration = true;     // so that x is the best one also after a failure
  result.logging_type = ceres::SILENT;
  result.callbacks.push_back(&listener);
  return result;
}

/// Runs Ceres from report.x on; `held` unknowns stay where they are.
void run(const LeastSquaresProblem& problem, const std::vector<bool>& held,
         const ceres::Solver::Options& options, WholeProblem& whole, LeastSquaresReport& report) {
  // One block of residuals over one parameter block per unknown.
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem target(ownership);
  std::vector<double*> blocks;
  for (double& x : report.x) blocks.push_back(&x);
  target.AddResidualBlock(&whole, nullptr, blocks);

  // Bounds: an unknown that is held is a constant; infinite bounds are not given to Ceres at all.
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (held[k]) {
      target.SetParameterBlockConstant(blocks[k]);
      continue;
    }
    if (std::isfinite(problem.lower[k]))
      target.SetParameterLowerBound(blocks[k], 0, problem.lower[k]);
    if (std::isfinite(problem.upper[k]))
      target.SetParameterUpperBound(blocks[k], 0, problem.upper[k]);
  }

  ceres::Solver::Summary summary;
  ceres::Solve(options, &target, &summary);

  // Ceres counts the evaluation at the start as an iteration; the report does not.
  report.converged = summary.termination_type == ceres::CONVERGENCE;
  report.message = search_ending(
      report.converged, summary.termination_type == ceres::NO_CONVERGENCE, summary.message);
  report.iterations += std::max(0, static_cast<int>(summary.iterations.size()) - 1);
}

/// J'J of the residuals [first, end); the columns of J are m long.
std::vector<double> normal_matrix(const std::vector<double>& jacobian, std::size_t m,
                                  std::size_t first, std::size_t end) {
  const std::size_t n = jacobian.size() / m;
  std::vector<double> matrix(n * n);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b <= a; ++b)
      matrix[a * n + b] = matrix[b * n + a] = std::inner_product(
          &jacobian[a * m] + first, &jacobian[a * m] + end, &jacobian[b * m] + first, 0.0);
  return matrix;
}

/// Cost, J'J and J'r at report.x; rows and columns of fixed unknowns are zero.
void describe_end(const WholeProblem& whole, const LeastSquaresProblem& problem, int threads,
                  LeastSquaresReport& report) {
  // Residuals and Jacobian at the end, without the columns of fixed unknowns. Where the derivatives
  // fail the residuals may still be there.
  const std::size_t n = report.x.size(), m = problem.residuals;
  std::vector<double> r(m), jacobian(m * n, 0.0);
  std::vector<double*> columns(n, nullptr);
  for (std::size_t k = 0; k < n; ++k)
    if (problem.lower[k] < problem.upper[k]) columns[k] = &jacobian[k * m];
  const bool has_jacobian = whole.evaluate(report.x, r, columns.data());
  if (!has_jacobian && !whole.evaluate(report.x, r, nullptr)) {
    report.cost = std::numeric_limits<double>::infinity();
    return;
  }

  report.cost = 0.5 * std::inner_product(r.begin(), r.end(), r.begin(), 0.0);
  if (!has_jacobian) return;

  // Gradient and, part by part, the normal matrices, which add up to the whole one.
  report.normal_matrix.assign(n * n, 0.0);
  report.gradient.assign(n, 0.0);
  for (std::size_t a = 0; a < n; ++a)
    report.gradient[a] = std::inner_product(&jacobian[a * m], &jacobian[a * m] + m, r.begin(), 0.0);
  report.part_matrices.assign(problem.parts.size(), {});
  parallel_for(problem.parts.size(), threads, [&](std::size_t p) {
    const std::size_t end = p + 1 < problem.parts.size() ? problem.parts[p + 1] : m;
    report.part_matrices[p] = normal_matrix(jacobian, m, problem.parts[p], end);
  });
  for (const std::vector<double>& part : report.part_matrices)
    std::transform(report.normal_matrix.begin(), report.normal_matrix.end(), part.begin(),
                   report.normal_matrix.begin(), std::plus());
}

/// Lets go of unknowns that would lower the cost by leaving their bound, each once. True when there
/// are any.
bool release(const LeastSquaresProblem& problem, const LeastSquaresReport& report,
             std::vector<bool>& held, std::vector<bool>& released) {
  bool any = false;
  for (std::size_t k = 0; k < held.size() && !report.gradient.empty(); ++k) {
    const bool inward =
        report.x[k] == problem.lower[k] ? report.gradient[k] < 0 : report.gradient[k] > 0;
    if (!held[k] || released[k] || !inward || problem.lower[k] == problem.upper[k]) continue;
    // The gain that the unknown's own curvature promises must be worth another run.
    const double curvature = report.normal_matrix[k * held.size() + k];
    if (report.gradient[k] * report.gradient[k] < 2e-6 * report.cost * curvature) continue;

    held[k] = false;
    released[k] = any = true;
  }
  return any;
}

}  // namespace

LeastSquaresReport solve(const LeastSquaresProblem& problem, std::vector<double> start,
                         const LeastSquaresOptions& options) {
  assert(!start.empty() && problem.lower.size() == start.size() &&
         problem.upper.size() == start.size());
  quiet_ceres();
  LeastSquaresReport report;
  report.x = std::move(start);
  for (std::size_t k = 0; k < report.x.size(); ++k)
    report.x[k] = std::clamp(report.x[k], problem.lower[k], problem.upper[k]);

  std::exception_ptr failure;
  LeastSquaresListener listener(problem, options, report, failure);
  WholeProblem whole(problem, options, failure);
  ceres::Solver::Options settings = ceres_options(options, listener);

  // Ceres cuts its steps off at the bounds, and then creeps along them. So an unknown that arrives
  // at a bound is held there and the run goes on without it; at the end those that pull away from
  // theirs are let go.
  std::vector<bool> held = held_by_bounds(problem, report.x), released(held.size(), false);
  for (std::size_t k = 0; k < held.size(); ++k) held[k] = problem.lower[k] == problem.upper[k];
  while (!failure) {
    settings.max_num_iterations = std::max(1, options.max_iterations - report.iterations);
    listener.set_held(held);
    run(problem, held, settings, whole, report);
    if (listener.hopeless()) {
      report.cost = std::numeric_limits<double>::infinity();
      report.message = "given up: the cost stays too high";
      return report;
    }
    const std::vector<bool> now = held_by_bounds(problem, report.x);
    const bool arrived = now != held;
    held = now;
    if (arrived && report.iterations < options.max_iterations) continue;
    if (!failure) describe_end(whole, problem, options.threads, report);
    if (report.iterations >= options.max_iterations || !release(problem, report, held, released))
      break;
  }
  if (failure) std::rethrow_exception(failure);
  if (!std::isfinite(report.cost)) report.message = "the residuals cannot be computed at the start";
  report.converged = report.converged && !report.normal_matrix.empty();
  return report;
}

LeastSquaresReport describe_at(const LeastSquaresProblem& problem, std::vector<double> x,
                               const LeastSquaresOptions& options) {
  LeastSquaresReport report;
  report.x = std::move(x);
  for (std::size_t k = 0; k < report.x.size(); ++k)
    report.x[k] = std::clamp(report.x[k], problem.lower[k], problem.upper[k]);
  std::exception_ptr failure;
  const WholeProblem whole(problem, options, failure);
  describe_end(whole, problem, options.threads, report);
  if (failure) std::rethrow_exception(failure);
  return report;
}

}  // namespace dashpot
