#include "dashpot/export/onnx/calculation.h"

#include <algorithm>

#include "dashpot/base/escape.h"
#include "dashpot/export/onnx/c_trace.h"
#include "dashpot/export/onnx/live_nodes.h"

namespace dashpot::trace {
namespace {

/// A function around one of a block's statements, with plain numbers in and out.
constexpr const char* kCall = R"(
static void @name@(const double* row, damper_model* state, double* commands) {
  damper_model model = *state;
  damper_input input;
  read_input(row, &input);
  @statement@
  *state = model;
}
)";

std::string code_of(const CBlock& block, const std::string& first) {
  std::string code;
  for (const ExportedFile& file : c_block_sources(block, "damper", "")) code += file.content;
  code += "\nstatic void read_input(const double* row, damper_input* input) {\n" +
          c_block_reads(block) + "}\n";
  for (const auto& [name, statement] :
       {std::pair<std::string, std::string>{"reset_call", "damper_reset(&model, &input);"},
        {"first_call", first},
        {"step_call", block.step}})
    code += filled(kCall, {{"name", CText::own(name)}, {"statement", CText::own(statement)}});
  return code;
}

std::size_t width(const std::vector<CPort>& ports) {
  std::size_t sum = 0;
  for (const CPort& port : ports) sum += port.count;
  return sum;
}

}  // namespace

Calculation::Calculation(const CBlock& block, const std::string& first)
    : graph(block.precision == CPrecision::Single),
      program_(parse_c(code_of(block, first))),
      input_size_(width(block.inputs)),
      command_size_(width(block.commands)),
      state_size_(program_.size_of_struct("damper_model")) {
  first_ = called({"reset_call", "first_call"}, inputs(),
                  std::vector<Node>(state_size_, graph.constant(0)));
  fixed_ = first_.state;
  while (!trace_step()) {
  }
  find_used();
}

std::vector<double> Calculation::at_rest() {
  const Node zero = graph.constant(0);
  const Outputs rest = called({"reset_call"}, std::vector<Node>(input_size_, zero),
                              std::vector<Node>(state_size_, zero), true);
  std::vector<double> values;
  for (const Node node : rest.state) values.push_back(graph.value(node));
  return values;
}

std::vector<Node> Calculation::inputs() {
  std::vector<Node> out;
  for (std::size_t k = 0; k < input_size_; ++k) out.push_back(graph.input(k));
  return out;
}

Calculation::Outputs Calculation::called(const std::vector<const char*>& functions,
                                         const std::vector<Node>& given,
                                         const std::vector<Node>& state, bool unrolls) {
  CTrace trace(program_, graph, unrolls);
  const std::size_t row = trace.room(given), model = trace.room(state),
                    commands = trace.room(std::vector<Node>(command_size_, graph.constant(0)));
  for (const char* function : functions)
    trace.call(function, {{.address = row}, {.address = model}, {.address = commands}});
  Outputs out;
  for (std::size_t k = 0; k < command_size_; ++k)
    out.commands.push_back(trace.number(commands + k));
  for (std::size_t k = 0; k < state_size_; ++k) out.state.push_back(trace.number(model + k));
  return out;
}

/// Traces a step with each number of the state as a constant that is one when a run begins. False
/// where the step changes such a number: it is no constant any longer, and the step must be traced
/// again.
bool Calculation::trace_step() {
  for (std::size_t k = 0; k < state_size_; ++k)
    if (!graph.is_constant(fixed_[k])) fixed_[k] = state_input(k);
  step_ = called({"step_call"}, inputs(), fixed_);
  bool is_so = true;
  for (std::size_t k = 0; k < state_size_; ++k) {
    if (!graph.is_constant(fixed_[k]) || step_.state[k] == fixed_[k]) continue;
    fixed_[k] = state_input(k);
    is_so = false;
  }
  return is_so;
}

void Calculation::find_used() {
  std::vector<bool> is_used(state_size_);
  std::vector<Node> needed = step_.commands;
  for (bool grows = true; grows;) {
    grows = false;
    const LiveNodes live(graph, needed);
    for (std::size_t k = 0; k < state_size_; ++k) {
      if (is_used[k] || !live.has(state_input(k))) continue;
      is_used[k] = grows = true;
      needed.push_back(step_.state[k]);
    }
  }
  for (std::size_t k = 0; k < state_size_; ++k)
    if (is_used[k]) used_.push_back(k);
}

}  // namespace dashpot::trace
