#include "runtime.h"

#include <algorithm>

#include "dashpot/export/export_run.h"
#include "dashpot/export/onnx/onnx.h"
#include "export/example_models.h"

using namespace dashpot;

namespace {

constexpr std::size_t kSteps = 100;

/// A run and the library's force along it.
RuntimeCheck::Run run_of(const DamperModel& model, const std::vector<DamperInput>& inputs,
                         double sample_time) {
  RuntimeCheck::Run run;
  for (const DamperInput& input : inputs)
    run.inputs.push_back({input.displacement, input.velocity, input.current});
  for (const double force : force_along(model, inputs, sample_time)) run.answers.push_back({force});
  return run;
}

/// The graphs of a model, and what the library says of three runs.
void write_model(const TemporaryFolder& folder, const DamperModel& model,
                 const ExportOptions& options) {
  const ExportedModel what = exported(model);
  for (const ExportedFile& file : write_onnx(what, options)) folder.write(file.name, file.content);
  const double sample_time = export_sample_time(what, options);
  const std::vector<DamperInput> whole = export_run(what.domain, sample_time, 3 * kSteps);
  const bool is_single = options.precision != CPrecision::Double;
  RuntimeCheck check{
      .inputs = {{.name = "displacement"}, {.name = "velocity"}, {.name = "current"}},
      .output = "force",
      .is_single = is_single,
      .tolerance = is_single ? 1e-5 : 1e-12};
  for (const std::size_t part : {2, 0, 1}) {
    const auto begin = whole.begin() + static_cast<std::ptrdiff_t>(part * kSteps);
    check.runs.push_back(run_of(model, {begin, begin + kSteps}, sample_time));
  }
  const auto [least, most] = std::ranges::minmax(check.runs[1].answers);
  check.span = most[0] - least[0];
  write_check(folder, options.name, check);
}

}  // namespace

TEST_CASE(
    "ONNX Runtime: every kind of model gives the library's force, within 1e-5 of its span or "
    "1e-12") {
  if (!is_runtime_there()) return;
  const TemporaryFolder folder;
  // Graphs in single precision differ in the type of their numbers alone: every third is enough.
  std::size_t count = 0;
  for (const ExampleModel& example : example_models()) {
    if (count++ % 3 == 0) write_model(folder, *example.model, {.name = example.name + "_float"});
    write_model(folder, *example.model,
                {.name = example.name + "_double", .precision = CPrecision::Double});
    if (example.name == "narx")  // on its grid of 5 ms, whatever the steps
      write_model(folder, *example.model, {.name = "narx_between", .sample_time = 2e-3});
  }
  check_that_all_agree(folder);
}

TEST_CASE("ONNX Runtime: a graph of another damper is told") {
  if (!is_runtime_there()) return;
  const TemporaryFolder folder;
  const LawModel model = example_law(find_law("bouc_wen"));
  write_model(folder, model, {.name = "x"});
  const auto moved = model.with_offset(1);
  for (const ExportedFile& file : write_onnx(exported(*moved), {.name = "x"}))
    folder.write(file.name, file.content);
  const ProgramResult result = run_all(folder);
  CHECK(result.exit_code == 1);
  CHECK(result.output.find("FAILED x") != std::string::npos);
}
