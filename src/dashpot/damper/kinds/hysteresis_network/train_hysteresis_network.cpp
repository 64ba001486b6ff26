#include "dashpot/damper/kinds/hysteresis_network/train_hysteresis_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dashpot/damper/nets/free_run_search.h"

namespace dashpot {
namespace {

/// Runs the bank over a record and calls use(sample, signals, slopes) at each scored sample.
/// `slopes`: the signals' derivatives by the logarithm of the one rate that each has; none for the
/// velocity.
template <class Use>
void run_bank(const HysteresisBank& bank, const FreeRunRecord& record, std::size_t stride,
              bool with_slopes, Use use) {
  std::vector<double> state(bank.size()), slopes(with_slopes ? bank.size() : 0);
  std::vector<double> signals(bank.signal_count());
  bank.rest(record.inputs.front(), state);
  for (std::size_t k = 0; k < record.inputs.size(); ++k) {
    if (k > 0)
      bank.advance(record.inputs[k - 1], record.inputs[k], record.time[k] - record.time[k - 1],
                   state, slopes);
    if (k < record.first || (k - record.first) % stride != 0) continue;
    bank.read(record.inputs[k], state, signals.data());
    use(k, signals, slopes);
  }
}

/// Unknowns: ln rates, neurons, gates.
std::vector<double> unknowns_of(const HysteresisNetwork& model) {
  std::vector<double> x;
  for (const double rate : model.bank.rates()) x.push_back(std::log(rate));
  x.insert(x.end(), model.network.neurons.begin(), model.network.neurons.end());
  x.insert(x.end(), model.network.gates.begin(), model.network.gates.end());
  return x;
}

void set_unknowns(HysteresisNetwork& model, const std::vector<double>& x) {
  const double* at = x.data();
  std::vector<double> rates(model.bank.size());
  for (double& rate : rates) rate = std::exp(*at++);
  model.bank.set_rates(rates);
  for (double& weight : model.network.neurons) weight = *at++;
  for (double& weight : model.network.gates) weight = *at++;
}

/// One sample: derivatives of the output by the unknowns, then the residual. While a network learns
/// nothing is held.
void fill(const HysteresisNetwork& model, const std::vector<double>& raw,
          const std::vector<double>& slopes, double force, bool holds, double* row) {
  const GatedNetwork& network = model.network;
  std::array<double, GatedNetwork::kMaxSignals> z, held, by_signals;
  network.standardise(raw.data(), z.data());
  if (holds) network.hold(z.data(), held.data());
  const double output = network.differentiate(z.data(), holds ? held.data() : z.data(),
                                              row + slopes.size(), by_signals.data());
  const std::size_t first_lag = model.bank.path_rates.size();
  const std::size_t end_lag = first_lag + model.bank.velocity_rates.size();
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    const double slope = by_signals[k + 1] / network.signals[k + 1].scale * slopes[k];
    row[k] = k >= first_lag && k < end_lag ? -slope : slope;  // a velocity lag is read as v - y
  }
  row[model.parameter_count()] = output - force / network.output_scale;
}

void linearise(const HysteresisNetwork& model, const std::vector<const FreeRunRecord*>& records,
               std::size_t stride, RowSink& sink) {
  for (const FreeRunRecord* record : records) {
    run_bank(
        model.bank, *record, stride, true,
        [&](std::size_t k, const std::vector<double>& signals, const std::vector<double>& slopes) {
          fill(model, signals, slopes, record->force[k], false, sink.row());
        });
    sink.end_record();
  }
}

/// Adds what the model pays for the energy that it feeds into motions, its signals held within the
/// ranges that it starts with.
void add_penalties(const HysteresisNetwork& model, const ActivityPenalty& penalty, RowSink& sink) {
  std::array<double, GatedNetwork::kMaxSignals> z, held;
  std::vector<double> row(model.parameter_count() + 1);
  penalty.add(
      model.parameter_count(), sink,
      [&](const FreeRunRecord& record, auto use) {
        run_bank(model.bank, record, 1, false,
                 [&](std::size_t, const std::vector<double>& signals, const std::vector<double>&) {
                   model.network.standardise(signals.data(), z.data());
                   model.network.hold(z.data(), held.data());
                   use(model.network.output(z.data(), held.data()));
                 });
      },
      [&](const FreeRunRecord& record, auto use) {
        run_bank(model.bank, record, 1, true,
                 [&](std::size_t, const std::vector<double>& signals,
                     const std::vector<double>& slopes) {
                   fill(model, signals, slopes, 0, true, row.data());
                   use(row.data());
                 });
      });
}

void find_ranges(HysteresisNetwork& found, const std::vector<const FreeRunRecord*>& records) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (GatedNetwork::Signal& s : found.network.signals) {
    s.low = kInfinity;
    s.high = -kInfinity;
  }
  // Rest belongs to the range of the velocity, so that what goes on beyond it resists the motion.
  found.network.signals.front().low = found.network.signals.front().high = 0;

  // Take in every sample of every record, in free run.
  for (const FreeRunRecord* record : records)
    run_bank(found.bank, *record, 1, false,
             [&](std::size_t, const std::vector<double>& raw, const std::vector<double>&) {
               for (std::size_t k = 0; k < raw.size(); ++k) {
                 GatedNetwork::Signal& s = found.network.signals[k];
                 s.low = std::min(s.low, (raw[k] - s.mean) / s.scale);
                 s.high = std::max(s.high, (raw[k] - s.mean) / s.scale);
               }
             });
}

FreeRunSearchResult run_search(HysteresisNetwork model,
                               const std::vector<const FreeRunRecord*>& records,
                               const HysteresisNetworkTrainOptions& options, int max_iterations) {
  FreeRunProblem problem;
  problem.start = unknowns_of(model);
  problem.decay.assign(problem.start.size(), options.weight_decay);
  std::fill_n(problem.decay.begin(), model.bank.size(), options.rate_decay);
  problem.anchors.assign(problem.start.size(), 0.0);  // weights from 0, rates from their start
  std::copy_n(problem.start.begin(), model.bank.size(), problem.anchors.begin());

  // Each evaluation runs all records with the unknowns at hand.
  problem.linearise = [&](const std::vector<double>& x, RowSink& sink) {
    set_unknowns(model, x);
    linearise(model, records, options.stride, sink);
    if (options.penalty) add_penalties(model, *options.penalty, sink);
  };
  return search(problem, {.max_iterations = max_iterations,
                          .tolerance = options.tolerance,
                          .offsets = options.offsets,
                          .offset_decay = options.offset_decay,
                          .on_iteration = options.on_iteration});
}

}  // namespace

FreeRunTrainReport train(HysteresisNetwork& model, const std::vector<const FreeRunRecord*>& records,
                         const HysteresisNetworkTrainOptions& options) {
  const FreeRunSearchResult found = run_search(model, records, options, options.max_iterations);
  set_unknowns(model, found.unknowns);
  for (const double offset : found.offsets)
    model.network.gates.front() += offset / static_cast<double>(found.offsets.size());
  find_ranges(model, records);
  return {found.converged, found.iterations, model.network.output_scale * found.rms};
}

FreeRunCost hysteresis_network_cost(const HysteresisNetwork& model,
                                    const std::vector<const FreeRunRecord*>& records,
                                    const HysteresisNetworkTrainOptions& options) {
  const FreeRunSearchResult at = run_search(model, records, options, 0);
  return {at.cost, at.half_gradient};
}

double squares_left(const HysteresisNetwork& model, const FreeRunRecord& record, bool offset) {
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
