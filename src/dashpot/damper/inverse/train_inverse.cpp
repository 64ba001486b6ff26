#include "dashpot/damper/inverse/train_inverse.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dashpot/damper/nets/standardise.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

using Currents = std::vector<std::vector<double>>;  // one row per run

/// First sample at which every delay lies within the run.
std::size_t first_sample(const InverseNetwork& network, const InverseRun& run) {
  int longest = 0;
  for (const Tap& tap : network.taps) longest = std::max(longest, tap.delay);
  return static_cast<std::size_t>(longest) * network.stride(run.sample_time);
}

/// A signal of a run at sample k; `fed` holds the currents that count as its past answers.
double signal_of(const InverseRun& run, std::size_t k, Tap::Signal signal,
                 const std::vector<double>& fed) {
  switch (signal) {
    case Tap::Signal::Displacement:
      return run.inputs[k].displacement;
    case Tap::Signal::Velocity:
      return run.inputs[k].velocity;
    case Tap::Signal::Force:
      return run.force[k];
    default:
      return fed[k];
  }
}

double mean_weight(std::span<const InverseRun> runs) {
  double sum = 0, samples = 0;
  for (const InverseRun& run : runs) {
    sum += std::accumulate(run.weight.begin(), run.weight.end(), 0.0);
    samples += static_cast<double>(run.size());
  }
  return samples > 0 ? sum / samples : 0;
}

/// Draws samples at equal steps of the summed weight, so that a plain mean over them is the
/// weighted one.
TrainingSamples drawn(const InverseNetwork& network, std::span<const InverseRun> runs,
                      const Currents& fed, const InverseTraining& options, std::size_t count) {
  const double floor = options.least_weight * mean_weight(runs);
  const auto weight = [&](const InverseRun& run, std::size_t k) {
    return run.weight[k] > 0 ? run.weight[k] + floor : 0;
  };
  double total = 0;
  for (const InverseRun& run : runs)
    for (std::size_t k = first_sample(network, run); k < run.size(); ++k) total += weight(run, k);
  if (!(total > 0) || !std::isfinite(total))
    throw Error(network.name, "the current makes no difference to the force anywhere in the runs");

  TrainingSamples samples;
  const double step = total / static_cast<double>(count);
  double passed = 0, next = 0.5 * step;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const InverseRun& run = runs[r];
    const std::size_t stride = network.stride(run.sample_time);
    for (std::size_t k = first_sample(network, run); k < run.size(); ++k)
      for (passed += weight(run, k); next < passed; next += step) {
        for (const Tap& tap : network.taps)
          samples.inputs.push_back(
              signal_of(run, k - static_cast<std::size_t>(tap.delay) * stride, tap.signal, fed[r]));
        samples.targets.push_back(run.inputs[k].current);
      }
  }
  return samples;
}

/// The preset's network without weights.
InverseNetwork untrained(const InverseNetworkPreset& preset, const InverseTraining& options) {
  InverseNetwork network{.name = std::string(preset.name),
                         .taps = preset.taps,
                         .spacing = options.spacing,
                         .current_min = options.current_min,
                         .current_max = options.current_max,
                         .mlp = {}};
  network.mlp.layers = {preset.taps.size()};
  network.mlp.layers.insert(network.mlp.layers.end(), preset.hidden.begin(), preset.hidden.end());
  network.mlp.layers.push_back(1);
  return network;
}

/// The currents of the runs themselves.
Currents true_currents(std::span<const InverseRun> runs) {
  Currents rows;
  for (const InverseRun& run : runs) {
    rows.emplace_back();
    for (const DamperInput& input : run.inputs) rows.back().push_back(input.current);
  }
  return rows;
}

/// The network's own currents along the runs, in free run.
Currents all_answers(const InverseNetwork& network, std::span<const InverseRun> runs) {
  Currents rows;
  for (const InverseRun& run : runs) rows.push_back(answers(network, run));
  return rows;
}

}  // namespace

std::vector<double> answers(const InverseNetwork& network, const InverseRun& run) {
  const HistoryNetwork inverse(network,
                               {network.current_min, network.current_max, run.sample_time, 0});
  std::vector<double> state(inverse.state_size()), currents;
  inverse.rest(run.inputs.front(), state);
  for (std::size_t k = 0; k < run.size(); ++k) {
    const DamperInput& now = run.inputs[k];
    currents.push_back(
        inverse.command({run.force[k], now.displacement, now.velocity, now.current, 0}, state));
  }
  return currents;
}

double weighted_error(std::span<const InverseRun> runs,
                      std::span<const std::vector<double>> currents) {
  double squares = 0, weights = 0;
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (std::size_t k = 0; k < runs[r].size(); ++k) {
      const double error = currents[r][k] - runs[r].inputs[k].current;
      squares += runs[r].weight[k] * error * error;
      weights += runs[r].weight[k];
    }
  return weights > 0 ? std::sqrt(squares / weights) : 0;
}

TaughtInverse train_inverse(const InverseNetworkPreset& preset,
                            std::span<const InverseRun> training,
                            std::span<const InverseRun> left_out, const InverseTraining& options) {
  InverseNetwork network = untrained(preset, options);
  Currents fed = true_currents(training), fed_left_out = true_currents(left_out);

  TaughtInverse best;
  for (int round = 0; round < (network.feeds_back() ? 1 + options.rounds : 1); ++round) {
    // Train on one step ahead: the past currents are the true ones in the first round, then those
    // that the network itself gave.
    const TrainingSamples samples = drawn(network, training, fed, options, options.samples);
    const TrainingSamples others =
        drawn(network, left_out, fed_left_out, options, options.samples / 3);
    if (round == 0) standardise(network.mlp, samples);

    TrainOptions train_options;
    train_options.max_iterations = options.iterations;
    train_options.weight_decay = options.weight_decay;
    train_options.seed = options.seed;
    train_options.threads = options.threads;
    train_options.stopping.left_out = &others;
    train_options.on_iteration = [&](int, double) { options.monitor.check(); };
    train(network.mlp, samples, train_options);

    // Judge in free run, which also gives the next round its currents.
    fed = all_answers(network, training);
    fed_left_out = all_answers(network, left_out);
    const double error = weighted_error(left_out, fed_left_out);
    if (round == 0 || error < best.left_out_rmse)
      best = {network, weighted_error(training, fed), error};
  }
  return best;
}

}  // namespace dashpot
