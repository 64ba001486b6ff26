#include "dashpot/damper/neural/train_bank.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace dashpot {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kBlock = 256;  // samples of which a Gram matrix is made at a time

/// Runs the bank over a record and calls use(sample, signals, slopes) at each scored sample. `slopes`: the
/// signals' derivatives by the logarithm of the one rate that each has; none for the velocity.
template <class Use>
void run_bank(const HysteresisBank& bank, const BankRecord& record, std::size_t stride, bool with_slopes,
              Use use) {
  std::vector<double> state(bank.size()), slopes(with_slopes ? bank.size() : 0);
  std::vector<double> signals(bank.signal_count());
  bank.rest(record.inputs.front(), state);
  for (std::size_t k = 0; k < record.inputs.size(); ++k) {
    if (k > 0)
      bank.advance(record.inputs[k - 1], record.inputs[k], record.time[k] - record.time[k - 1], state,
                   slopes);
    if (k < record.first || (k - record.first) % stride != 0) continue;
    bank.read(record.inputs[k], state, signals.data());
    use(k, signals, slopes);
  }
}

/// Unknowns: ln rates, neurons, gates.
VectorXd unknowns_of(const BankNetwork& model) {
  VectorXd x(
      static_cast<Index>(model.bank.size() + model.network.neurons.size() + model.network.gates.size()));
  Index k = 0;
  for (const double rate : model.bank.rates()) x[k++] = std::log(rate);
  for (const double weight : model.network.neurons) x[k++] = weight;
  for (const double weight : model.network.gates) x[k++] = weight;
  return x;
}

void set_unknowns(BankNetwork& model, const VectorXd& x) {
  const double* at = x.data();
  std::vector<double> rates(model.bank.size());
  for (double& rate : rates) rate = std::exp(*at++);
  model.bank.set_rates(rates);
  for (double& weight : model.network.neurons) weight = *at++;
  for (double& weight : model.network.gates) weight = *at++;
}

/// Gram matrix of [J r] per sample, the records' offsets at their best taken out, and these offsets.
struct System {
  MatrixXd gram;
  std::vector<double> offsets;
  double offset_price = 0;  ///< per sample, among the squares

  double squares() const { return gram(gram.rows() - 1, gram.cols() - 1); }
};

class Problem {
 public:
  Problem(const BankNetwork& start, const std::vector<const BankRecord*>& records,
          const BankTrainOptions& options)
      : options_(options), model_(start), records_(records), start_(unknowns_of(start)) {
    for (const BankRecord* record : records_)
      count_ += (record->inputs.size() - record->first + options_.stride - 1) / options_.stride;
    for (GatedNetwork::Signal& s : model_.network.signals) {
      s.low = -std::numeric_limits<double>::infinity();
      s.high = -s.low;
    }
    prices_ = VectorXd::Constant(start_.size(), options.weight_decay);
    prices_.head(rates()).setConstant(options.rate_decay);
  }

  const VectorXd& start() const { return start_; }

  /// Of squared distances from the anchor: weights from 0, logarithms of rates from their start.
  const VectorXd& prices() const { return prices_; }
  VectorXd distance(const VectorXd& x) const {
    VectorXd moved = x;
    moved.head(rates()) -= start_.head(rates());
    return moved;
  }

  System linearise(const VectorXd& x) {
    set_unknowns(model_, x);
    const Index columns = x.size() + 1;
    MatrixXd gram = MatrixXd::Zero(columns, columns), block(columns, kBlock);
    System system;
    for (const BankRecord* record : records_) {
      VectorXd sums = VectorXd::Zero(columns);
      Index filled = 0;
      double n = 0;
      const auto flush = [&] {
        if (filled == 0) return;
        const auto rows = block.leftCols(filled);
        gram.selfadjointView<Eigen::Lower>().rankUpdate(rows);
        sums += rows.rowwise().sum();
        n += static_cast<double>(filled);
        filled = 0;
      };
      run_bank(model_.bank, *record, options_.stride, true,
               [&](std::size_t k, const std::vector<double>& signals, const std::vector<double>& slopes) {
                 fill(signals, slopes, record->force[k], block.col(filled).data());
                 if (++filled == kBlock) flush();
               });
      flush();
      gram.selfadjointView<Eigen::Lower>().rankUpdate(sums, -centring_of(n));
      const double offset = -centring_of(n) * sums[columns - 1];
      system.offsets.push_back(offset);
      system.offset_price += options_.offset_decay * n * offset * offset / static_cast<double>(count_);
    }
    system.gram = gram.selfadjointView<Eigen::Lower>();
    system.gram /= static_cast<double>(count_);
    return system;
  }

  BankNetwork result(const VectorXd& x, const std::vector<double>& offsets) {
    set_unknowns(model_, x);
    BankNetwork found = model_;
    double mean = 0;
    for (const double offset : offsets) mean += offset / static_cast<double>(offsets.size());
    found.network.gates.front() += mean;
    find_ranges(found);
    return found;
  }

 private:
  Index rates() const { return static_cast<Index>(model_.bank.size()); }

  void find_ranges(BankNetwork& found) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (GatedNetwork::Signal& s : found.network.signals) {
      s.low = kInfinity;
      s.high = -kInfinity;
    }
    for (const BankRecord* record : records_)
      run_bank(found.bank, *record, 1, false,
               [&](std::size_t, const std::vector<double>& raw, const std::vector<double>&) {
                 for (std::size_t k = 0; k < raw.size(); ++k) {
                   GatedNetwork::Signal& s = found.network.signals[k];
                   s.low = std::min(s.low, (raw[k] - s.mean) / s.scale);
                   s.high = std::max(s.high, (raw[k] - s.mean) / s.scale);
                 }
               });
  }

  double centring_of(double n) const {
    return options_.offsets && n > 0 ? 1 / (n * (1 + options_.offset_decay)) : 0;
  }

  /// One sample: derivatives of the output by the unknowns, then the residual.
  void fill(const std::vector<double>& raw, const std::vector<double>& slopes, double force, double* row) {
    const GatedNetwork& network = model_.network;
    std::array<double, GatedNetwork::kMaxSignals> z, by_signals;
    for (std::size_t k = 0; k < raw.size(); ++k)
      z[k] = (raw[k] - network.signals[k].mean) / network.signals[k].scale;
    const double output = network.differentiate(z.data(), row + slopes.size(), by_signals.data());
    const std::size_t first_lag = model_.bank.path_rates.size();
    const std::size_t end_lag = first_lag + model_.bank.velocity_rates.size();
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      const double slope = by_signals[k + 1] / network.signals[k + 1].scale * slopes[k];
      row[k] = k >= first_lag && k < end_lag ? -slope : slope;  // a velocity lag is read as v - y
    }
    row[start_.size()] = output - force / network.output_scale;
  }

  const BankTrainOptions& options_;
  BankNetwork model_;
  const std::vector<const BankRecord*>& records_;
  VectorXd start_, prices_;
  std::size_t count_ = 0;
};

/// Damping as Nielsen (1999) has it, scaled by the diagonal.
class Search {
 public:
  explicit Search(Problem& problem) : problem_(problem), x_(problem.start()), at_(problem.linearise(x_)) {}

  const VectorXd& unknowns() const { return x_; }
  const System& system() const { return at_; }
  double cost() const { return cost_of(at_, x_); }
  bool stuck() const { return damping_ > 1e9; }
  VectorXd half_gradient() const {
    return at_.gram.topRightCorner(x_.size(), 1) + problem_.distance(x_).cwiseProduct(problem_.prices());
  }

  /// Tries one step; true when it lowers the cost and was taken.
  bool step() {
    MatrixXd matrix = at_.gram.topLeftCorner(x_.size(), x_.size());
    matrix.diagonal() += problem_.prices();
    const VectorXd descent = -half_gradient();
    MatrixXd damped = matrix;
    damped.diagonal() *= 1 + damping_;
    const VectorXd step = damped.llt().solve(descent), trial = x_ + step;
    const double predicted = 2 * step.dot(descent) - step.dot(matrix * step);
    System system = problem_.linearise(trial);
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
  double cost_of(const System& system, const VectorXd& x) const {
    return system.squares() + problem_.distance(x).cwiseAbs2().dot(problem_.prices());
  }

  Problem& problem_;
  VectorXd x_;
  System at_;
  double damping_ = 0.01, growth_ = 2;
};

}  // namespace

BankTrainReport train(BankNetwork& model, const std::vector<const BankRecord*>& records,
                      const BankTrainOptions& options) {
  constexpr std::size_t kWindow = 3;  // steps over which the cost must still fall
  Problem problem(model, records, options);
  Search search(problem);
  BankTrainReport report;
  std::vector<double> costs{search.cost()};
  while (!report.converged && report.iterations < options.max_iterations) {
    if (options.on_iteration) options.on_iteration();
    ++report.iterations;
    if (search.step()) costs.push_back(search.cost());
    const bool level = costs.size() > kWindow &&
                       costs[costs.size() - 1 - kWindow] - costs.back() < options.tolerance * costs.back();
    report.converged = level || search.stuck();
  }
  const System& found = search.system();
  report.rmse = model.network.output_scale * std::sqrt(std::max(0.0, found.squares() - found.offset_price));
  model = problem.result(search.unknowns(), found.offsets);
  return report;
}

BankCost bank_cost(const BankNetwork& model, const std::vector<const BankRecord*>& records,
                   const BankTrainOptions& options) {
  Problem problem(model, records, options);
  const Search search(problem);
  const VectorXd gradient = search.half_gradient();
  return {search.cost(), {gradient.begin(), gradient.end()}};
}

double squares_left(const BankNetwork& model, const BankRecord& record, bool offset) {
  double sum = 0, squares = 0, n = 0;
  run_bank(model.bank, record, 1, false,
           [&](std::size_t k, const std::vector<double>& signals, const std::vector<double>&) {
             const double r = model.network.evaluate(signals.data()) - record.force[k];
             sum += r;
             squares += r * r;
             ++n;
           });
  return squares - (offset && n > 0 ? sum * sum / n : 0);
}

}  // namespace dashpot
