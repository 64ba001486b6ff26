#include "dashpot/damper/kinds/state_space/train_state_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "dashpot/damper/nets/free_run_search.h"

namespace dashpot {
namespace {

constexpr std::size_t kMoments = 4;      // that the encoder sees
constexpr double kMomentSpacing = 0.01;  // s

using Records = std::vector<const FreeRunRecord*>;

/// A part of a record that is run freely.
struct Window {
  const FreeRunRecord* record;
  std::size_t begin, end, first;  ///< first: scored from here on
  std::vector<double> features;   ///< what the encoder sees; none: from rest
  std::vector<double> currents;   ///< standardised, behind their lags, at its beginning
};

Window whole(const FreeRunRecord& record) {
  return {&record, 0, record.inputs.size(), record.first, {}, {}};
}

std::vector<Window> wholes(const Records& records) {
  std::vector<Window> all;
  for (const FreeRunRecord* record : records) all.push_back(whole(*record));
  return all;
}

/// Puts the states where the encoder says, and their derivatives by its weights beside those by the
/// cell's parameters.
void encode(const StateSpaceCell& cell, const double* weights, const Window& window,
            std::vector<double>& state, StateSpaceCell::Slopes* slopes) {
  const std::size_t count = window.features.size();
  for (std::size_t k = 0; k < cell.motions(); ++k, weights += count) {
    const bool is_path = k < cell.path_rates.size();
    const double sum =
        std::inner_product(window.features.begin(), window.features.end(), weights, 0.0);
    state[k] = is_path ? std::tanh(sum) : sum;

    // The slopes by this state's own weights.
    if (!slopes) continue;
    const double slope = is_path ? 1 - state[k] * state[k] : 1;
    double* row = slopes->motion(k) + cell.parameter_count() + k * count;
    for (const double feature : window.features) *row++ = slope * feature;
  }
  std::copy(window.currents.begin(), window.currents.end(),
            state.begin() + static_cast<std::ptrdiff_t>(cell.motions()));
}

/// Runs the cell over a window and calls use(sample, signals) at each scored sample.
template <class Use>
void run_cell(const StateSpaceCell& cell, const double* encoder, const Window& window,
              std::size_t stride, StateSpaceCell::Slopes* slopes, Use use) {
  const FreeRunRecord& record = *window.record;
  std::vector<double> state(cell.size()), signals(cell.signal_count());
  if (window.features.empty())
    cell.rest(record.inputs.front(), state, slopes);
  else
    encode(cell, encoder, window, state, slopes);

  // Run freely, and hand over the signals of each scored sample.
  for (std::size_t k = window.begin; k < window.end; ++k) {
    if (k > window.begin)
      cell.advance(record.inputs[k - 1], record.inputs[k], record.time[k] - record.time[k - 1],
                   state, slopes);
    if (k < window.first || (k - window.first) % stride != 0) continue;
    cell.read(record.inputs[k], state, signals.data());
    use(k, signals);
  }
}

/// Cuts records into windows that have a past, with what the encoder sees there; records too short
/// for that stay whole.
class Windows {
 public:
  Windows(const StateSpaceNetwork& model, const StateSpaceTrainOptions& options)
      : model_(model), options_(options) {}

  std::vector<Window> of(const Records& records) const {
    if (options_.window == 0) return wholes(records);
    std::vector<Window> all;
    std::size_t steps = 0;
    for (const FreeRunRecord* record : records) steps += record->inputs.size() - record->first;
    const std::size_t every = (steps + options_.most_steps - 1) / options_.most_steps;
    for (const FreeRunRecord* record : records) add(*record, every, all);
    return all.empty() ? wholes(records) : all;
  }

 private:
  void add(const FreeRunRecord& record, std::size_t every, std::vector<Window>& all) const {
    const StateSpaceCell& cell = model_.cell;
    const std::size_t samples = record.inputs.size();
    if (samples < 2) return;
    const double dt = (record.time.back() - record.time.front()) / static_cast<double>(samples - 1);
    const auto spacing =
        std::max<std::size_t>(1, static_cast<std::size_t>(kMomentSpacing / dt + 0.5));
    const std::size_t past = (kMoments - 1) * spacing;
    const double mean = std::accumulate(record.force.begin(), record.force.end(), 0.0) /
                        static_cast<double>(samples);

    // Run the cell over the record, which gives the currents behind their lags at any sample.
    std::vector<double> state(cell.size());
    cell.rest(record.inputs.front(), state);
    std::size_t next = std::max(record.first, past);
    for (std::size_t k = 0; k < samples; ++k) {
      if (k > 0)
        cell.advance(record.inputs[k - 1], record.inputs[k], record.time[k] - record.time[k - 1],
                     state);
      if (k != next) continue;

      // A window starts here: its features are those currents, then velocity and force at past
      // moments.
      Window window{
          &record, k,   std::min(k + options_.window, samples),
          k,       {1}, {state.begin() + static_cast<std::ptrdiff_t>(cell.motions()), state.end()}};
      window.features.insert(window.features.end(), window.currents.begin(), window.currents.end());
      for (std::size_t j = 0; j < kMoments; ++j) {
        window.features.push_back(record.inputs[k - j * spacing].velocity / cell.velocity_scale);
        window.features.push_back((record.force[k - j * spacing] - mean) /
                                  model_.network.output_scale);
      }

      // Skip the windows that a lower number of them leaves out.
      all.push_back(std::move(window));
      next += every * options_.window;
    }
  }

  const StateSpaceNetwork& model_;
  const StateSpaceTrainOptions& options_;
};

/// Unknowns: the cell's parameters, the encoder's weights, neurons and gates of the network.
std::vector<double> unknowns_of(const StateSpaceNetwork& model, std::size_t encoder_weights) {
  std::vector<double> x = model.cell.parameters();
  x.resize(x.size() + encoder_weights);
  x.insert(x.end(), model.network.neurons.begin(), model.network.neurons.end());
  x.insert(x.end(), model.network.gates.begin(), model.network.gates.end());
  return x;
}

void set_unknowns(StateSpaceNetwork& model, const std::vector<double>& x) {
  model.cell.set_parameters(x.data());
  const double* at = x.data() + x.size() - model.network.parameter_count();
  for (double& weight : model.network.neurons) weight = *at++;
  for (double& weight : model.network.gates) weight = *at++;
}

/// One sample: derivatives of the output by the unknowns, then the residual. While a network learns
/// nothing is held.
void fill(const StateSpaceNetwork& model, const std::vector<double>& raw,
          StateSpaceCell::Slopes& slopes, double force, bool holds, double* row) {
  const StateSpaceCell& cell = model.cell;
  const GatedNetwork& network = model.network;
  const std::size_t columns = slopes.columns, n = cell.motions();
  std::array<double, GatedNetwork::kMaxSignals> z, held, by_signals;
  network.standardise(raw.data(), z.data());
  if (holds) network.hold(z.data(), held.data());
  const double output = network.differentiate(z.data(), holds ? held.data() : z.data(),
                                              row + columns, by_signals.data());

  // Derivatives by what moves the states, through the signals that the network reads.
  std::fill_n(row, columns, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const double sign = k < cell.path_rates.size() ? 1 : -1;  // a lag is read as v - y
    const double factor = sign * by_signals[1 + k] / network.signals[1 + k].scale;
    const double* slope = slopes.motion(k);
    for (std::size_t c = 0; c < columns; ++c) row[c] += factor * slope[c];
  }
  for (std::size_t m = 0; m < cell.currents(); ++m)
    row[n + m] += by_signals[1 + n + m] / network.signals[1 + n + m].scale * slopes.currents[m];
  row[columns + network.parameter_count()] = output - force / network.output_scale;
}

void linearise(const StateSpaceNetwork& model, const double* encoder, std::size_t encoder_weights,
               const std::vector<Window>& windows, std::size_t stride, RowSink& sink) {
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const FreeRunRecord* record = windows[w].record;
    StateSpaceCell::Slopes slopes(model.cell, encoder_weights);
    run_cell(model.cell, encoder, windows[w], stride, &slopes,
             [&](std::size_t k, const std::vector<double>& signals) {
               fill(model, signals, slopes, record->force[k], false, sink.row());
             });
    if (w + 1 == windows.size() || windows[w + 1].record != record) sink.end_record();
  }
}

/// Adds what the model pays for the energy that it feeds into motions, each from rest, its signals
/// held within the ranges that it starts with.
void add_penalties(const StateSpaceNetwork& model, std::size_t encoder_weights,
                   const ActivityPenalty& penalty, RowSink& sink) {
  std::array<double, GatedNetwork::kMaxSignals> z, held;
  const std::size_t unknowns = model.parameter_count() + encoder_weights;
  std::vector<double> row(unknowns + 1);
  penalty.add(
      unknowns, sink,
      [&](const FreeRunRecord& record, auto use) {
        run_cell(model.cell, nullptr, whole(record), 1, nullptr,
                 [&](std::size_t, const std::vector<double>& signals) {
                   model.network.standardise(signals.data(), z.data());
                   model.network.hold(z.data(), held.data());
                   use(model.network.output(z.data(), held.data()));
                 });
      },
      [&](const FreeRunRecord& record, auto use) {
        StateSpaceCell::Slopes slopes(model.cell, encoder_weights);
        run_cell(model.cell, nullptr, whole(record), 1, &slopes,
                 [&](std::size_t, const std::vector<double>& signals) {
                   fill(model, signals, slopes, 0, true, row.data());
                   use(row.data());
                 });
      });
}

/// Nothing is held while it learns; ranges are those of the records, found afterwards.
void open_ranges(StateSpaceNetwork& model) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  model.cell.velocity_low = model.cell.current_low = -kInfinity;
  model.cell.velocity_high = model.cell.current_high = kInfinity;
}

void find_ranges(StateSpaceNetwork& model, const Records& records) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<GatedNetwork::Signal>& ranges = model.network.signals;
  for (GatedNetwork::Signal& s : ranges) {
    s.low = kInfinity;
    s.high = -kInfinity;
  }
  // Rest belongs to the range of the velocity, so that what goes on beyond it resists the motion.
  ranges.front().low = ranges.front().high = 0;

  // Take in every sample of every record, in free run.
  for (const FreeRunRecord* record : records)
    run_cell(model.cell, nullptr, whole(*record), 1, nullptr,
             [&](std::size_t, const std::vector<double>& raw) {
               for (std::size_t k = 0; k < raw.size(); ++k) {
                 GatedNetwork::Signal& s = ranges[k];
                 s.low = std::min(s.low, (raw[k] - s.mean) / s.scale);
                 s.high = std::max(s.high, (raw[k] - s.mean) / s.scale);
               }
             });

  // The cell holds its own inputs within the same ranges.
  StateSpaceCell& cell = model.cell;
  cell.velocity_low = ranges.front().low;
  cell.velocity_high = ranges.front().high;
  cell.current_low = kInfinity;
  cell.current_high = -kInfinity;
  for (std::size_t m = 1 + cell.motions(); m < ranges.size(); ++m) {
    cell.current_low = std::min(cell.current_low, ranges[m].low);
    cell.current_high = std::max(cell.current_high, ranges[m].high);
  }
}

FreeRunSearchResult run_search(StateSpaceNetwork model, const Records& records,
                               const StateSpaceTrainOptions& options, int max_iterations,
                               const std::vector<double>& unknowns) {
  StateSpaceNetwork holding = model;
  open_ranges(model);
  const std::vector<Window> windows = Windows(model, options).of(records);
  const std::size_t encoder_weights = model.cell.motions() * windows.front().features.size();

  // Weights decay towards 0, logarithms of rates towards their start.
  FreeRunProblem problem;
  problem.anchors = unknowns_of(model, encoder_weights);
  problem.start = unknowns.empty() ? problem.anchors : unknowns;
  problem.decay.assign(problem.start.size(), options.weight_decay);
  std::fill_n(problem.decay.begin(), model.cell.size(), options.rate_decay);
  std::fill(problem.anchors.begin() + static_cast<std::ptrdiff_t>(model.cell.size()),
            problem.anchors.end(),
            0.0);  // weights from 0, rates from their start

  // Each evaluation runs all windows with the unknowns at hand.
  problem.linearise = [&](const std::vector<double>& x, RowSink& sink) {
    set_unknowns(model, x);
    linearise(model, x.data() + model.cell.parameter_count(), encoder_weights, windows,
              options.stride, sink);
    if (!options.penalty) return;
    set_unknowns(holding, x);
    add_penalties(holding, encoder_weights, *options.penalty, sink);
  };
  return search(problem, {.max_iterations = max_iterations,
                          .tolerance = options.tolerance,
                          .offsets = options.offsets,
                          .offset_decay = options.offset_decay,
                          .on_iteration = options.on_iteration});
}

}  // namespace

FreeRunTrainReport train(StateSpaceNetwork& model, const Records& records,
                         const StateSpaceTrainOptions& options) {
  const FreeRunSearchResult found = run_search(model, records, options, options.max_iterations, {});
  set_unknowns(model, found.unknowns);
  for (const double offset : found.offsets)
    model.network.gates.front() += offset / static_cast<double>(found.offsets.size());
  open_ranges(model);
  find_ranges(model, records);
  return {found.converged, found.iterations, model.network.output_scale * found.rms};
}

FreeRunCost state_space_cost(const StateSpaceNetwork& model, const Records& records,
                             const StateSpaceTrainOptions& options,
                             const std::vector<double>& unknowns) {
  const FreeRunSearchResult at = run_search(model, records, options, 0, unknowns);
  return {at.cost, at.half_gradient};
}

double squares_left(const StateSpaceNetwork& model, const FreeRunRecord& record, bool offset) {
  double sum = 0, squares = 0, n = 0;
  run_cell(model.cell, nullptr, whole(record), 1, nullptr,
           [&](std::size_t k, const std::vector<double>& signals) {
             const double r = model.network.evaluate(signals.data()) - record.force[k];
             sum += r;
             squares += r * r;
             ++n;
           });
  return squares - (offset && n > 0 ? sum * sum / n : 0);
}

}  // namespace dashpot
