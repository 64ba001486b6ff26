// What DamperModel.predict() stands beside: the same free run in C++. predict MODEL.json SAMPLES
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/model_file.h"
#include "dashpot/identify/evaluate.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const dashpot::ModelFile file = dashpot::load_model(argv[1]);
  const auto samples = static_cast<std::size_t>(std::atol(argv[2]));
  std::vector<dashpot::DamperInput> inputs(samples);
  std::vector<double> time(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    const double phase = 0.01 * static_cast<double>(k);
    time[k] = 0.001 * static_cast<double>(k);
    inputs[k] = {0.02 * std::sin(phase), 0.2 * std::cos(phase), 1};
  }
  double best = INFINITY;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const double begin = dashpot::cpu_seconds();
    const dashpot::FreeRun run = dashpot::free_run(*file.model, inputs, time);
    best = std::min(best, dashpot::cpu_seconds() - begin);
    if (run.diverged_at) return 3;
  }
  std::printf("%.9g\n", best);
}
