#include <filesystem>

#include "dashpot/output/exporters/export_run.h"
#include "dashpot/output/exporters/onnx.h"
#include "output/exporters/example_models.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr std::size_t kSteps = 200;

/// A run and the library's force along it.
std::vector<std::pair<std::string, Value>> run_values(const DamperModel& model,
                                                      const std::vector<DamperInput>& run,
                                                      double sample_time) {
  Value inputs = Value::array(), forces = Value::array();
  for (const DamperInput& input : run)
    inputs.push_back(Value::object(
        {{"displacement", input.displacement}, {"velocity", input.velocity}, {"current", input.current}}));
  for (const double force : force_along(model, run, sample_time)) forces.push_back(force);
  return {{"run", std::move(inputs)}, {"force", std::move(forces)}};
}

/// The graphs of a model, and what the library says of a run and of three parts of another.
void write_model(const TemporaryFolder& folder, const ExampleModel& example, CPrecision precision) {
  const ExportedModel model = exported(*example.model);
  const bool is_single = precision == CPrecision::Single;
  const std::string name = example.name + (is_single ? "_single" : "_double");
  const ExportOptions options{.name = name, .precision = precision};
  for (const ExportedFile& file : write_onnx(model, options)) folder.write(file.name, file.content);
  const double sample_time = export_sample_time(model, options);
  const std::vector<DamperInput> run = export_run(model.domain, sample_time, 3 * kSteps);
  const auto part = [&](std::size_t k) {
    const auto begin = run.begin() + static_cast<std::ptrdiff_t>(k * kSteps);
    return std::vector<DamperInput>(begin, begin + kSteps);
  };
  Value lanes = Value::array();
  for (const std::size_t k : {2, 0, 1})
    lanes.push_back(Value::object(run_values(*example.model, part(k), sample_time)));
  std::vector<std::pair<std::string, Value>> document = run_values(*example.model, part(0), sample_time);
  document.emplace_back("lanes", std::move(lanes));
  document.emplace_back("type", is_single ? "float32" : "float64");
  document.emplace_back("tolerance", is_single ? 1e-5 : 1e-12);
  folder.write(name + ".json", format_json(Value::object(std::move(document))));
}

}  // namespace

TEST_CASE("ONNX Runtime: every kind of model gives the library's force within 1e-5 of its span") {
  if (!std::filesystem::exists(project_file("node_modules/onnxruntime-node"))) {
    MESSAGE("SKIPPED: no onnxruntime-node is here");
    return;
  }
  const TemporaryFolder folder; std::filesystem::create_directories("/tmp/onnxout");
  for (const ExampleModel& example : example_models()) {
    try {
      write_model(folder, example, CPrecision::Single);
    } catch (const std::exception& e) {
      MESSAGE(example.name << ": " << std::string(e.what()));
    }
  }
  const ProgramResult result =
      run_program("node '" + project_file("tests/onnx/run.mjs") + "' '" + folder.path().string() + "'");
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
  MESSAGE(result.output);
}
