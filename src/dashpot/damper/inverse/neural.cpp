#include "dashpot/damper/inverse/neural.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/error.h"
#include "dashpot/damper/inverse/observer.h"
#include "dashpot/damper/inverse/random_signal.h"

namespace dashpot {
namespace {

constexpr std::size_t kCurrent = 3;  // in a row of the state: x, v, F, i

/// Mean and standard deviation of every `stride`th value from `first` on; a constant gets the scale 1.
std::pair<double, double> moments(const std::vector<double>& values, std::size_t first, std::size_t stride) {
  double sum = 0, squares = 0, count = 0;
  for (std::size_t k = first; k < values.size(); k += stride, ++count) sum += values[k];
  const double mean = sum / count;
  for (std::size_t k = first; k < values.size(); k += stride)
    squares += (values[k] - mean) * (values[k] - mean);
  const double scale = std::sqrt(squares / count);
  return {mean, scale > 0 ? scale : 1};
}

}  // namespace

NeuralInverse::NeuralInverse(std::string name, const DamperModel& forward, const InverseLimits& limits,
                             const NeuralOptions& options)
    : InverseModel(limits), name_(std::move(name)) {
  spacing_ =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(options.spacing / limits.sample_time)));
  for (const Tap& tap : options.taps) {
    const bool is_current = tap.signal == Tap::Signal::Current;
    if (tap.delay < (is_current ? 1 : 0)) throw Error(name_, "an input would be its own answer or lie ahead");
    const std::size_t row = static_cast<std::size_t>(tap.delay) * spacing_;
    places_.push_back(row * kSignals + static_cast<std::size_t>(tap.signal));
    rows_ = std::max(rows_, row + 1);
  }
  if (places_.empty() || places_.size() > Mlp::kMaxWidth || options.samples < 10)
    throw Error(name_, "needs at least one input and ten samples");

  const TrainingSamples samples = record(*without_coil_lag(forward).model, options);
  mlp_.layers = {places_.size(), options.hidden, 1};
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const auto [mean, scale] = moments(samples.inputs, k, places_.size());
    mlp_.input_mean.push_back(mean);
    mlp_.input_scale.push_back(scale);
  }
  std::tie(mlp_.output_mean, mlp_.output_scale) = moments(samples.targets, 0, 1);
  TrainOptions train_options;
  train_options.max_iterations = options.iterations;
  train_options.seed = options.seed;
  training_rmse_ = train(mlp_, samples, train_options).rmse;
}

/// The model under a random motion and current, each sample as the inverse would have met it.
TrainingSamples NeuralInverse::record(const DamperModel& bare, const NeuralOptions& options) const {
  Random random(options.seed);
  const RandomSignal motion(random, 0, options.motion_band), drive(random, 0, options.current_band);
  const double h = limits().sample_time, sigma = options.amplitude / 2;
  const double half = 0.5 * (limits().current_max - limits().current_min);
  const auto at = [&](std::size_t k) {
    const double t = static_cast<double>(k) * h;
    return DamperInput{sigma * motion.at(t), sigma * motion.derivative(t),
                       clamped(limits().current_min + half * (1 + 0.7 * drive.at(t)))};
  };
  std::vector<double> z(bare.state_size()), line(state_size()), inputs(places_.size());
  DamperInput now = at(0);
  bare.rest(now, z);
  rest(now, line);
  TrainingSamples samples;
  for (std::size_t k = 1; samples.targets.size() < options.samples; ++k) {
    const DamperInput next = at(k);
    // The current jumps at a sample and is then held.
    bare.advance(now, {next.displacement, next.velocity, now.current}, h, z);
    now = next;
    const double force = bare.force(now, z);
    push(std::array{now.displacement, now.velocity, force, now.current}.data(), line);
    if (!std::isfinite(force)) throw Error(name_, bare.name() + " diverges on the training motion");
    if (k < rows_ || k % spacing_ != 0) continue;
    gather(line, inputs.data());
    samples.inputs.insert(samples.inputs.end(), inputs.begin(), inputs.end());
    samples.targets.push_back(now.current);
  }
  return samples;
}

void NeuralInverse::rest(const DamperInput& input, std::span<double> state) const noexcept {
  for (std::size_t k = 0; k < rows_; ++k)
    push(std::array{input.displacement, 0.0, 0.0, input.current}.data(), state);
}

void NeuralInverse::push(const double* row, std::span<double> state) const noexcept {
  std::copy_backward(state.begin(), state.end() - kSignals, state.end());
  std::copy_n(row, kSignals, state.begin());
}

void NeuralInverse::gather(std::span<const double> state, double* inputs) const noexcept {
  for (std::size_t k = 0; k < places_.size(); ++k) inputs[k] = state[places_[k]];
}

double NeuralInverse::wanted_current(const InverseInput& input, std::span<double> state) const noexcept {
  push(std::array{input.displacement, input.velocity, input.wanted, input.current}.data(), state);
  std::array<double, Mlp::kMaxWidth> inputs;
  gather(state, inputs.data());
  const double current = clamped(mlp_.evaluate(inputs.data()));
  state[kCurrent] = current;
  return current;
}

}  // namespace dashpot
