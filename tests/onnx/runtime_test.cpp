#include <filesystem>

#include "dashpot/output/exporters/export_run.h"
#include "dashpot/output/exporters/onnx.h"
#include "output/exporters/example_models.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr std::size_t kSteps = 100;
using Members = std::vector<std::pair<std::string, Value>>;

/// A run and the library's force along it.
Members run_values(const DamperModel& model, const std::vector<DamperInput>& run, double sample_time) {
  Value inputs = Value::array();
  for (const DamperInput& input : run)
    inputs.push_back(Value::object(
        {{"displacement", input.displacement}, {"velocity", input.velocity}, {"current", input.current}}));
  return {{"run", std::move(inputs)}, {"force", Value::array(force_along(model, run, sample_time))}};
}

/// The graphs of a model, what the library says of a run, and of three runs beside each other.
void write_model(const TemporaryFolder& folder, const DamperModel& model, const ExportOptions& options) {
  const ExportedModel what = exported(model);
  for (const ExportedFile& file : write_onnx(what, options)) folder.write(file.name, file.content);
  const double sample_time = export_sample_time(what, options);
  const std::vector<DamperInput> run = export_run(what.domain, sample_time, 3 * kSteps);
  const auto part = [&](std::size_t k) {
    const auto begin = run.begin() + static_cast<std::ptrdiff_t>(k * kSteps);
    return std::vector<DamperInput>(begin, begin + kSteps);
  };
  Members document = run_values(model, part(0), sample_time);
  Value lanes = Value::array();
  for (const std::size_t k : {2, 0, 1})
    lanes.push_back(Value::object(run_values(model, part(k), sample_time)));
  document.emplace_back("lanes", std::move(lanes));
  const bool is_single = options.precision != CPrecision::Double;
  document.emplace_back("type", is_single ? "float32" : "float64");
  document.emplace_back("tolerance", is_single ? 1e-5 : 1e-12);
  folder.write(options.name + ".json", format_json(Value::object(std::move(document))));
}

/// Runs what lies in the folder; nothing where ONNX Runtime is not here.
ProgramResult run_all(const TemporaryFolder& folder) {
  return run_program("node '" + project_file("tests/onnx/run.mjs") + "' '" + folder.path().string() + "'");
}

bool is_runtime_there() {
  if (std::filesystem::exists(project_file("node_modules/onnxruntime-node"))) return true;
  MESSAGE("SKIPPED: no onnxruntime-node is in node_modules");
  return false;
}

}  // namespace

TEST_CASE("ONNX Runtime: every kind of model gives the library's force, within 1e-5 of its span or 1e-12") {
  if (!is_runtime_there()) return;
  const TemporaryFolder folder;
  for (const ExampleModel& example : example_models()) {
    write_model(folder, *example.model, {.name = example.name + "_float"});
    write_model(folder, *example.model, {.name = example.name + "_double", .precision = CPrecision::Double});
    if (example.name == "narx")  // on its grid of 5 ms, whatever the steps
      write_model(folder, *example.model, {.name = "narx_between", .sample_time = 2e-3});
  }
  const ProgramResult result = run_all(folder);
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
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
