#include "dashpot/damper/nets/train_lbfgs.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/nets/padded_network.h"
#include "dashpot/damper/nets/stopping.h"
#include "dashpot/numerics/minimise.h"

namespace dashpot {
namespace {

constexpr std::size_t kSampleStretches = 8;  // of samples: as many threads can share the work
constexpr std::size_t kPass = 64;            // samples that go through the network together

/// Cost and gradient over all samples: sums over fixed stretches, then over those, so that they do
/// not depend on the number of threads.
class FullBatch {
 public:
  FullBatch(const Mlp& mlp, const TrainingSamples& samples, const LbfgsOptions& options)
      : mlp_(mlp),
        samples_(samples),
        options_(options),
        blocks_(make_blocks(mlp, samples, options.offset_decay)),
        errors_(mlp, blocks_, options.threads, options.level),
        sums_(kSampleStretches) {
    for (std::size_t k = 0; k < kSampleStretches; ++k)
      networks_.push_back(std::make_unique<PaddedNetwork<double>>(mlp, kPass, options.level));
  }

  bool evaluate(std::span<const double> w, double& cost, std::span<double> gradient) {
    // The best offsets at these weights: the gradient with them held is that of the cost at its
    // least over them.
    const std::size_t count = samples_.targets.size();
    if (!samples_.group.empty()) offsets_ = errors_.errors(w).offsets;

    parallel_for(kSampleStretches, options_.threads, [&](std::size_t k) {
      networks_[k]->set_parameters(w);
      sums_[k].squares = 0;
      sums_[k].gradient.assign(w.size(), 0.0);
      const std::size_t end = (k + 1) * count / kSampleStretches;
      for (std::size_t first = k * count / kSampleStretches; first < end; first += kPass)
        add(*networks_[k], first, std::min(kPass, end - first), sums_[k]);
    });

    // Add the stretches up in their order.
    double squares = 0;
    for (const Sums& sums : sums_) squares += sums.squares;
    for (std::size_t g = 0; g < offsets_.size(); ++g)
      squares += blocks_.offset_penalty(blocks_.groups[g], offsets_[g]);

    // Mean over the samples, and weight decay.
    cost = squares / static_cast<double>(count);
    for (std::size_t p = 0; p < w.size(); ++p) {
      gradient[p] = 2 * options_.weight_decay * w[p];
      cost += options_.weight_decay * w[p] * w[p];
      for (const Sums& sums : sums_) gradient[p] += sums.gradient[p];
    }
    return true;
  }

  GroupedErrors errors(std::span<const double> w) const { return errors_.errors(w); }
  /// Raw units, offsets removed.
  double rmse(std::span<const double> w) const {
    const GroupedErrors now = errors(w);
    return mlp_.output_scale * std::sqrt(mean_square(now.squared_error, now.offsets, blocks_));
  }

 private:
  struct Sums {
    double squares = 0;
    std::vector<double> gradient, pass;
  };

  void add(PaddedNetwork<double>& network, std::size_t first, std::size_t size, Sums& sums) const {
    const std::size_t inputs = network.inputs();
    for (std::size_t s = 0; s < size; ++s)
      for (std::size_t k = 0; k < inputs; ++k)
        network.input(s)[k] =
            (samples_.inputs[(first + s) * inputs + k] - mlp_.input_mean[k]) / mlp_.input_scale[k];

    network.forward(size);
    const double share = 2 / static_cast<double>(samples_.targets.size());
    for (std::size_t s = 0; s < size; ++s) {
      const double target = (samples_.targets[first + s] - mlp_.output_mean) / mlp_.output_scale;
      const double offset = offsets_.empty() ? 0 : offsets_[samples_.group[first + s]];
      const double residual = network.output(0)[s] + offset - target;
      sums.squares += residual * residual;
      network.output_slope(0)[s] = share * residual;
    }

    network.backward(size);
    sums.pass.resize(sums.gradient.size());
    network.get_gradient(sums.pass);
    for (std::size_t p = 0; p < sums.pass.size(); ++p) sums.gradient[p] += sums.pass[p];
  }

  const Mlp& mlp_;
  const TrainingSamples& samples_;
  const LbfgsOptions& options_;
  const SampleBlocks blocks_;
  const BlockErrors errors_;
  std::vector<double> offsets_;  // at the parameters in work: where the cost is least over them,
                                 // its slope is that at fixed ones
  std::vector<std::unique_ptr<PaddedNetwork<double>>> networks_;
  std::vector<Sums> sums_;
};

}  // namespace

TrainReport train_lbfgs(Mlp& mlp, const TrainingSamples& samples, const LbfgsOptions& options) {
  assert(mlp.layers.back() == 1 && !samples.targets.empty());
  if (mlp.parameters.empty()) initialise(mlp, options.seed);
  FullBatch batch(mlp, samples, options);
  EarlyStopping stopping(mlp, options.stopping, options.offset_decay);

  TrainReport report;
  MinimiseOptions how{.max_iterations = options.max_iterations,
                      .function_tolerance = options.tolerance};
  how.on_iteration = [&](int iteration, double, std::span<const double> w) {
    if (options.on_iteration) options.on_iteration(iteration, batch.rmse(w));
    report.stopped_early = stopping.judge(w);
    return !report.stopped_early;
  };

  const MinimiseReport found =
      minimise([&](std::span<const double> w, double& cost,
                   std::span<double> gradient) { return batch.evaluate(w, cost, gradient); },
               mlp.parameters, how);

  mlp.parameters = found.x;
  stopping.finish(mlp, report);
  report.converged = found.converged && !report.stopped_early;
  report.iterations = found.iterations;
  report.rmse = batch.rmse(mlp.parameters);
  report.weight_decay = options.weight_decay;
  if (!samples.group.empty())
    report.offsets = take_mean_offset(mlp, batch.errors(mlp.parameters).offsets);
  return report;
}

}  // namespace dashpot
