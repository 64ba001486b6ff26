#include "dashpot/damper/kinds/passive_network/presets.h"
#include "dashpot/damper/kinds/passive_network/train_passive_network.h"
#include "dashpot/damper/nets/mlp_evaluator.h"
#include "dashpot/damper/nets/train_batches.h"
#include "dashpot/error.h"
#include "rides.h"

using namespace dashpot;
using namespace peer;

namespace {

/// Seconds that the core takes for one multiplication and addition, when it does nothing else in
/// all its lanes: twelve chains hide that each link takes a few cycles. The fastest of a few runs.
#if defined(__x86_64__)
#define DASHPOT_CHAINS(lanes)                                                                \
  [] {                                                                                       \
    long count = 100000;                                                                     \
    asm volatile(                                                                            \
        "vzeroall\n1:\n.irp k, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11\n"                       \
        "vfmadd231ps %%" lanes "15, %%" lanes "15, %%" lanes "\\k\n.endr\ndec %0\njnz 1b\n"  \
        : "+r"(count)::"cc", "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6", "xmm7", \
          "xmm8", "xmm9", "xmm10", "xmm11", "xmm12", "xmm13", "xmm14", "xmm15");             \
  }
double seconds_per_lane(double lanes, void (*chains)()) {
  double best = HUGE_VAL;
  for (int run = 0; run < 20; ++run) best = std::min(best, time_of(1, chains));
  return best / (100000 * 12 * lanes);
}
double peak_float(SimdLevel level) {
  if (level == SimdLevel::Avx512) return seconds_per_lane(16, DASHPOT_CHAINS("zmm"));
  return level == SimdLevel::Avx2 ? seconds_per_lane(8, DASHPOT_CHAINS("ymm")) : 0;
}
#else
double peak_float(SimdLevel) { return 0; }
#endif

/// Seconds per sample of the training: the median of `epochs`.
double train_network(Mlp mlp, std::size_t batch, int epochs, SimdLevel level) {
  static const TrainingSamples samples = training_samples();
  std::vector<double> seconds;
  double start = cpu_seconds();
  BatchTrainOptions options{.batch = batch, .epochs = epochs, .level = level};
  options.on_epoch = [&](int, double) {
    seconds.push_back(cpu_seconds() - start);
    start = cpu_seconds();
  };
  train_batches(mlp, samples, options);
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 2] / kSamples;
}
double train_one_epoch(SimdLevel level) { return train_network(network(kRelu), kBatch, 11, level); }

/// Multiplications and additions per sample of a training by Adam, as bench/compare counts them.
double training_operations(const std::vector<std::size_t>& layers, std::size_t batch) {
  double weights = 0, neurons = 0;
  for (std::size_t l = 1; l < layers.size(); ++l) {
    weights += static_cast<double>(layers[l - 1] * layers[l]);
    neurons += static_cast<double>(layers[l]);
  }
  const double hidden = neurons - 1, first = static_cast<double>(layers[0] * layers[1]);
  const double forward = 2 * weights + neurons + hidden, by_weights = 2 * weights + neurons,
               by_activations = 2 * (weights - first) + hidden;
  return forward + by_weights + by_activations + 3 +
         12 * (weights + neurons) / static_cast<double>(batch);
}

/// Tables in Markdown: ns per sample and the share of the peak, over width, depth and batch.
void print_surface(SimdLevel level) {
  constexpr std::size_t kBatches[] = {1, 4, 10, 20, 60, 200};
  for (const std::size_t depth : {1, 2, 3, 5}) {
    std::printf("\n| hidden layers: %zu, of |", depth);
    for (const std::size_t batch : kBatches) std::printf(" batch %zu |", batch);
    std::printf("\n|---|%s\n", "---:|---:|---:|---:|---:|---:|");
    for (const std::size_t width : {8, 15, 16, 31, 32, 64, 128}) {
      std::vector<std::size_t> layers{8};
      layers.insert(layers.end(), depth, width);
      layers.push_back(1);
      Mlp mlp;
      mlp.layers = layers;
      mlp.activations.assign(depth, Activation::Relu);
      mlp.activations.push_back(Activation::Identity);
      mlp.input_mean.assign(8, 0.0);
      mlp.input_scale.assign(8, 1.0);
      initialise(mlp, 1);

      std::printf("| %zu neurons |", width);
      for (const std::size_t batch : kBatches) {
        const double seconds = train_network(mlp, batch, 3, level);
        const double floor = training_operations(layers, batch) / 2 * peak_float(level);
        std::printf(" %.0f ns, %.0f %% |", 1e9 * seconds, 100 * floor / seconds);
        std::fflush(stdout);
      }
      std::printf("\n");
    }
  }
}

template <class Real>
double latency(const std::vector<std::size_t>& layers) {
  const MlpEvaluator<Real> evaluator(network(layers));
  Real inputs[8] = {Real(0.1), Real(-0.2), Real(0.3), Real(0.1),
                    Real(0.5), Real(-0.1), Real(0.2), Real(0.7)};
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
    iterations =
        train(mlp, samples, {.max_iterations = 20, .tolerance = 0, .weight_decay = 0}).iterations;
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

/// The network that `dashpot identify` trains, at the start of its training; all scales are 1.
PassiveNetwork passive_start() {
  PassiveNetwork network;
  network.sizes = passive_network_presets().front().sizes;
  network.inert = true;
  network.displacement_scale = 1;
  network.model_step = 0.005;
  initialise(network, 1);
  return network;
}

/// A record that fills a window behind its run-in, so that all windows are alike.
FreeRunRecord passive_record(const PassiveTrainOptions& options, double step) {
  FreeRunRecord record;
  for (std::size_t k = 0; k < options.window - options.run_in; ++k) {
    const double time = static_cast<double>(k) * step, phase = 20 * time;
    record.inputs.push_back({std::sin(phase), std::cos(phase), 1 + 0.5 * std::sin(5 * time)});
    record.time.push_back(time);
    record.force.push_back(std::tanh(4 * std::cos(phase)) + 0.2 * std::sin(3 * phase));
  }
  return record;
}
constexpr std::size_t kPassiveUpdates = 20;

/// Seconds of an update: windows forward and back, and the step of all numbers.
double passive_training(int) {
  const PassiveTrainOptions options{.updates = kPassiveUpdates};
  PassiveNetwork network = passive_start();
  const FreeRunRecord record = passive_record(options, network.model_step);
  return time_of(1, [&] { train(network, {&record}, options); }) / kPassiveUpdates;
}

/// What passive_twin.py starts from: sizes; step, middle of the drive, mean square; numbers; a
/// window's displacement, velocity, drive and force.
void print_passive() {
  const PassiveTrainOptions options{.offsets = false};
  const PassiveNetwork network = passive_start();
  const FreeRunRecord record = passive_record(options, network.model_step);
  const double scored = static_cast<double>(options.windows * record.force.size());
  const PassiveSizes& z = network.sizes;
  std::printf("%zu %zu %zu %zu %zu\n%.9g %.9g %.9g\n", z.springs, z.memories, z.neurons,
              z.viscous_neurons, options.run_in, network.model_step,
              0.5 * (network.drive_low + network.drive_high),
              passive_cost(network, {&record}, options).cost / scored);
  for (const double number : network.numbers) std::printf("%.9g ", number);
  std::printf("\n");

  // Before a record its damper stands still.
  const auto line = [&](double stands, auto of) {
    for (std::size_t k = 0; k < options.run_in; ++k) std::printf("%.9g ", stands);
    for (std::size_t k = 0; k < record.force.size(); ++k) std::printf("%.9g ", of(k));
    std::printf("\n");
  };
  line(record.inputs[0].displacement, [&](std::size_t k) { return record.inputs[k].displacement; });
  line(0, [&](std::size_t k) { return record.inputs[k].velocity; });
  line(record.inputs[0].current, [&](std::size_t k) { return record.inputs[k].current; });
  line(record.force[0], [&](std::size_t k) { return record.force[k]; });
}

}  // namespace

int main(int count, char** arguments) {
  if (count > 1 && arguments[1] == std::string("simulate")) {
    std::map<std::string, Task> rides;
    add_own_rides(rides, false);
    return serve(rides);
  }
  if (count > 2 && arguments[1] == std::string("ride")) {
    print_ride(arguments[2] == std::string(kRides[0].task) ? Ride::Network : Ride::BoucWen);
    return 0;
  }
  if (count > 1 && arguments[1] == std::string("passive")) {
    print_passive();
    return 0;
  }
  if (count > 1 && arguments[1] == std::string("surface")) {
    print_surface(simd_levels().back());
    return 0;
  }
  const bool narrow = count > 1 && arguments[1] == std::string("avx2");
  const SimdLevel level = narrow ? SimdLevel::Avx2 : simd_levels().back();
  std::map<std::string, Task> tasks{{"peak", [level](int) { return peak_float(level); }},
                                    {"training", [level](int) { return train_one_epoch(level); }}};
  if (!narrow)
    tasks.insert({{"latency_relu", [](int) { return latency<float>(kRelu); }},
                  {"latency_tanh", [](int) { return latency<float>(kTanh); }},
                  {"batch_relu", [](int) { return batch(kRelu); }},
                  {"batch_tanh", [](int) { return batch(kTanh); }},
                  {"passive_training", passive_training},
                  {"fit_iteration", fit_iteration},
                  {"fit", fit}});
  if (!narrow) add_own_rides(tasks, true);
  return serve(tasks);
}
