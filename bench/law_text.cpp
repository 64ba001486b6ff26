// What laws from files cost beside Dashpot's own ones with the same equations: what
// docs/laws-from-a-file.md prints. law_text EXAMPLES (the folder examples/laws)
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/law/law_text.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/evaluate.h"
#include "dashpot/identify.h"

namespace {

using namespace dashpot;

LawModel example(const Law& law) {
  std::vector<double> values;
  for (const ParamInfo& row : law.params) values.push_back(row.value);
  return LawModel::constant(law, values);
}

/// Least CPU nanoseconds per sample of a free run over 100 s at 1 kHz.
double nanoseconds(const LawModel& model) {
  constexpr std::size_t kSamples = 100000;
  std::vector<DamperInput> inputs(kSamples);
  std::vector<double> time(kSamples);
  for (std::size_t k = 0; k < kSamples; ++k) {
    time[k] = 1e-3 * static_cast<double>(k);
    const double phase = 2 * std::numbers::pi * 2 * time[k];
    inputs[k] = {0.01 * std::sin(phase), 0.04 * std::numbers::pi * std::cos(phase), 1};
  }
  double least = INFINITY;
  for (int repeat = 0; repeat < 9; ++repeat) {
    const double begin = cpu_seconds();
    if (free_run(model, inputs, time).diverged_at) return NAN;
    least = std::min(least, (cpu_seconds() - begin) * 1e9 / static_cast<double>(kSamples));
  }
  return least;
}

void print_runs(const char* what, const LawModel& own, const LawModel& mine) {
  const double a = nanoseconds(own), b = nanoseconds(mine);
  std::printf("| %s | %.0f | %.0f | %.2f |\n", what, a, b, b / a);
}

double fit_seconds(const std::string& model, const Dataset& dataset) {
  IdentifyOptions options;
  options.threads = 1;
  options.allow_active = true;
  double least = INFINITY;
  for (int repeat = 0; repeat < 3; ++repeat)
    least = std::min(least, identify(model, dataset.records, dataset.drive_unit, options).seconds);
  return least;
}

void print_fits(const std::string& own, const std::string& mine, const Dataset& dataset) {
  const double a = fit_seconds(own, dataset), b = fit_seconds(mine, dataset);
  std::printf("| `%s` | %.3f | %.3f | %.2f |\n", own.c_str(), a, b, b / a);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  const Law& bouc_wen = know_law(folder / "my_bouc_wen.yaml");
  const Law& tanh = know_law(folder / "my_tanh.yaml");
  const Law& filter = know_law(folder / "my_filter.yaml");

  // Both Bouc-Wen laws by steps of Runge-Kutta: without their closed form.
  Law by_steps = find_law("bouc_wen");
  by_steps.step = nullptr;
  by_steps.exact_step = false;
  Value definition = Value::object();
  for (const auto& [key, value] : bouc_wen.text->definition().members())
    if (!key.starts_with("travel")) definition.add(key, value);
  const auto mine_by_steps = LawText::make(definition);

  std::printf("| free run, ns a sample | own | from a file | ratio |\n|---|---|---|---|\n");
  print_runs("`bouc_wen`, closed form", example(find_law("bouc_wen")), example(bouc_wen));
  print_runs("`bouc_wen`, Runge-Kutta", example(by_steps), example(mine_by_steps->law()));
  print_runs("`bouc_wen`, closed form beside steps of a file", example(find_law("bouc_wen")),
             example(mine_by_steps->law()));
  print_runs("`tanh_acceleration`, a filter", example(find_law("tanh_acceleration")),
             example(filter));
  print_runs("`tanh_kwok`, no state", example(find_law("tanh_kwok")), example(tanh));

  const LawModel damper = load_parameters("spencer1997_bouc_wen");
  const Dataset dataset = run_virtual_bench(damper, damper.drive_unit(), {});
  std::printf("\n| identify, s on one core | own | from a file | ratio |\n|---|---|---|---|\n");
  print_fits("bouc_wen", "my_bouc_wen", dataset);
  print_fits("tanh_acceleration", "my_filter", dataset);
  print_fits("tanh_kwok", "my_tanh", dataset);
  return 0;
}
