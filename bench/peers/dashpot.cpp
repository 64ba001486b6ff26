#include "dashpot/base/error.h"
#include "dashpot/damper/neural/mlp_evaluator.h"
#include "dashpot/damper/neural/train_batches.h"
#include "peer.h"

using namespace dashpot;
using namespace peer;

namespace {

double train_one_epoch(SimdLevel level) {
  static const TrainingSamples samples = training_samples();
  Mlp mlp = network(kRelu);
  std::vector<double> seconds;
  double start = cpu_seconds();
  BatchTrainOptions options{.batch = kBatch, .epochs = 11, .level = level};
  options.on_epoch = [&](int, double) {
    seconds.push_back(cpu_seconds() - start);
    start = cpu_seconds();
  };
  train_batches(mlp, samples, options);
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 2] / kSamples;
}

template <class Real>
double latency(const std::vector<std::size_t>& layers) {
  const MlpEvaluator<Real> evaluator(network(layers));
  Real inputs[8] = {Real(0.1), Real(-0.2), Real(0.3), Real(0.1), Real(0.5), Real(-0.1), Real(0.2), Real(0.7)};
  return time_of(20000, [&] { inputs[0] = Real(0.1) * evaluator.evaluate(inputs); });
}

double batch(const std::vector<std::size_t>& layers) {
  const MlpEvaluator<float> evaluator(network(layers));
  const std::vector<float> inputs(kMany * layers.front(), 0.3F);
  std::vector<float> outputs(kMany);
  return time_of(20, [&] { evaluator.evaluate(inputs, outputs); }) / kMany;
}

double fit_iteration(int round) {
  static const TrainingSamples samples = fit_samples();
  Mlp mlp = network(kTanh, static_cast<std::uint64_t>(round));
  int iterations = 0;
  const double seconds = time_of(1, [&] {
    iterations = train(mlp, samples, {.max_iterations = 20, .tolerance = 0, .weight_decay = 0}).iterations;
  });
  return seconds / iterations;
}

/// Seconds until the error is good enough, from a start of its own each round.
double fit(int round) {
  static const TrainingSamples samples = fit_samples();
  Mlp mlp = network(kTanh, static_cast<std::uint64_t>(round));
  TrainOptions options{.max_iterations = 500, .tolerance = 0, .weight_decay = 0};
  bool reached = false;
  options.on_iteration = [&](int, double rmse) {
    reached = rmse <= kGoodEnough;
    if (reached) throw Interrupted();
  };
  const double start = cpu_seconds();
  try {
    train(mlp, samples, options);
  } catch (const Interrupted&) {
  }
  return reached ? cpu_seconds() - start : HUGE_VAL;
}

}  // namespace

int main(int count, char** arguments) {
  const std::string wanted = count > 1 ? arguments[1] : "";
  if (wanted == "avx2") return serve({{"training", [](int) { return train_one_epoch(SimdLevel::Avx2); }}});
  return serve({{"training", [](int) { return train_one_epoch(simd_levels().back()); }},
                {"latency_relu", [](int) { return latency<float>(kRelu); }},
                {"latency_tanh", [](int) { return latency<float>(kTanh); }},
                {"batch_relu", [](int) { return batch(kRelu); }},
                {"batch_tanh", [](int) { return batch(kTanh); }},
                {"fit_iteration", fit_iteration},
                {"fit", fit}});
}
