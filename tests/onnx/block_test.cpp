#include "conformance/c_compile.h"
#include "conformance/control_cases.h"
#include "dashpot/output/exporters/c_model.h"
#include "dashpot/output/exporters/onnx.h"
#include "runtime.h"

using namespace dashpot;

namespace {

constexpr std::size_t kBeside = 60;  // steps of runs beside each other

RuntimeCheck::Run run_of(const std::vector<CBlock::Sample>& samples) {
  RuntimeCheck::Run run;
  for (const CBlock::Sample& sample : samples) {
    run.inputs.push_back(sample.inputs);
    run.answers.push_back(sample.commands);
    run.matters.push_back({sample.matters ? 1. : 0.});
  }
  return run;
}

/// The run from another sample on: what the library says there is not known.
RuntimeCheck::Run from(RuntimeCheck::Run run, std::size_t begin) {
  for (Rows* rows : {&run.inputs, &run.matters})
    *rows = {rows->begin() + static_cast<std::ptrdiff_t>(begin),
             rows->begin() + static_cast<std::ptrdiff_t>(begin + kBeside)};
  run.answers.clear();
  return run;
}

RuntimeCheck check_of(const CBlock& block) {
  return {.inputs = block.inputs,
          .output = "command",
          .is_single = block.precision == CPrecision::Single,
          .span = block.range,
          .tolerance = block.tolerance};
}

void write_graphs(const TemporaryFolder& folder, const CBlock& block) {
  for (const ExportedFile& file :
       write_onnx_block([&](const ExportOptions&) { return block; }, {.precision = block.precision}))
    folder.write(file.name, file.content);
}

void write_block(const TemporaryFolder& folder, const BlockCase& one, CPrecision precision) {
  CBlock block = one.block({.precision = precision});
  block.name += precision == CPrecision::Double ? "_double" : "_float";
  write_graphs(folder, block);
  RuntimeCheck check = check_of(block);
  const RuntimeCheck::Run run = run_of(block.samples);
  check.runs = {from(run, 67), run, from(run, 120)};
  write_check(folder, block.name, check);
}

}  // namespace

TEST_CASE("ONNX Runtime: every controller gives the library's commands, within 1e-5 of their range or 1e-12") {
  if (!is_runtime_there()) return;
  const TemporaryFolder folder;
  for (const BlockCase& one : controller_cases())
    for (const CPrecision precision : {CPrecision::Single, CPrecision::Double})
      write_block(folder, one, precision);
  check_that_all_agree(folder);
}

TEST_CASE("ONNX Runtime: every inverse gives the library's currents, within 1e-5 of their range or 1e-12") {
  if (!is_runtime_there()) return;
  const TemporaryFolder folder;
  for (const BlockCase& one : inverse_cases())
    for (const CPrecision precision : {CPrecision::Single, CPrecision::Double})
      write_block(folder, one, precision);
  check_that_all_agree(folder);
}
