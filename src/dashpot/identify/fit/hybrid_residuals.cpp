#include "dashpot/identify/fit/hybrid_residuals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "dashpot/base/parallel.h"

namespace dashpot {
namespace {

std::size_t scored(const ScoredPart& part, std::size_t stride) {
  return (part.last - part.first + stride - 1) / stride;
}

/// The covariance of the motions, n x n; only its lower triangle is filled.
std::vector<double> covariance_of(const SignalRows& rows, const std::vector<double>& mean) {
  const std::size_t n = mean.size();
  const double share = 1 / static_cast<double>(rows.size());
  std::vector<double> covariance(n * n);
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b <= a; ++b)
        covariance[a * n + b] += share * (rows.row(k)[a] - mean[a]) * (rows.row(k)[b] - mean[b]);
  return covariance;
}

}  // namespace

SignalPoint standardised(const SignalMixing& mixing, const GatedNetwork& network,
                         const double* raw) {
  SignalPoint point;
  mixing.apply(raw, point.data());
  for (std::size_t k = network.motions(); k < network.signals.size(); ++k)
    point[k] = (raw[k] - network.signals[k].mean) / network.signals[k].scale;
  return point;
}

GatedNetwork with_weights(GatedNetwork network, std::span<const double> weights) {
  const auto gates = weights.begin() + static_cast<std::ptrdiff_t>(network.neurons.size());
  std::copy(weights.begin(), gates, network.neurons.begin());
  std::copy(gates, weights.end(), network.gates.begin());
  return network;
}

/// Gram-Schmidt on the signals' covariance: its Cholesky root, inverted row by row.
SignalMixing mixing_of(const SignalRows& rows) {
  // Of a signal's own deviation: less left than this counts as nothing.
  constexpr double kNothing = 1e-3;
  const std::size_t n = rows.motions();
  const double share = 1 / static_cast<double>(rows.size());

  // The signals' means and their covariance.
  SignalMixing mixing{std::vector<double>(n), {}};
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t s = 0; s < n; ++s) mixing.mean[s] += share * rows.row(k)[s];
  const std::vector<double> covariance = covariance_of(rows, mixing.mean);

  // The Cholesky root row by row, and beside it the row of its inverse, which standardises the
  // signal. A signal that those before it explain gets a row of zeros.
  std::vector<double> root(n * n), inverse(n * n);
  for (std::size_t a = 0; a < n; ++a) {
    const auto dot = [&](std::size_t b) {
      return std::inner_product(&root[a * n], &root[a * n] + b, &root[b * n], 0.0);
    };
    for (std::size_t b = 0; b < a; ++b)
      if (root[b * n + b] > 0) root[a * n + b] = (covariance[a * n + b] - dot(b)) / root[b * n + b];

    // The deviation that is left once the signals before it are taken out.
    const double variance = covariance[a * n + a], left = variance - dot(a);
    if (left > kNothing * kNothing * variance) {
      const double pivot = root[a * n + a] = std::sqrt(left);
      for (std::size_t b = 0; b < a; ++b)
        for (std::size_t j = b; j < a; ++j)
          inverse[a * n + b] -= root[a * n + j] * inverse[j * n + b] / pivot;
      inverse[a * n + a] = 1 / pivot;
    } else {
      std::fill_n(&root[a * n], a, 0.0);
    }
    mixing.rows.insert(mixing.rows.end(), &inverse[a * n], &inverse[a * n] + a + 1);
  }
  return mixing;
}

HybridResiduals::HybridResiduals(const HybridData& data, ScoredParts parts, std::size_t stride)
    : data_(data), unknowns_(data.unknowns), parts_(std::move(parts)), stride_(stride) {
  for (const ScoredPart& part : parts_) {
    size_ += scored(part, stride_);
    for (std::size_t k = part.first; k < part.last; k += stride_)
      force_.push_back(data_.records[part.record].force[k]);
  }
}

SignalRows HybridResiduals::signals(std::span<const double> law_unknowns) const {
  const HybridSource source{unknowns_.model(law_unknowns), data_.bank};

  // One row of signals per scored sample.
  SignalRows rows{
      source.motions() + source.currents(), source.currents(), source.force_place(), {}};
  rows.values.resize(size_ * rows.width);
  double* row = rows.values.data();

  // Run the law from rest through each record, and read its signals where the part is scored.
  std::vector<double> state(source.state_size());
  for (const ScoredPart& part : parts_) {
    const FreeRunRecord& record = data_.records[part.record];
    source.rest(record.inputs.front(), state);
    for (std::size_t k = 0; k < part.last; ++k) {
      if (k > 0)
        source.advance(record.inputs[k - 1], record.inputs[k], record.time[k] - record.time[k - 1],
                       state);
      if (k < part.first || (k - part.first) % stride_ != 0) continue;
      source.read(record.inputs[k], state, row);
      if (!std::all_of(row, row + rows.width, [](double s) { return std::isfinite(s); })) return {};
      row += rows.width;
    }
  }
  return rows;
}

void HybridResiduals::take_means_out(std::span<double> values) const {
  if (data_.offset == OffsetMode::None) return;
  for (const ScoredPart& part : parts_) {
    const std::size_t n = scored(part, stride_);
    const double mean =
        std::accumulate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n), 0.0) /
        static_cast<double>(n);
    for (double& value : values.first(n)) value -= mean;
    values = values.subspan(n);
  }
}

void HybridResiduals::evaluate(const Network& start, const SignalRows& rows,
                               std::span<const double> weights, std::span<double> residuals) const {
  const GatedNetwork network = with_weights(start.start, weights);
  const std::size_t force = rows.force;
  for (std::size_t k = 0; k < size_; ++k) {
    const SignalPoint point = standardised(start.mixing, network, rows.row(k));
    residuals[k] =
        force_[k] - rows.row(k)[force] - network.output_scale * network.output(point.data());
  }
  take_means_out(residuals.first(size_));
}

SignalRows HybridResiduals::slopes(const SignalRows& here, std::span<const double> law_unknowns,
                                   std::size_t unknown) const {
  constexpr double kStep = 1e-6;
  std::vector<double> moved(law_unknowns.begin(), law_unknowns.end());
  const double length = kStep * std::max(1.0, std::abs(moved[unknown]));

  // Step away from the bound; where a record diverges on that side, try the other one.
  const bool upward = moved[unknown] + length <= unknowns_.upper()[unknown];
  for (const double step : {upward ? length : -length, upward ? -length : length}) {
    moved[unknown] = law_unknowns[unknown] + step;
    SignalRows there = signals(moved);
    if (there.values.empty()) continue;
    for (std::size_t k = 0; k < there.values.size(); ++k)
      there.values[k] = (there.values[k] - here.values[k]) / step;
    return there;
  }
  return {};
}

/// Derivatives by the weights are exact; those by the law's unknowns come from differences of its
/// signals, through the network's slopes.
void HybridResiduals::linearise(const Network& start, const SignalRows& rows,
                                const std::vector<SignalRows>& slopes,
                                std::span<const double> weights, std::span<double> residuals,
                                std::span<double* const> columns) const {
  const GatedNetwork network = with_weights(start.start, weights);

  const double scale = network.output_scale;
  const std::size_t own = slopes.size(), motions = network.motions(), force = rows.force;
  const auto width = static_cast<std::ptrdiff_t>(rows.width);
  std::vector<double> by_weights(weights.size());
  SignalPoint by_signals, change;
  for (std::size_t k = 0; k < size_; ++k) {
    const SignalPoint point = standardised(start.mixing, network, rows.row(k));

    // The residual, and the network's slopes by its weights and by its signals.
    residuals[k] =
        force_[k] - rows.row(k)[force] -
        scale * network.differentiate(point.data(), by_weights.data(), by_signals.data());

    // The columns of the weights are the network's own slopes.
    for (std::size_t w = 0; w < weights.size(); ++w)
      if (columns[own + w]) columns[own + w][k] = -scale * by_weights[w];

    // A law's unknown moves the law's force and, by the chain rule, the network through its
    // signals.
    for (std::size_t u = 0; u < own; ++u) {
      if (!columns[u]) continue;
      const double* slope = slopes[u].row(k);
      start.mixing.apply_to_change(slope, change.data());
      for (std::size_t c = motions; c < rows.width; ++c)
        change[c] = slope[c] / network.signals[c].scale;
      columns[u][k] =
          -slope[force] - scale * std::inner_product(change.begin(), change.begin() + width,
                                                     by_signals.begin(), 0.0);
    }
  }

  // Offsets are eliminated from the residuals and from every column alike.
  take_means_out(residuals.first(size_));
  for (double* const column : columns)
    if (column) take_means_out({column, size_});
}

namespace {

/// Weights decay towards their start: decaying towards 0, the neurons would vanish in the first
/// step, in which the silent gates do not hold them yet, and come back slowly.
void add_decay(const HybridResiduals::Network& network, std::span<const double> weights,
               std::span<double> r) {
  const double decay = std::sqrt(network.decay);
  const std::vector<double>&neurons = network.start.neurons, &gates = network.start.gates;
  for (std::size_t w = 0; w < neurons.size(); ++w) r[w] = decay * (weights[w] - neurons[w]);
  for (std::size_t w = 0; w < gates.size(); ++w)
    r[neurons.size() + w] = decay * (weights[neurons.size() + w] - gates[w]);
}

/// Adds the weights' bounds to the law's.
void add_bounds(const HybridResiduals::Network& network, LeastSquaresProblem& problem) {
  const std::size_t own = problem.lower.size();
  problem.lower.resize(own + network.start.parameter_count(), -INFINITY);
  problem.upper.resize(own + network.start.parameter_count(), INFINITY);
  for (std::size_t w = 0; w < network.fixed.size(); ++w) {
    if (!network.fixed[w]) continue;
    const std::vector<double>&neurons = network.start.neurons, &gates = network.start.gates;
    problem.lower[own + w] = problem.upper[own + w] =
        w < neurons.size() ? neurons[w] : gates[w - neurons.size()];
  }
}

}  // namespace

LeastSquaresProblem HybridResiduals::problem(const Network& network, const SignalRows& rows) const {
  const std::size_t weights = network.start.parameter_count();
  const double decay = std::sqrt(network.decay);

  // The residuals of the data come first, then one per weight for the weight decay.
  LeastSquaresProblem problem;
  problem.residuals = size_ + weights;
  add_bounds(network, problem);

  // The residuals at given weights; the law's signals stay as they are.
  problem.residual = [=, &rows, this](std::span<const double> x, std::span<double> r) {
    add_decay(network, x, r.subspan(size_));
    evaluate(network, rows, x, r);
    return true;
  };

  // The same with its columns: the weight decay's part is diagonal, the network's is exact.
  problem.jacobian = [=, &rows, this](std::span<const double> x, std::span<double> r,
                                      std::span<double* const> columns) {
    add_decay(network, x, r.subspan(size_));
    for (std::size_t w = 0; w < weights; ++w) {
      if (!columns[w]) continue;
      std::fill_n(columns[w] + size_, weights, 0.0);
      columns[w][size_ + w] = decay;
    }
    linearise(network, rows, {}, x, r, columns);
    return true;
  };
  return problem;
}

LeastSquaresProblem HybridResiduals::problem(const Network& network,
                                             std::span<const double> law_start, double noise,
                                             int threads) const {
  const std::size_t own = unknowns_.size(), weights = network.start.parameter_count(),
                    all = own + weights;
  const std::vector<LawUnknowns::PriorTerm> priors =
      noise > 0 ? unknowns_.priors() : std::vector<LawUnknowns::PriorTerm>{};
  const double decay = std::sqrt(network.decay);

  // The residuals of the data come first, then the decay of every unknown, then the priors.
  LeastSquaresProblem problem;
  problem.residuals = size_ + all + priors.size();
  problem.lower = unknowns_.lower();
  problem.upper = unknowns_.upper();
  add_bounds(network, problem);

  // The residuals that need no simulation: the decay towards the start, and the priors.
  const std::vector<double> start(law_start.begin(), law_start.end());
  const auto add_known = [=, this](std::span<const double> x, std::span<double> r) {
    for (std::size_t u = 0; u < own; ++u) r[size_ + u] = decay * (x[u] - start[u]);
    add_decay(network, x.subspan(own), r.subspan(size_ + own, weights));
    for (std::size_t k = 0; k < priors.size(); ++k)
      r[size_ + all + k] = priors[k].residual(x[priors[k].unknown], noise);
  };

  // The residuals at given unknowns; false where the law diverges.
  problem.residual = [=, this](std::span<const double> x, std::span<double> r) {
    add_known(x, r);
    const SignalRows rows = signals(x.first(own));
    if (rows.values.empty()) return false;
    evaluate(network, rows, x.subspan(own), r);
    return true;
  };

  // The same with its columns.
  problem.jacobian = [=, this](std::span<const double> x, std::span<double> r,
                               std::span<double* const> columns) {
    add_known(x, r);

    // The decay's columns are diagonal, and each prior depends on one unknown.
    for (std::size_t k = 0; k < all; ++k) {
      if (!columns[k]) continue;
      std::fill(columns[k] + size_, columns[k] + r.size(), 0.0);
      columns[k][size_ + k] = decay;
    }
    for (std::size_t k = 0; k < priors.size(); ++k)
      if (double* const column = columns[priors[k].unknown])
        column[size_ + all + k] = priors[k].slope(noise);

    // The law's slopes by differences, a thread per unknown, then the data's columns from them.
    const SignalRows rows = signals(x.first(own));
    if (rows.values.empty()) return false;
    std::vector<SignalRows> by_unknowns(own);
    parallel_for(own, threads, [&](std::size_t u) {
      if (columns[u]) by_unknowns[u] = slopes(rows, x.first(own), u);
    });
    for (std::size_t u = 0; u < own; ++u)
      if (columns[u] && by_unknowns[u].values.empty()) return false;
    linearise(network, rows, by_unknowns, x.subspan(own), r, columns);
    return true;
  };
  return problem;
}

}  // namespace dashpot
