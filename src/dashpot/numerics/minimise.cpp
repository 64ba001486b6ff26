#include "dashpot/numerics/minimise.h"

#include <cmath>
#include <exception>

#include <ceres/ceres.h>

#include "dashpot/numerics/quiet_ceres.h"
#include "dashpot/numerics/search_ending.h"

namespace dashpot {
namespace {

/// Exceptions must not travel through Ceres: the first one is kept in `failure`.
class Wrapped final : public ceres::FirstOrderFunction {
 public:
  Wrapped(const SmoothFunction& function, std::size_t size, std::exception_ptr& failure)
      : function_(function), size_(size), failure_(failure) {}

  int NumParameters() const override { return static_cast<int>(size_); }
  bool Evaluate(const double* x, double* value, double* gradient) const override {
    if (failure_) return false;
    std::vector<double> unwanted(gradient ? 0 : size_);
    try {
      return function_({x, size_}, *value, {gradient ? gradient : unwanted.data(), size_}) &&
             std::isfinite(*value);
    } catch (...) {
      failure_ = std::current_exception();
      return false;
    }
  }

 private:
  const SmoothFunction& function_;
  std::size_t size_;
  std::exception_ptr& failure_;
};

class MinimiseListener final : public ceres::IterationCallback {
 public:
  MinimiseListener(const MinimiseOptions& options, const std::vector<double>& x,
                   std::exception_ptr& failure)
      : options_(options), x_(x), failure_(failure) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    bool go_on = true;
    try {
      if (!failure_ && options_.on_iteration)
        go_on = options_.on_iteration(summary.iteration, summary.cost, x_);
    } catch (...) {
      failure_ = std::current_exception();
    }
    if (failure_) return ceres::SOLVER_ABORT;
    return go_on ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

 private:
  const MinimiseOptions& options_;
  const std::vector<double>& x_;
  std::exception_ptr& failure_;
};

}  // namespace

MinimiseReport minimise(const SmoothFunction& function, std::vector<double> start,
                        const MinimiseOptions& options) {
  quiet_ceres();
  MinimiseReport report;
  report.x = std::move(start);
  std::exception_ptr failure;
  MinimiseListener listener(options, report.x, failure);

  // L-BFGS is Ceres' default direction; the line search keeps Wolfe's conditions.
  ceres::GradientProblemSolver::Options how;
  how.max_num_iterations = options.max_iterations;
  how.function_tolerance = options.function_tolerance;
  how.max_lbfgs_rank = options.memory;
  how.logging_type = ceres::SILENT;
  how.update_state_every_iteration = true;
  how.callbacks.push_back(&listener);

  const ceres::GradientProblem problem(
      new Wrapped(function, report.x.size(), failure));  // which owns it
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(how, problem, report.x.data(), &summary);
  if (failure) std::rethrow_exception(failure);

  // Its list of iterations holds the evaluation at the start too, which is none.
  report.converged = summary.termination_type == ceres::CONVERGENCE;
  report.message = search_ending(
      report.converged, summary.termination_type == ceres::NO_CONVERGENCE, summary.message);
  report.iterations = static_cast<int>(summary.iterations.size()) - 1;
  report.value = summary.final_cost;
  return report;
}

}  // namespace dashpot
