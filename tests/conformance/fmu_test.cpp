#include <algorithm>
#include <set>

#include "dashpot/base/parallel.h"
#include "dashpot/export/export_run.h"
#include "export/fmu_importer.h"

using namespace dashpot;

namespace {

constexpr double kFmuStep = 1e-3;
constexpr std::size_t kFmuSteps = 200;

double span_of(const std::vector<double>& force) {
  const auto [low, high] = std::minmax_element(force.begin(), force.end());
  return *high - *low;
}

/// Sets the inputs of each instant, then reads the force there.
void check_co_simulation(const LoadedFmu& fmu, const DamperModel& model) {
  const double step = model.feedback_step() > 0 ? model.feedback_step() : kFmuStep;
  const std::vector<DamperInput> run = export_run(exported(model).domain, step, kFmuSteps);
  const std::vector<double> expected = force_along(model, run, step);
  const double tolerance = 1e-12 * span_of(expected);
  FmuInstance instance(fmu, false);
  REQUIRE(instance.handle);
  instance.initialize(run[0]);
  CHECK_CLOSE(instance.get("f"), expected[0], 0, tolerance);
  for (std::size_t k = 1; k < run.size(); ++k) {
    REQUIRE(instance.step(static_cast<double>(k - 1) * step, step) == 0);
    REQUIRE(instance.set(run[k]) == 0);
    CHECK_CLOSE(instance.get("f"), expected[k], 0, tolerance);
  }
  CHECK(instance.messages.empty());
}

/// What the equations give at a state: the law's own derivative, behind the coil's lag.
std::vector<double> slopes(const LawModel& law, const DamperInput& input,
                           const std::vector<double>& state) {
  std::vector<double> p(law.law().params.size()), slope(state.size());
  law.parameters_at(law.coil_current(input, state), p.data());
  if (law.law().derivative)
    law.law().derivative(p.data(), input.displacement, input.velocity, state.data(), slope.data());
  if (law.lag_rate() > 0) slope.back() = law.lag_rate() * (input.current - state.back());
  return slope;
}

/// Sets the library's states and compares force and slopes there.
void check_model_exchange(const LoadedFmu& fmu, const DamperModel& model) {
  const auto* law = dynamic_cast<const LawModel*>(&model);
  const std::vector<DamperInput> run = export_run(exported(model).domain, kFmuStep, kFmuSteps);
  const double span = span_of(force_along(model, run, kFmuStep));
  FmuInstance instance(fmu, true);
  REQUIRE(instance.handle);
  instance.initialize(run[0]);
  CHECK(fmu.call("EnterContinuousTimeMode", instance.handle) == 0);
  std::vector<double> state(model.state_size()), read(state.size()), slope(state.size());
  model.rest(run[0], state);
  CHECK(fmu.call("GetContinuousStates", instance.handle, read.data(), read.size()) == 0);
  for (std::size_t i = 0; i < state.size(); ++i) CHECK_CLOSE(read[i], state[i], 1e-12, 0);
  for (std::size_t k = 1; k < run.size(); ++k) {
    model.advance(run[k - 1], run[k], kFmuStep, state);
    REQUIRE(fmu.call("SetTime", instance.handle, static_cast<double>(k) * kFmuStep) == 0);
    REQUIRE(instance.set(run[k]) == 0);
    REQUIRE(fmu.call("SetContinuousStates", instance.handle,
                     static_cast<const double*>(state.data()), state.size()) == 0);
    CHECK_CLOSE(instance.get("f"), model.force(run[k], state), 0, 1e-12 * span);
    REQUIRE(fmu.call(fmu.version == 2 ? "GetDerivatives" : "GetContinuousStateDerivatives",
                     instance.handle, slope.data(), slope.size()) == 0);
    if (!law) continue;
    const std::vector<double> expected = slopes(*law, run[k], state);
    // Differences of large terms: 1e-12 of what goes into them.
    for (std::size_t i = 0; i < slope.size(); ++i) CHECK_CLOSE(slope[i], expected[i], 1e-10, 1e-12);
  }
  CHECK(instance.messages.empty());
}

}  // namespace

TEST_CASE(
    "FMUs of every kind of model give the library's numbers in co-simulation and model exchange" *
    doctest::test_suite("long")) {
  if (!has_compiler()) return;
  const std::vector<ExampleModel> models = example_models();
  // One of each kind, a law as both, and every sixth model as FMI 3 or FMI 2 in turn: models of a
  // kind differ in their C alone, which is run for each without an FMU.
  struct Task {
    const ExampleModel* example;
    int version;
    std::string archive;
  };
  std::vector<Task> tasks;
  std::set<ModelKind> kinds;
  for (std::size_t k = 0; k < models.size(); ++k) {
    const bool first = kinds.insert(models[k].model->kind()).second;
    for (const int version : {2, 3})
      if ((first && (k == 0 || version == static_cast<int>(2 + kinds.size() % 2))) ||
          k % 12 == (version == 2 ? 0 : 6))
        tasks.push_back({&models[k], version, {}});
  }
  parallel_for(tasks.size(), 0, [&](std::size_t k) {
    ExportOptions options{.sample_time = tasks[k].example->model->feedback_step()};
    if (options.sample_time == 0) options.sample_time = kFmuStep;
    tasks[k].archive = fmu_of(exported(*tasks[k].example->model), tasks[k].version, options);
  });
  for (const Task& task : tasks) {
    CAPTURE(task.example->name);
    CAPTURE(task.version);
    const LoadedFmu fmu(task.archive);
    check_co_simulation(fmu, *task.example->model);
    const ModelKind kind = task.example->model->kind();
    CHECK(fmu.exchanges() == (kind == ModelKind::Law || task.example->model->state_size() == 0));
    if (fmu.exchanges()) check_model_exchange(fmu, *task.example->model);
  }
}
