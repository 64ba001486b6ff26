#include "dashpot/damper/nets/free_run_search.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "dashpot/damper/nets/gram_matrix.h"

namespace dashpot {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The problem linearised at one point: the Gram matrix of [J r], (n + 1) x (n + 1) and divided by
/// the number of samples, with the records' best offsets taken out of it, and these offsets; and
/// with the penalties.
struct System {
  MatrixXd gram;
  std::vector<double> offsets;
  double offset_penalty = 0;  ///< of the offsets, per sample; part of squares()
  double penalty = 0;         ///< part of squares(), too

  double squares() const { return gram(gram.rows() - 1, gram.cols() - 1); }
};

/// Adds up the Gram matrix; a record is a group.
class GramSink final : public RowSink {
 public:
  GramSink(Index columns, const FreeRunSearchOptions& options)
      : options_(options),
        gram_(static_cast<std::size_t>(columns)),
        prices_(MatrixXd::Zero(columns, columns)) {}

  double* row() override {
    ++n_;
    return gram_.row();
  }

  void end_record() override {
    // The best offset of n samples with the column sums s and the residual sum s_r is
    // -s_r / (n (1 + offset_decay)). Eliminating it takes s s' / (n (1 + offset_decay)) out of the
    // Gram matrix.
    const double centring = options_.offsets && n_ > 0 ? 1 / (n_ * (1 + options_.offset_decay)) : 0;
    const double offset = -centring * gram_.end_group(centring).back();
    system_.offsets.push_back(offset);
    system_.offset_penalty += options_.offset_decay * n_ * offset * offset;

    count_ += n_;
    n_ = 0;
  }

  void add_penalty(const std::vector<double>& row) override {
    prices_.selfadjointView<Eigen::Lower>().rankUpdate(VectorXd::Map(row.data(), prices_.rows()));
    is_priced_ = true;
    system_.penalty += row.back() * row.back();
  }

  System system() {
    const std::vector<double> gram = gram_.matrix();
    system_.gram = MatrixXd::Map(gram.data(), prices_.rows(), prices_.cols()) / count_;
    if (is_priced_) system_.gram += MatrixXd(prices_.selfadjointView<Eigen::Lower>());
    system_.offset_penalty /= count_;
    return std::move(system_);
  }

 private:
  const FreeRunSearchOptions& options_;
  GramMatrix gram_;
  MatrixXd prices_;
  bool is_priced_ = false;
  double n_ = 0, count_ = 0;  ///< samples of this record, of all before
  System system_;
};

/// Levenberg-Marquardt over systems of n equations. Invariant: at_ is the problem linearised at x_.
class Search {
 public:
  Search(const FreeRunProblem& problem, const FreeRunSearchOptions& options)
      : problem_(problem),
        options_(options),
        decay_(VectorXd::Map(problem.decay.data(), size())),
        anchors_(VectorXd::Map(problem.anchors.data(), size())),
        x_(VectorXd::Map(problem.start.data(), size())),
        at_(linearise(x_)) {}

  const VectorXd& unknowns() const { return x_; }
  const System& system() const { return at_; }
  double cost() const { return cost_of(at_, x_); }
  bool stuck() const { return damping_ > 1e9; }
  /// Half the gradient of the cost by the unknowns.
  VectorXd half_gradient() const {
    return at_.gram.topRightCorner(size(), 1) + (x_ - anchors_).cwiseProduct(decay_);
  }

  /// Tries one step; true when it lowers the cost and was taken.
  bool step() {
    // Gauss-Newton matrix and descent, with the penalty on the unknowns.
    MatrixXd matrix = at_.gram.topLeftCorner(size(), size());
    matrix.diagonal() += decay_;
    const VectorXd descent = -half_gradient();

    // Solve with the damped diagonal; `predicted` is by how much the linearised cost falls.
    MatrixXd damped = matrix;
    damped.diagonal() *= 1 + damping_;
    const VectorXd step = damped.llt().solve(descent), trial = x_ + step;
    const double predicted = 2 * step.dot(descent) - step.dot(matrix * step);

    // Compare with how far it really falls. Refused in a row, the damping grows faster each time.
    System system = linearise(trial);
    const double gain = (cost() - cost_of(system, trial)) / predicted;
    if (!(gain > 0)) {
      damping_ *= growth_;
      growth_ *= 2;
      return false;
    }

    damping_ *= gain > 0.75 ? 0.2 : gain > 0.25 ? 1 : 2;
    growth_ = 2;
    x_ = trial;
    at_ = std::move(system);
    return true;
  }

 private:
  Index size() const { return static_cast<Index>(problem_.start.size()); }

  System linearise(const VectorXd& x) const {
    GramSink sink(size() + 1, options_);
    problem_.linearise({x.begin(), x.end()}, sink);
    return sink.system();
  }

  double cost_of(const System& system, const VectorXd& x) const {
    return system.squares() + (x - anchors_).cwiseAbs2().dot(decay_);
  }

  const FreeRunProblem& problem_;
  const FreeRunSearchOptions& options_;
  VectorXd decay_, anchors_, x_;
  System at_;
  double damping_ = 0.01, growth_ = 2;
};

}  // namespace

FreeRunSearchResult search(const FreeRunProblem& problem, const FreeRunSearchOptions& options) {
  constexpr std::size_t kWindow = 3;  // steps over which the cost must still fall
  Search search(problem, options);
  FreeRunSearchResult result;

  // Until the cost stays level over so many taken steps, or no step is small enough to be taken.
  std::vector<double> costs{search.cost()};
  while (!result.converged && result.iterations < options.max_iterations) {
    if (options.on_iteration) options.on_iteration(search.cost());
    ++result.iterations;
    if (search.step()) costs.push_back(search.cost());
    const bool level = costs.size() > kWindow && costs[costs.size() - 1 - kWindow] - costs.back() <
                                                     options.tolerance * costs.back();
    result.converged = level || search.stuck();
  }

  const VectorXd gradient = search.half_gradient();
  result.unknowns.assign(search.unknowns().begin(), search.unknowns().end());
  result.half_gradient.assign(gradient.begin(), gradient.end());
  result.offsets = search.system().offsets;
  result.cost = search.cost();
  result.rms = std::sqrt(std::max(
      0.0, search.system().squares() - search.system().offset_penalty - search.system().penalty));
  return result;
}

}  // namespace dashpot
