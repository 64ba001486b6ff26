#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "dashpot/damper/nets/mlp.h"
#include "dashpot/damper/nets/normal_equations.h"
#include "dashpot/damper/nets/stopping.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

/// Levenberg-Marquardt on  |r|^2 / samples + weight_decay |w|^2.  Damping is scaled by the largest
/// diagonal seen (More, 1978) and follows the gain ratio (Marquardt, 1963; doubling growth after
/// refused steps: Nielsen, 1999).
class LevenbergMarquardt {
 public:
  LevenbergMarquardt(Mlp& mlp, const SampleBlocks& blocks, const TrainOptions& options)
      : mlp_(mlp),
        blocks_(blocks),
        errors_(mlp, blocks, options.threads),
        weight_decay_(options.weight_decay),
        bayesian_(options.bayesian),
        scale_(mlp.parameters.size(), 0.0) {
    linearise();
  }

  double cost() const { return cost_; }
  const NormalEquations& equations() const { return equations_; }
  bool stuck() const { return damping_ > 1e12; }
  double weight_decay() const { return weight_decay_; }
  double effective_parameters() const { return effective_parameters_; }

  /// At the network's present parameters; `activations`: of the step that led there.
  void linearise(AlignedVector<double>* activations = nullptr) {
    const std::vector<double>& w = mlp_.parameters;
    equations_ = errors_.normal_equations(w, activations);
    assemble();
    if (bayesian_ && weigh_evidence()) assemble();
    for (std::size_t k = 0; k < w.size(); ++k)
      scale_[k] = std::max(scale_[k], matrix_[k * w.size() + k]);
  }

  /// Tries one step; true when it lowers the cost and was taken.
  bool step() {
    const std::size_t n = scale_.size();
    std::vector<double> damped = matrix_, step(n), trial(n);
    for (std::size_t k = 0; k < n; ++k) damped[k * n + k] += damping_ * scale_[k];
    if (!solve_positive_definite(damped, descent_, step)) return reject();

    // The fall of cost that the linearised problem promises.
    double predicted = 0;
    for (std::size_t k = 0; k < n; ++k) {
      predicted += step[k] * (damping_ * scale_[k] * step[k] + descent_[k]);
      trial[k] = mlp_.parameters[k] + step[k];
    }

    // Take the step if the cost falls at all, and damp by how well the promise was kept.
    const double gain =
        (cost_ - cost_at(errors_.squared_error(trial, &activations_), trial)) / predicted;
    if (!(gain > 0)) return reject();

    damping_ *= gain > 0.75 ? 0.1 : gain > 0.25 ? 1 : 2;
    growth_ = 2;
    mlp_.parameters = std::move(trial);
    linearise(&activations_);
    return true;
  }

 private:
  bool reject() {
    damping_ *= growth_;
    growth_ *= 2;
    return false;
  }

  double cost_at(double error, const std::vector<double>& w) const {
    return error / static_cast<double>(blocks_.samples) +
           weight_decay_ * std::inner_product(w.begin(), w.end(), w.begin(), 0.0);
  }

  /// Cost, its matrix and its descent for the present weight decay.
  void assemble() {
    const std::vector<double>& w = mlp_.parameters;
    cost_ = cost_at(equations_.squared_error, w);
    const double share = 1 / static_cast<double>(blocks_.samples);
    matrix_ = equations_.matrix;
    descent_ = equations_.gradient;
    for (double& entry : matrix_) entry *= share;
    for (std::size_t k = 0; k < w.size(); ++k) {
      matrix_[k * w.size() + k] += weight_decay_;
      descent_[k] = -(descent_[k] * share + weight_decay_ * w[k]);
    }
  }

  /// The weight decay under which the data are likeliest: each determined parameter takes its share
  /// of the squared error, each undetermined one its share of |w|^2.
  bool weigh_evidence() {
    const std::vector<double>& w = mlp_.parameters;
    const std::optional<double> trace = trace_of_inverse(matrix_, w.size());
    const double squares = std::inner_product(w.begin(), w.end(), w.begin(), 0.0);
    const auto n = static_cast<double>(blocks_.samples);
    if (!trace || squares == 0) return false;
    effective_parameters_ =
        std::clamp(static_cast<double>(w.size()) - weight_decay_ * *trace, 0.0, 0.9 * n);
    weight_decay_ = effective_parameters_ * equations_.squared_error /
                    ((n - effective_parameters_) * squares * n);
    return true;
  }

  Mlp& mlp_;
  const SampleBlocks& blocks_;
  BlockErrors errors_;
  double weight_decay_;
  bool bayesian_;
  double effective_parameters_ = 0;
  AlignedVector<double> activations_;  ///< of the last step tried
  std::vector<double> scale_;
  double damping_ = 1, growth_ = 2;
  NormalEquations equations_;
  double cost_ = 0;
  std::vector<double> matrix_, descent_;
};

}  // namespace

TrainReport train(Mlp& mlp, const TrainingSamples& samples, const TrainOptions& options) {
  assert(!samples.targets.empty() &&
         samples.inputs.size() == samples.targets.size() * mlp.layers.front());
  constexpr std::size_t kWindow = 5;  // steps over which the cost must still fall
  if (mlp.parameters.empty()) initialise(mlp, options.seed);
  const SampleBlocks blocks = make_blocks(mlp, samples, options.offset_decay);
  LevenbergMarquardt search(mlp, blocks, options);
  EarlyStopping stopping(mlp, options.stopping, options.offset_decay);
  const auto rmse = [&] {
    const NormalEquations& now = search.equations();
    return mlp.output_scale * std::sqrt(mean_square(now.squared_error, now.offsets, blocks));
  };

  TrainReport report;
  std::vector<double> costs{search.cost()};
  while (!report.converged && !report.stopped_early && report.iterations < options.max_iterations) {
    ++report.iterations;
    if (search.step()) {
      costs.push_back(search.cost());
      report.stopped_early = stopping.judge(mlp.parameters);
    }
    const bool level =
        costs.size() > kWindow && std::abs(costs[costs.size() - 1 - kWindow] - costs.back()) <
                                      options.tolerance * costs.back();
    report.converged = level || search.stuck();
    if (options.on_iteration) options.on_iteration(report.iterations, rmse());
  }
  if (stopping.finish(mlp, report)) search.linearise();
  report.rmse = rmse();
  report.weight_decay = search.weight_decay();
  report.effective_parameters = search.effective_parameters();
  if (!samples.group.empty()) report.offsets = take_mean_offset(mlp, search.equations().offsets);
  return report;
}

}  // namespace dashpot
