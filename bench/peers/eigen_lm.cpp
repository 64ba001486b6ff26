#include <unsupported/Eigen/NonLinearOptimization>

#include "tanh_fit.h"

using namespace peer;

namespace {

const dashpot::TrainingSamples& samples() {
  static const dashpot::TrainingSamples made = fit_samples();
  return made;
}

struct Fit {
  using Scalar = double;
  int inputs() const { return 41; }
  int values() const { return static_cast<int>(samples().targets.size()); }
  int operator()(const Eigen::VectorXd& w, Eigen::VectorXd& r) const {
    residuals(w.data(), samples(), r.data(), nullptr, 0, 0);
    return 0;
  }
  int df(const Eigen::VectorXd& w, Eigen::MatrixXd& jacobian) const {
    Eigen::VectorXd r(values());
    residuals(w.data(), samples(), r.data(), jacobian.data(), 1, static_cast<std::size_t>(values()));
    return 0;
  }
};

double run(int round, int iterations, bool to_the_error) {
  samples();
  const dashpot::Mlp start = network(kTanh, static_cast<std::uint64_t>(round));
  Eigen::VectorXd w = Eigen::Map<const Eigen::VectorXd>(start.parameters.data(), 41);
  Fit fit;
  Eigen::LevenbergMarquardt<Fit> search(fit);
  search.parameters.ftol = search.parameters.xtol = search.parameters.gtol = 0;
  search.parameters.maxfev = 1 << 30;
  int done = 0;
  bool reached = false;
  const double seconds = time_of(1, [&] {
    auto status = search.minimizeInit(w);
    while (status == Eigen::LevenbergMarquardtSpace::NotStarted ||
           status == Eigen::LevenbergMarquardtSpace::Running) {
      status = search.minimizeOneStep(w);
      reached = to_the_error && good_enough(search.fnorm * search.fnorm, samples().targets.size());
      if (reached || ++done == iterations) break;
    }
  });
  if (to_the_error) return reached ? seconds : HUGE_VAL;
  return seconds / done;
}

}  // namespace

int main() {
  return serve({{"fit_iteration", [](int round) { return run(round, 10, false); }},
                {"fit", [](int round) { return run(round, 150, true); }}});
}
