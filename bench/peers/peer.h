#pragma once
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <iostream>
#include <malloc.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "dashpot/base/random.h"
#include "dashpot/damper/nets/mlp.h"

// What every peer is: a program that names its tasks on its first line, then answers each line "TASK ROUND"
// with the CPU seconds per unit of work. So that bench/compare can let them take turns.
namespace peer {

using Task = std::function<double(int round)>;

/// The memory of one round serves the next: what the system hands out anew costs time of its own, on a
/// virtual machine as much as some tasks.
inline void keep_memory() {
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
}

inline int serve(const std::map<std::string, Task>& tasks) {
  keep_memory();
  for (const auto& [name, task] : tasks) std::cout << name << ' ';
  std::cout << std::endl;
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string name;
    int round = 0;
    words >> name >> round;
    std::cout << tasks.at(name)(round) << std::endl;
  }
  return 0;
}

inline double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// CPU seconds of one of `count` runs.
template <class Run>
double time_of(int count, Run run) {
  const double start = cpu_seconds();
  for (int k = 0; k < count; ++k) run();
  return (cpu_seconds() - start) / count;
}

constexpr std::size_t kSamples = 13332, kBatch = 20, kMany = 4096;
const std::vector<std::size_t> kRelu{8, 15, 15, 15, 1}, kTanh{2, 10, 1};

/// A network of ReLU or, with two inputs, of tanh neurons; units are standardised already.
inline dashpot::Mlp network(const std::vector<std::size_t>& layers, std::uint64_t seed = 1) {
  dashpot::Mlp mlp;
  mlp.layers = layers;
  if (layers == kRelu)
    mlp.activations = {dashpot::Activation::Relu, dashpot::Activation::Relu, dashpot::Activation::Relu,
                       dashpot::Activation::Identity};
  mlp.input_mean.assign(layers.front(), 0.0);
  mlp.input_scale.assign(layers.front(), 1.0);
  initialise(mlp, seed);
  return mlp;
}

/// Samples for the training of kRelu.
inline dashpot::TrainingSamples training_samples() {
  dashpot::TrainingSamples samples;
  dashpot::Random random(1);
  for (std::size_t s = 0; s < kSamples; ++s) {
    double target = 0;
    for (int k = 1; k <= 8; ++k) {
      samples.inputs.push_back(random.uniform(-1.7, 1.7));
      target += std::sin(k * samples.inputs.back()) / 2;
    }
    samples.targets.push_back(target);
  }
  return samples;
}

/// Samples for the least squares fit of kTanh: a damper's curve, standardised, with noise of 0.02.
constexpr double kNoise = 0.02, kGoodEnough = 1.05 * kNoise;  // root mean squares
inline dashpot::TrainingSamples fit_samples() {
  dashpot::TrainingSamples samples;
  dashpot::Random random(2);
  for (int s = 0; s < 10000; ++s) {
    const double v = random.uniform(-1.7, 1.7), i = random.uniform(-1.7, 1.7);
    samples.inputs.insert(samples.inputs.end(), {v, i});
    samples.targets.push_back((0.8 + 0.4 * i) * std::tanh(4 * v) + 0.2 * v + kNoise * random.normal());
  }
  return samples;
}

}  // namespace peer
