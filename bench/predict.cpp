// What DamperModel.predict() stands beside, in C++: dashpot_run on the same rows, and free_run on
// inputs that are gathered and trusted. predict MODEL.json SAMPLES
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "dashpot.h"
#include "dashpot/base/parallel.h"
#include "dashpot/evaluate.h"
#include "dashpot/model_file.h"

namespace {

template <class Code>
double least_seconds(Code code) {
  double least = INFINITY;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const double begin = dashpot::cpu_seconds();
    if (!code()) std::exit(3);
    least = std::min(least, dashpot::cpu_seconds() - begin);
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const dashpot::ModelFile file = dashpot::load_model(argv[1]);
  const auto samples = static_cast<std::size_t>(std::atol(argv[2]));
  struct Row {
    double time;
    dashpot::DamperInput input;
  };
  std::vector<Row> rows(samples);
  std::vector<dashpot::DamperInput> inputs(samples);
  std::vector<double> time(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    const double phase = 0.01 * static_cast<double>(k);
    time[k] = 0.001 * static_cast<double>(k);
    inputs[k] = {0.02 * std::sin(phase), 0.2 * std::cos(phase), 1};
    rows[k] = {time[k], inputs[k]};
  }
  dashpot_model* model = nullptr;
  if (dashpot_model_load(argv[1], &model) != DASHPOT_OK) return 3;
  constexpr std::ptrdiff_t kStride = sizeof(Row) / sizeof(double);
  dashpot_motion motion = {samples, 0, {&rows[0].time, kStride}, {}, {}, {}};
  motion.displacement = {&rows[0].input.displacement, kStride};
  motion.velocity = {&rows[0].input.velocity, kStride};
  motion.current = {&rows[0].input.current, kStride};
  const double from_rows = least_seconds([&] {
    const auto force = std::make_unique_for_overwrite<double[]>(samples);
    const dashpot_response response = {force.get(), nullptr, nullptr, 0};
    return dashpot_run(model, &motion, &response) == DASHPOT_OK;
  });
  const double gathered =
      least_seconds([&] { return !dashpot::free_run(*file.model, inputs, time).diverged_at; });
  dashpot_model_free(&model);
  std::printf("%.9g %.9g\n", from_rows, gathered);
}
