#include "dashpot/damper/kinds/narx/train_narx.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "dashpot/damper/kinds/narx/narx_model.h"
#include "dashpot/damper/nets/padded_network.h"
#include "dashpot/numerics/least_squares.h"
#include "dashpot/numerics/minimise.h"

namespace dashpot {
namespace {

/// The network on its own forces, window by window, standardised.
class NarxFreeRunCost {
 public:
  NarxFreeRunCost(const Mlp& mlp, const NarxSamples& samples, const NarxTrainOptions& options)
      : samples_(samples),
        options_(options),
        network_(mlp, 1, simd_levels().back()),
        width_(mlp.layers.front()),
        fed_back_(width_ - samples.feedback.size()),
        rows_(samples.rows.inputs),
        targets_(samples.rows.targets),
        by_inputs_(padded<double>(width_)) {
    for (std::size_t k = 0; k < rows_.size(); ++k)
      rows_[k] = (rows_[k] - mlp.input_mean[k % width_]) / mlp.input_scale[k % width_];
    for (double& target : targets_) target = (target - mlp.output_mean) / mlp.output_scale;
    const std::size_t most = std::max<std::size_t>(1, options.most_residuals);
    stride_ = (targets_.size() + most - 1) / most;
    cut_windows();
    const std::size_t groups = samples.rows.group.empty() ? 0 : samples.rows.groups;
    group_sizes_.assign(groups, 0);
    scored_.assign(residuals(), false);
    for (const Window& window : windows_) {
      // Short stretches keep half their rows.
      const std::size_t unscored = std::min(options.washout, (window.last - window.first) / 2);
      for (std::size_t row = window.first + unscored; row < window.last; ++row) {
        if (row % stride_ != 0) continue;
        scored_[row / stride_] = true;
        if (groups > 0) ++group_sizes_[samples.rows.group[row]];
      }
    }
  }

  /// Rows at which there is a residual, 0 where it is not scored.
  std::size_t residuals() const { return (targets_.size() + stride_ - 1) / stride_; }
  std::size_t scored() const {
    return static_cast<std::size_t>(std::count(scored_.begin(), scored_.end(), true));
  }

  /// Residuals, and when `columns` is given their derivatives, one column per weight. False where
  /// they are no numbers.
  bool linearise(std::span<const double> w, double* residuals, double* const* columns) {
    const std::size_t count = w.size();
    const std::size_t depth = depth_of_feedback() + 1;
    std::vector<double> slopes(columns ? depth * count : 0), own(targets_.size());
    network_.set_parameters(w);
    for (const Window& window : windows_)
      for (std::size_t row = window.first; row < window.last; ++row) {
        own[row] = run(row, window.first, own);
        if (columns) carry(row, window.first, own[row], count, slopes);

        // Score every stride-th row.
        if (row % stride_ != 0) continue;
        const std::size_t at = row / stride_;
        residuals[at] = scored_[at] ? own[row] - targets_[row] : 0;
        if (!columns) continue;
        const double* slope = &slopes[row % depth * count];
        for (std::size_t k = 0; k < count; ++k)
          if (columns[k]) columns[k][at] = scored_[at] ? slope[k] : 0;
      }
    return true;
  }

  /// Gradient of half the sum of squares whose residuals are given, back through the time of each
  /// window. linearise() must have been called at the same weights.
  std::vector<double> back_propagate(std::span<const double> w,
                                     const std::vector<double>& residuals) {
    std::vector<double> gradient(w.size()), own(targets_.size()), pull(targets_.size()),
        one(w.size());
    network_.set_parameters(w);
    for (const Window& window : windows_) {
      for (std::size_t row = window.first; row < window.last; ++row)
        own[row] = run(row, window.first, own);

      // Back through time: a force pulls on those that it was made from.
      for (std::size_t row = window.last; row-- > window.first;) {
        if (row % stride_ == 0) pull[row] += residuals[row / stride_];
        if (pull[row] == 0 || std::abs(own[row]) >= NarxModel::kRange) continue;
        run(row, window.first, own);
        *network_.output_slope(0) = pull[row];
        network_.backward(1, by_inputs_.data());
        network_.get_gradient(one);
        for (std::size_t k = 0; k < w.size(); ++k) gradient[k] += one[k];
        for_each_own(row, window.first, [&](std::size_t k, std::size_t past) {
          pull[past] += by_inputs_[fed_back_ + k];
        });
      }
    }
    return gradient;
  }

  /// Takes each group's mean out, all but wholly, as offset_decay says.
  void centre(double* residuals) const {
    if (group_sizes_.empty()) return;
    std::vector<double> sums(group_sizes_.size());
    const auto group = [&](std::size_t at) { return samples_.rows.group[at * stride_]; };
    const std::size_t count = this->residuals();
    for (std::size_t at = 0; at < count; ++at) sums[group(at)] += residuals[at];
    const double share = 1 - std::sqrt(options_.offset_decay / (1 + options_.offset_decay));
    for (std::size_t at = 0; at < count; ++at)
      if (scored_[at])
        residuals[at] -= share * sums[group(at)] / static_cast<double>(group_sizes_[group(at)]);
  }

 private:
  struct Window {
    std::size_t first, last;
  };

  void cut_windows() {
    for (std::size_t k = 0; k < samples_.stretches.size(); ++k) {
      const std::size_t end =
          k + 1 < samples_.stretches.size() ? samples_.stretches[k + 1] : targets_.size();
      const std::size_t length = options_.window > 0 ? options_.window : targets_.size();
      for (std::size_t first = samples_.stretches[k]; first < end; first += length)
        windows_.push_back({first, std::min(first + length, end)});
    }
  }

  std::size_t depth_of_feedback() const {
    return samples_.feedback.empty()
               ? 0
               : *std::max_element(samples_.feedback.begin(), samples_.feedback.end());
  }

  /// Calls use(k, row of the force) for the k-th fed-back force where that is the network's own.
  template <class Use>
  void for_each_own(std::size_t row, std::size_t first, Use use) const {
    for (std::size_t k = 0; k < samples_.feedback.size(); ++k)
      if (row - first >= samples_.feedback[k]) use(k, row - samples_.feedback[k]);
  }

  double run(std::size_t row, std::size_t first, const std::vector<double>& own) {
    double* input = network_.input(0);
    std::copy_n(&rows_[row * width_], width_, input);
    if (options_.washout > 0) std::fill_n(input + fed_back_, samples_.feedback.size(), 0.0);
    for_each_own(row, first,
                 [&](std::size_t k, std::size_t past) { input[fed_back_ + k] = own[past]; });
    network_.forward(1);
    const double force = *network_.output(0);
    return force == force ? std::clamp(force, -NarxModel::kRange, NarxModel::kRange) : 0;
  }

  /// Derivatives of a row's force by the weights, from those of the forces fed back to it.
  void carry(std::size_t row, std::size_t first, double force, std::size_t count,
             std::vector<double>& slopes) {
    const std::size_t depth = slopes.size() / count;
    double* slope = &slopes[row % depth * count];
    if (std::abs(force) >= NarxModel::kRange) return void(std::fill_n(slope, count, 0.0));
    *network_.output_slope(0) = 1;
    network_.backward(1, by_inputs_.data());
    network_.get_gradient({slope, count});
    for_each_own(row, first, [&](std::size_t k, std::size_t past) {
      const double gain = by_inputs_[fed_back_ + k];
      const double* from = &slopes[past % depth * count];
      for (std::size_t p = 0; p < count; ++p) slope[p] += gain * from[p];
    });
  }

  const NarxSamples& samples_;
  const NarxTrainOptions& options_;
  PaddedNetwork<double> network_;
  std::size_t width_, fed_back_, stride_ = 1;
  std::vector<double> rows_, targets_;
  AlignedVector<double> by_inputs_;
  std::vector<Window> windows_;
  std::vector<std::size_t> group_sizes_;  // scored residuals
  std::vector<bool> scored_;
};

/// The residuals of the whole cost: centred ones, then the weights times their decay; their
/// squares' sum is it.
class Problem {
 public:
  Problem(const Mlp& mlp, const NarxSamples& samples, const NarxTrainOptions& options)
      : cost_(mlp, samples, options),
        share_(1 / std::sqrt(static_cast<double>(std::max<std::size_t>(1, cost_.scored())))),
        price_(std::sqrt(options.weight_decay)) {}

  std::size_t residuals(std::size_t weights) const { return cost_.residuals() + weights; }

  bool evaluate(std::span<const double> w, std::span<double> r, std::span<double* const> columns) {
    const std::size_t count = cost_.residuals();
    cost_.linearise(w, r.data(), columns.empty() ? nullptr : columns.data());
    scale(r.data());
    for (std::size_t k = 0; k < w.size(); ++k) r[count + k] = price_ * w[k];
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (!columns[k]) continue;
      scale(columns[k]);
      std::fill_n(columns[k] + count, w.size(), 0.0);
      columns[k][count + k] = price_;
    }
    return true;
  }

  bool gradient(std::span<const double> w, double& value, std::span<double> gradient) {
    const std::size_t count = cost_.residuals();
    std::vector<double> r(residuals(w.size()));
    evaluate(w, r, {});
    value = std::inner_product(r.begin(), r.end(), r.begin(), 0.0);
    cost_.centre(r.data());  // centring is its own transpose
    r.resize(count);
    const std::vector<double> by_weights = cost_.back_propagate(w, r);
    for (std::size_t k = 0; k < w.size(); ++k)
      gradient[k] = 2 * (share_ * by_weights[k] + price_ * price_ * w[k]);
    return std::isfinite(value);
  }

 private:
  void scale(double* values) const {
    cost_.centre(values);
    for (std::size_t k = 0; k < cost_.residuals(); ++k) values[k] *= share_;
  }

  NarxFreeRunCost cost_;
  double share_, price_;
};

/// Root mean square of the residuals alone, N.
double rmse_of(Problem& problem, const Mlp& mlp) {
  std::vector<double> r(problem.residuals(mlp.parameters.size()));
  problem.evaluate(mlp.parameters, r, {});
  r.resize(r.size() - mlp.parameters.size());
  return mlp.output_scale * std::sqrt(std::inner_product(r.begin(), r.end(), r.begin(), 0.0));
}

}  // namespace

TrainReport train_free_run(Mlp& mlp, const NarxSamples& samples, const NarxTrainOptions& options) {
  Problem problem(mlp, samples, options);
  const std::size_t count = mlp.parameters.size();
  LeastSquaresProblem squares{
      .residuals = problem.residuals(count),
      .lower = std::vector<double>(count, -std::numeric_limits<double>::infinity()),
      .upper = std::vector<double>(count, std::numeric_limits<double>::infinity()),
      .residual = [&](std::span<const double> w,
                      std::span<double> r) { return problem.evaluate(w, r, {}); },
      .jacobian =
          [&](std::span<const double> w, std::span<double> r, std::span<double* const> columns) {
            return problem.evaluate(w, r, columns);
          }};

  // Weights have no bounds; the search stops when the cost hardly falls.
  LeastSquaresOptions how{.max_iterations = options.max_iterations,
                          .function_tolerance = options.tolerance,
                          .threads = 1};
  if (options.on_iteration)
    how.on_iteration = [&](int, double, std::span<const double>) { options.on_iteration(); };

  // Keep what was found, unless it is no number.
  const LeastSquaresReport found = solve(squares, mlp.parameters, how);
  if (std::isfinite(found.cost)) mlp.parameters = found.x;
  return {
      .converged = found.converged, .iterations = found.iterations, .rmse = rmse_of(problem, mlp)};
}

TrainReport train_through_time(Mlp& mlp, const NarxSamples& samples,
                               const NarxTrainOptions& options) {
  Problem problem(mlp, samples, options);
  MinimiseOptions how{.max_iterations = options.max_iterations,
                      .function_tolerance = options.tolerance};
  if (options.on_iteration)
    how.on_iteration = [&](int, double, std::span<const double>) {
      return options.on_iteration(), true;
    };

  // The gradient comes back through time, once per evaluation.
  const MinimiseReport found =
      minimise([&](std::span<const double> w, double& value,
                   std::span<double> gradient) { return problem.gradient(w, value, gradient); },
               mlp.parameters, how);
  mlp.parameters = found.x;
  return {
      .converged = found.converged, .iterations = found.iterations, .rmse = rmse_of(problem, mlp)};
}

double free_run_rmse(const Mlp& mlp, const NarxSamples& samples, const NarxTrainOptions& options) {
  Problem problem(mlp, samples, options);
  return rmse_of(problem, mlp);
}

NarxCost narx_cost_forward(const Mlp& mlp, const NarxSamples& samples,
                           const NarxTrainOptions& options) {
  Problem problem(mlp, samples, options);
  const std::size_t count = mlp.parameters.size(), rows = problem.residuals(count);
  std::vector<double> r(rows), jacobian(rows * count);
  std::vector<double*> columns(count);
  for (std::size_t k = 0; k < count; ++k) columns[k] = &jacobian[k * rows];
  problem.evaluate(mlp.parameters, r, columns);
  NarxCost at{std::inner_product(r.begin(), r.end(), r.begin(), 0.0), {}};
  for (const double* column : columns)
    at.gradient.push_back(2 * std::inner_product(r.begin(), r.end(), column, 0.0));
  return at;
}

NarxCost narx_cost_backward(const Mlp& mlp, const NarxSamples& samples,
                            const NarxTrainOptions& options) {
  Problem problem(mlp, samples, options);
  NarxCost at;
  at.gradient.resize(mlp.parameters.size());
  problem.gradient(mlp.parameters, at.cost, at.gradient);
  return at;
}

}  // namespace dashpot
