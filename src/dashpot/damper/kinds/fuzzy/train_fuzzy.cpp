#include "dashpot/damper/kinds/fuzzy/train_fuzzy.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "dashpot/damper/nets/gram_matrix.h"

namespace dashpot {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kPerMembership = 3;  // centre, ln width, ln |slope|

VectorXd unknowns_of(const Sugeno& model) {
  VectorXd x(static_cast<Index>(kPerMembership * model.memberships.size()));
  Index k = 0;
  for (const Membership& m : model.memberships) {
    x[k++] = m.centre;
    x[k++] = std::log(m.width);
    x[k++] = std::log(std::abs(m.slope));
  }
  return x;
}

void set_unknowns(Sugeno& model, const VectorXd& x) {
  Index k = 0;
  for (Membership& m : model.memberships) {
    m.centre = x[k++];
    m.width = std::exp(x[k++]);
    m.slope = std::copysign(std::exp(x[k++]), m.slope);
  }
}

/// The consequents that are best for the model's memberships, and what they cost.
struct Projection {
  double cost = 0;
  VectorXd consequents;
  double mean_square = 0;       ///< of the residuals alone
  std::vector<double> offsets;  ///< per group, standardised
};

/// The cost as a function of the memberships alone.
class ReducedProblem {
 public:
  ReducedProblem(const Sugeno& model, const TrainingSamples& samples,
                 const FuzzyTrainOptions& options)
      : options_(options),
        model_(model),
        start_(unknowns_of(model)),
        count_(samples.targets.size()) {
    const bool grouped = !samples.group.empty();
    std::vector<std::vector<std::size_t>> members(grouped ? samples.groups : 1);
    for (std::size_t i = 0; i < count_; ++i) members[grouped ? samples.group[i] : 0].push_back(i);

    // Lay the samples out group by group, standardised.
    const std::size_t inputs = model.inputs.size();
    for (const std::vector<std::size_t>& group : members) {
      const double size = static_cast<double>(group.size());
      groups_.push_back(
          {group.size(), grouped && size > 0 ? 1 / (size * (1 + options.offset_decay)) : 0});
      for (const std::size_t i : group) {
        linear_.resize(linear_.size() + inputs);
        held_.resize(linear_.size());
        model.standardise(&samples.inputs[i * inputs], &linear_[linear_.size() - inputs],
                          &held_[linear_.size() - inputs]);
        targets_.push_back((samples.targets[i] - model.output_mean) / model.output_scale);
      }
    }
  }

  const VectorXd& start() const { return start_; }

  Projection project(const VectorXd& unknowns) {
    set_unknowns(model_, unknowns);
    const auto n = static_cast<Index>(model_.consequent_count());
    const Sums sums = sum_up(n + 1, [&](std::size_t sample, auto row) {
      fill_regressors(sample, row);
      row[n] = targets_[sample];
    });

    // Solve the regularised normal equations for the consequents.
    const MatrixXd& matrix = sums.products;
    const MatrixXd normal =
        matrix.topLeftCorner(n, n) * weight() + options_.ridge * MatrixXd::Identity(n, n);
    const VectorXd right = matrix.topRightCorner(n, 1) * weight();
    Projection result;
    result.consequents = normal.ldlt().solve(right);
    const VectorXd& q = result.consequents;

    // The cost that is left, and the mean square of the residuals alone.
    const double squares = matrix(n, n) * weight() - 2 * q.dot(right) + q.dot(normal * q);
    result.cost = squares + options_.premise_decay * (unknowns - start_).squaredNorm();
    result.mean_square = squares - options_.ridge * q.squaredNorm();

    // Each group's offset follows from what its residuals have in common.
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const double offset =
          groups_[g].centring * (sums.by_group[g][n] - q.dot(sums.by_group[g].head(n)));
      result.offsets.push_back(offset);
      result.mean_square -=
          options_.offset_decay * static_cast<double>(groups_[g].size) * weight() * offset * offset;
    }
    return result;
  }

  /// Gauss-Newton matrix and half the gradient of the cost at the unknowns, whose projection is
  /// given.
  void linearise(const VectorXd& unknowns, const Projection& at, MatrixXd& matrix,
                 VectorXd& gradient) {
    set_unknowns(model_, unknowns);
    const Index n = at.consequents.size(), m = unknowns.size();
    const Sums sums = sum_up(n + m + 1, [&](std::size_t sample, auto row) {
      fill_regressors(sample, row);
      const double output = row.head(n).dot(at.consequents);
      fill_derivatives(sample, at.consequents, output, row.segment(n, m));
      row[n + m] = output - targets_[sample];
    });

    // Eliminate the consequents, which follow the premises.
    const MatrixXd all = sums.products * weight();
    const MatrixXd normal = all.topLeftCorner(n, n) + options_.ridge * MatrixXd::Identity(n, n);
    const MatrixXd mixed = all.block(0, n, n, m);
    matrix = all.block(n, n, m, m) - mixed.transpose() * normal.ldlt().solve(mixed);
    matrix.diagonal().array() += options_.premise_decay;
    gradient = all.block(n, n + m, m, 1) + options_.premise_decay * (unknowns - start_);
  }

 private:
  struct Group {
    std::size_t size;
    double centring;
  };
  /// Of products of columns over all samples, and of the columns over each group.
  struct Sums {
    MatrixXd products;
    std::vector<VectorXd> by_group;
  };

  double weight() const { return 1 / static_cast<double>(count_); }

  template <class FillRow>
  Sums sum_up(Index columns, FillRow fill) {
    GramMatrix gram(static_cast<std::size_t>(columns));
    Sums sums;
    std::size_t sample = 0;
    for (const Group& group : groups_) {
      for (std::size_t k = 0; k < group.size; ++k)
        fill(sample++, VectorXd::Map(gram.row(), columns));
      const std::vector<double> by_column = gram.end_group(group.centring);
      sums.by_group.emplace_back(VectorXd::Map(by_column.data(), columns));
    }
    const std::vector<double> products = gram.matrix();
    sums.products = MatrixXd::Map(products.data(), columns, columns);
    return sums;
  }

  /// Fills in the factors of the consequents; leaves values_ and shares_ of the sample.
  template <class Row>
  void fill_regressors(std::size_t sample, Row&& row) {
    const std::size_t inputs = model_.inputs.size();
    model_.share(&held_[sample * inputs], values_.data(), shares_.data());
    Index k = 0;
    for (std::size_t r = 0; r < model_.rules.size(); ++r) {
      for (std::size_t i = 0; i < inputs; ++i) row[k++] = shares_[r] * linear_[sample * inputs + i];
      row[k++] = shares_[r];
    }
  }

  /// d output / d unknowns. A membership draws the output towards the rules that it is part of.
  template <class Row>
  void fill_derivatives(std::size_t sample, const VectorXd& consequents, double output, Row&& row) {
    const std::size_t inputs = model_.inputs.size();
    const double *linear = &linear_[sample * inputs], *q = consequents.data();
    std::array<double, Sugeno::kMaxMemberships> pull{};
    for (std::size_t r = 0; r < model_.rules.size(); ++r, q += inputs + 1) {
      const double rule = std::inner_product(linear, linear + inputs, q, q[inputs]);
      for (const std::size_t m : model_.rules[r]) pull[m] += shares_[r] * (rule - output);
    }

    // Spread each membership's pull over its parameters.
    Index k = 0;
    for (std::size_t m = 0; m < model_.memberships.size(); ++m) {
      const Membership& membership = model_.memberships[m];
      for (const double d :
           membership.log_gradient(held_[sample * inputs + membership.input], values_[m]))
        row[k++] = pull[m] * d;
    }
  }

  const FuzzyTrainOptions& options_;
  Sugeno model_;
  VectorXd start_;
  std::size_t count_;
  std::vector<Group> groups_;
  std::vector<double> linear_, held_, targets_;  // standardised, ordered by group
  std::array<double, Sugeno::kMaxMemberships> values_{};
  std::array<double, Sugeno::kMaxRules> shares_{};
};

/// Levenberg-Marquardt over the memberships. Damping as Nielsen (1999) has it.
class Search {
 public:
  explicit Search(ReducedProblem& problem)
      : problem_(problem), x_(problem.start()), at_(problem.project(x_)) {}

  const VectorXd& unknowns() const { return x_; }
  const Projection& projection() const { return at_; }
  bool stuck() const { return damping_ > 1e9; }

  void step() {
    if (gradient_.size() == 0) problem_.linearise(x_, at_, matrix_, gradient_);
    MatrixXd damped = matrix_;
    damped.diagonal() *= 1 + damping_;
    const VectorXd step = -damped.ldlt().solve(gradient_), trial = x_ + step;
    const double predicted = -2 * step.dot(gradient_) - step.dot(matrix_ * step);

    // Compare the gain with the one that the linear model promises.
    Projection projection = problem_.project(trial);
    const double gain = (at_.cost - projection.cost) / predicted;
    if (!(gain > 0)) {
      damping_ *= growth_;
      growth_ *= 2;
      return;
    }

    // Accept the step, and trust the model more or less from here on.
    damping_ *= gain > 0.75 ? 0.2 : gain > 0.25 ? 1 : 2;
    growth_ = 2;
    x_ = trial;
    at_ = std::move(projection);
    gradient_.resize(0);
  }

 private:
  ReducedProblem& problem_;
  VectorXd x_;
  Projection at_;
  MatrixXd matrix_;
  VectorXd gradient_;  // empty: not known at x_
  double damping_ = 0.1, growth_ = 2;
};

/// The mean offset belongs to the model: moves it into the constants of the rules.
std::vector<double> raw_offsets(Sugeno& model, std::vector<double> offsets) {
  const double mean =
      std::accumulate(offsets.begin(), offsets.end(), 0.0) / static_cast<double>(offsets.size());
  const std::size_t stride = model.inputs.size() + 1;
  for (std::size_t k = stride - 1; k < model.consequents.size(); k += stride)
    model.consequents[k] += mean;
  for (double& offset : offsets) offset = model.output_scale * (offset - mean);
  return offsets;
}

}  // namespace

TrainReport train(Sugeno& model, const TrainingSamples& samples, const FuzzyTrainOptions& options) {
  assert(!samples.targets.empty() &&
         samples.inputs.size() == samples.targets.size() * model.inputs.size());
  constexpr std::size_t kWindow = 5;  // steps over which the cost must still fall
  ReducedProblem problem(model, samples, options);
  Search search(problem);
  TrainReport report;
  report.converged = options.max_iterations == 0;

  // Step until the cost hardly falls any more, or nothing lowers it.
  std::vector<double> costs{search.projection().cost};
  while (!report.converged && report.iterations < options.max_iterations) {
    if (options.on_iteration) options.on_iteration(report.iterations);
    ++report.iterations;
    search.step();
    costs.push_back(search.projection().cost);
    const bool slow = costs.size() > kWindow && costs[costs.size() - 1 - kWindow] - costs.back() <
                                                    options.tolerance * costs.back();
    report.converged = slow || search.stuck();
  }

  // Take over what was found, in the units of the data.
  const Projection& found = search.projection();
  set_unknowns(model, search.unknowns());
  model.consequents.assign(found.consequents.begin(), found.consequents.end());
  report.rmse = model.output_scale * std::sqrt(std::max(0.0, found.mean_square));
  if (!samples.group.empty()) report.offsets = raw_offsets(model, found.offsets);
  return report;
}

ReducedCost reduced_cost(Sugeno model, const TrainingSamples& samples,
                         const FuzzyTrainOptions& options) {
  ReducedProblem problem(model, samples, options);
  const Projection at = problem.project(problem.start());
  MatrixXd matrix;
  VectorXd gradient;
  problem.linearise(problem.start(), at, matrix, gradient);
  return {at.cost, {gradient.begin(), gradient.end()}};
}

}  // namespace dashpot
