#include <ceres/ceres.h>

#include "tanh_fit.h"

using namespace peer;

namespace {

const dashpot::TrainingSamples& samples() {
  static const dashpot::TrainingSamples made = fit_samples();
  return made;
}

class Fit final : public ceres::CostFunction {
 public:
  Fit() {
    set_num_residuals(static_cast<int>(samples().targets.size()));
    mutable_parameter_block_sizes()->push_back(41);
  }
  bool Evaluate(double const* const* w, double* r, double** jacobians) const override {
    residuals(w[0], samples(), r, jacobians ? jacobians[0] : nullptr, 41, 1);
    return true;
  }
};

class StopWhenGood final : public ceres::IterationCallback {
 public:
  bool reached = false;
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    reached = good_enough(2 * summary.cost, samples().targets.size());
    return reached ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }
};

double run(int round, int iterations, bool to_the_error) {
  samples();
  std::vector<double> w = network(kTanh, static_cast<std::uint64_t>(round)).parameters;
  StopWhenGood stop;
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = iterations;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 0;
  options.logging_type = ceres::SILENT;
  if (to_the_error) options.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  const double seconds = time_of(1, [&] {
    ceres::Problem problem;
    problem.AddResidualBlock(new Fit, nullptr, w.data());
    ceres::Solve(options, &problem, &summary);
  });
  if (to_the_error) return stop.reached ? seconds : HUGE_VAL;
  return seconds / static_cast<double>(summary.iterations.size() - 1);
}

}  // namespace

int main() {
  return serve({{"fit_iteration", [](int round) { return run(round, 20, false); }},
                {"fit", [](int round) { return run(round, 150, true); }}});
}
