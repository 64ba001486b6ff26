#pragma once
#include <cmath>
#include <filesystem>

#include "dashpot/base/text.h"
#include "dashpot/export/c/c_block.h"
#include "dashpot/value.h"
#include "support.h"

using Rows = std::vector<std::vector<double>>;

/// What run.mjs is told of a model.
struct RuntimeCheck {
  struct Run {
    Rows inputs;   ///< at each step, port by port
    Rows answers;  ///< or none
    Rows matters;  ///< at each step whether the answer does, 1 or 0; or none
  };
  std::vector<dashpot::CPort> inputs;
  std::string output;
  bool is_single = false;
  double span = 0, tolerance = 0;
  std::vector<Run> runs;
};

/// JSON has no numbers that are not finite.
inline dashpot::Value json_rows(const Rows& rows) {
  using dashpot::Value;
  Value out = Value::array();
  for (const std::vector<double>& row : rows) {
    Value numbers = Value::array();
    for (const double number : row)
      numbers.push_back(std::isfinite(number) ? Value(number)
                        : std::isnan(number)  ? Value("NaN")
                                              : Value(number > 0 ? "Infinity" : "-Infinity"));
    out.push_back(std::move(numbers));
  }
  return out;
}

inline void write_check(const TemporaryFolder& folder, const std::string& name,
                        const RuntimeCheck& check) {
  using dashpot::Value;
  Value inputs = Value::object(), runs = Value::array();
  std::size_t begin = 0;
  for (const dashpot::CPort& port : check.inputs) {
    inputs.add(port.name, Value::array({Value(begin), Value(begin + port.count)}));
    begin += port.count;
  }
  for (const RuntimeCheck::Run& run : check.runs) {
    Value one = Value::object({{"inputs", json_rows(run.inputs)}});
    if (!run.answers.empty()) one.add("answers", json_rows(run.answers));
    if (!run.matters.empty()) one.add("matters", json_rows(run.matters));
    runs.push_back(std::move(one));
  }
  folder.write(name + ".json",
               format_json(Value::object({{"inputs", std::move(inputs)},
                                          {"output", check.output},
                                          {"type", check.is_single ? "float32" : "float64"},
                                          {"span", check.span},
                                          {"tolerance", check.tolerance},
                                          {"runs", std::move(runs)}})));
}

/// Runs what lies in the folder.
inline ProgramResult run_all(const TemporaryFolder& folder) {
  return run_program("node '" + project_file("tests/onnx/run.mjs") + "' '" +
                     folder.path().string() + "'");
}

inline void check_that_all_agree(const TemporaryFolder& folder) {
  const ProgramResult result = run_all(folder);
  CAPTURE(result.output);
  CHECK(result.exit_code == 0);
}

inline bool is_runtime_there() {
  if (std::filesystem::exists(project_file("node_modules/onnxruntime-node"))) return true;
  MESSAGE("SKIPPED: no onnxruntime-node is in node_modules");
  return false;
}
