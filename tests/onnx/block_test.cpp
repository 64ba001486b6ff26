#include <array>
#include <set>
#include <sstream>

#include "conformance/c_compile.h"
#include "conformance/control_cases.h"
#include "dashpot/base/escape.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/c_subset/c_rewrite.h"
#include "dashpot/export/onnx/onnx.h"
#include "runtime.h"

using namespace dashpot;

namespace {

constexpr std::size_t kBeside = 20;  // steps of runs beside each other

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
  for (const ExportedFile& file : write_onnx_block([&](const ExportOptions&) { return block; },
                                                   {.precision = block.precision}))
    folder.write(file.name, file.content);
}

void write_block(const TemporaryFolder& folder, const BlockCase& one, CPrecision precision) {
  CBlock block = one.block({.precision = precision});
  block.name += precision == CPrecision::Double ? "_double" : "_float";
  write_graphs(folder, block);
  RuntimeCheck check = check_of(block);
  const RuntimeCheck::Run run = run_of(block.samples);
  check.runs = {from(run, 31), run, from(run, 67)};
  write_check(folder, block.name, check);
}

/// Graphs in single precision differ in the type of their numbers alone: every third is enough.
void write_blocks(const TemporaryFolder& folder, const std::vector<BlockCase>& cases) {
  for (std::size_t k = 0; k < cases.size(); ++k) {
    write_block(folder, cases[k], CPrecision::Double);
    if (k % 3 == 0) write_block(folder, cases[k], CPrecision::Single);
  }
}

std::string in_c(double number) {
  if (std::isnan(number)) return "NAN";
  return std::isinf(number) ? (number > 0 ? "INFINITY" : "-INFINITY") : c_number(number);
}

/// What the exported C gives along inputs that need not be numbers.
Rows answers_of_c(const TemporaryFolder& folder, const CBlock& block, const Rows& inputs) {
  std::string rows;
  for (const std::vector<double>& row : inputs)
    for (const double number : row) rows += in_c(number) + ",\n";
  for (const ExportedFile& file : c_block_sources(block, "x", ""))
    folder.write(file.name, file.content);
  const std::size_t commands = block.samples[0].commands.size();
  folder.write("main.c", filled(R"(#include "x.h"
#include <math.h>
#include <stdio.h>
static const double kRows[][@width@] = {@rows@};
static void read_input(const double* row, x_input* input) {
@reads@}
int main(void) {
  x_model model;
  x_input input;
  double commands[@commands@];
  int k, j;
  for (k = 0; k < @steps@; ++k) {
    read_input(kRows[k], &input);
    if (k == 0) x_reset(&model, &input);
    @step@
    for (j = 0; j < @commands@; ++j) printf("%.17g ", commands[j]);
  }
  return 0;
}
)",
                                {{"width", CText::own(std::to_string(inputs[0].size()))},
                                 {"rows", CText::own(rows)},
                                 {"reads", CText::own(c_block_reads(block))},
                                 {"commands", CText::own(std::to_string(commands))},
                                 {"steps", CText::own(std::to_string(inputs.size()))},
                                 {"step", CText::own(with_prefix(block.step, "x"))}}));
  const ProgramResult result = run_program("cd '" + folder.path().string() +
                                           "' && cc -std=c99 -w main.c x.c -lm -o x && ./x");
  CAPTURE(result.output);
  REQUIRE(result.exit_code == 0);
  std::istringstream numbers(result.output);
  Rows answers(inputs.size(), std::vector<double>(commands));
  for (std::vector<double>& row : answers)
    for (double& command : row) numbers >> command;
  return answers;
}

/// With what is no number now in this input, now in that.
Rows disturbed(Rows inputs) {
  constexpr std::array<double, 3> kNone{NAN, HUGE_VAL, -HUGE_VAL};
  for (std::size_t k = 3; k < inputs.size(); k += 5)
    inputs[k][k / 5 % inputs[k].size()] = kNone[k / 5 % kNone.size()];
  return inputs;
}

}  // namespace

TEST_CASE("ONNX Runtime: what is no number is taken as the C code takes it") {
  if (!is_runtime_there() || !is_there("cc")) return;
  const TemporaryFolder folder;
  const std::set<std::string> some{
      "pdd_q",        "feb_car",        "selector_q",        "full_car",
      "spencer_loop", "bingham_neural", "bingham_polynomial"};
  for (const BlockCase& one : block_cases()) {
    if (!some.contains(one.name)) continue;
    const CBlock block = one.block({.precision = CPrecision::Double});
    write_graphs(folder, block);
    RuntimeCheck check = check_of(block);
    RuntimeCheck::Run run = run_of(block.samples);
    run.inputs = disturbed(std::move(run.inputs));
    const TemporaryFolder code;
    run.answers = answers_of_c(code, block, run.inputs);
    check.runs = {from(run, 31), run, from(run, 67)};
    write_check(folder, block.name, check);
  }
  check_that_all_agree(folder);
}

TEST_CASE(
    "ONNX Runtime: every controller gives the library's commands, within 1e-5 of their range or "
    "1e-12") {
  if (!is_runtime_there()) return;
  const TemporaryFolder folder;
  write_blocks(folder, controller_cases());
  check_that_all_agree(folder);
}

TEST_CASE(
    "ONNX Runtime: every inverse gives the library's currents, within 1e-5 of their range or "
    "1e-12") {
  if (!is_runtime_there()) return;
  const TemporaryFolder folder;
  write_blocks(folder, inverse_cases());
  check_that_all_agree(folder);
}
