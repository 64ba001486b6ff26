#include "dashpot/damper/nets/train_batches.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>

#include "dashpot/base/random.h"
#include "dashpot/damper/nets/flush_to_zero.h"
#include "dashpot/damper/nets/padded_network.h"
#include "dashpot/damper/nets/stopping.h"

namespace dashpot {
namespace {

/// One training: the samples as the kernel reads them, the network, and the moments of its
/// gradient.
template <class Real>
class BatchTrainer {
 public:
  BatchTrainer(const Mlp& mlp, const TrainingSamples& samples, const BatchTrainOptions& options)
      : options_(options),
        network_(mlp, options.batch, options.level),
        mean_(network_.size()),
        square_(network_.size()),
        residuals_(options.batch),
        random_(options.seed) {
    // Standardise once, with the 1 that biases meet behind each row, so that a batch is copies of
    // whole rows.
    const std::size_t count = samples.targets.size(), inputs = network_.inputs(),
                      step = network_.input_step();
    inputs_.resize(count * step);
    for (std::size_t s = 0; s < count; ++s) {
      for (std::size_t k = 0; k < inputs; ++k)
        inputs_[s * step + k] = static_cast<Real>(
            (samples.inputs[s * inputs + k] - mlp.input_mean[k]) / mlp.input_scale[k]);
      inputs_[s * step + inputs] = 1;
      targets_.push_back(
          static_cast<Real>((samples.targets[s] - mlp.output_mean) / mlp.output_scale));
    }

    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0U);
  }

  /// Goes over all samples once, in a new order; returns the mean squared error met on the way.
  double run_epoch(int epoch) {
    const std::size_t count = order_.size();
    shuffle();
    double squares = 0;
    for (std::size_t first = 0; first < count; first += options_.batch) {
      const std::size_t size = std::min(options_.batch, count - first);
      squares += learn(first, size);
      network_.update(rule(epoch + static_cast<double>(first) / static_cast<double>(count)), mean_,
                      square_);
    }
    return squares / static_cast<double>(count);
  }

  void get_parameters(std::vector<double>& parameters) const {
    network_.get_parameters(parameters);
  }

 private:
  /// A new order; the halves of each random word make two exchanges.
  void shuffle() {
    std::uint64_t word = random_.next();
    for (std::size_t k = order_.size(); k > 1; --k) {
      word = k % 2 ? word >> 32 : random_.next();
      std::swap(order_[k - 1], order_[(word & 0xffffffff) * k >> 32]);
    }
  }

  /// The gradient of one batch; returns its sum of squares.
  double learn(std::size_t first, std::size_t size) {
    // Gather the batch.
    const std::uint32_t* const samples = &order_[first];
    const std::size_t step = network_.input_step();
    for (std::size_t s = 0; s < size; ++s) {
      for (std::size_t k = 0; k < step; k += padded<Real>(1))  // by whole cache lines
        std::memcpy(network_.input(s) + k, &inputs_[samples[s] * step + k], kKernelAlign);
      // Samples lie all over the memory: one of the next batch may come nearer meanwhile.
      const std::uint32_t next = order_[std::min(first + size + s, order_.size() - 1)];
      __builtin_prefetch(&inputs_[next * step]);
      __builtin_prefetch(&targets_[next]);
    }

    network_.forward(size);

    // Slope of the mean squared error by each output.
    const Real* output = network_.output(0);
    Real* slope = network_.output_slope(0);
    const Real share = Real{2} / static_cast<Real>(size);
    Real* residual = residuals_.data();
    for (std::size_t s = 0; s < size; ++s) residual[s] = output[s] - targets_[samples[s]];
    for (std::size_t s = 0; s < size; ++s) slope[s] = share * residual[s];

    network_.backward(size);
    return std::inner_product(residual, residual + size, residual, Real{0});
  }

  UpdateRule<Real> rule(double epoch) {
    const double rate = options_.rate * options_.schedule.share(epoch, options_.epochs);

    // Adam's averages start at zero: divide by how much of them has filled up, in rate and epsilon.
    double corrected = rate, decay = 0;
    // Above 0, or padded lanes, which have no gradient, would step by 0 / 0.
    double epsilon = std::max(options_.epsilon, 1e-30);
    if (options_.optimiser == Optimiser::Adam || options_.optimiser == Optimiser::AdamW) {
      momentum_power_ *= options_.momentum;
      square_power_ *= options_.mean_square;
      const double root = std::sqrt(1 - square_power_);
      corrected = rate * root / (1 - momentum_power_);
      epsilon *= root;
    }

    if (options_.optimiser == Optimiser::AdamW) decay = rate * options_.decay;
    const auto real = [](double value) { return static_cast<Real>(value); };
    return {
        options_.optimiser,         real(corrected),   real(epsilon),     real(options_.momentum),
        real(options_.mean_square), real(options_.l1), real(options_.l2), real(decay)};
  }

  const BatchTrainOptions& options_;
  PaddedNetwork<Real> network_;
  AlignedVector<Real> mean_, square_, inputs_, residuals_;
  std::vector<Real> targets_;
  std::vector<std::uint32_t> order_;
  Random random_;
  double momentum_power_ = 1, square_power_ = 1;
};

template <class Real>
TrainReport run(Mlp& mlp, const TrainingSamples& samples, const BatchTrainOptions& options) {
  const FlushToZero flush;
  BatchTrainer<Real> trainer(mlp, samples, options);
  EarlyStopping stopping(mlp, options.stopping);
  TrainReport report;
  while (!report.stopped_early && report.iterations < options.epochs) {
    const double error = trainer.run_epoch(report.iterations++);
    trainer.get_parameters(mlp.parameters);
    report.stopped_early = stopping.judge(mlp.parameters);
    if (options.on_epoch) options.on_epoch(report.iterations, mlp.output_scale * std::sqrt(error));
  }
  stopping.finish(mlp, report);
  return report;
}

}  // namespace

double Schedule::share(double epoch, double epochs) const {
  if (epoch < warm_up) return epoch / warm_up;
  const double since = epoch - warm_up;
  if (kind == RateSchedule::Step) return std::pow(step_factor, std::floor(since / step_epochs));
  if (kind == RateSchedule::Cosine) {
    const double done = std::min(1.0, since / (epochs - warm_up));
    return final_share + (1 - final_share) * 0.5 * (1 + std::cos(std::numbers::pi * done));
  }
  return 1;
}

TrainReport train_batches(Mlp& mlp, const TrainingSamples& samples,
                          const BatchTrainOptions& options) {
  assert(samples.group.empty() && options.batch > 0 && mlp.layers.back() == 1);
  assert(!samples.targets.empty() &&
         samples.inputs.size() == samples.targets.size() * mlp.layers.front());
  if (mlp.parameters.empty()) initialise(mlp, options.seed);
  TrainReport report = options.single_precision ? run<float>(mlp, samples, options)
                                                : run<double>(mlp, samples, options);
  const SampleBlocks blocks = make_blocks(mlp, samples, 0);
  const double squares = BlockErrors(mlp, blocks, 1, options.level).squared_error(mlp.parameters);
  report.rmse = mlp.output_scale * std::sqrt(squares / static_cast<double>(blocks.samples));
  return report;
}

}  // namespace dashpot
