#include "dashpot/output/exporters/onnx.h"

#include <array>
#include <optional>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/law_model.h"
#include "dashpot/output/exporters/c_model.h"
#include "dashpot/output/exporters/onnx/c_trace.h"
#include "dashpot/output/exporters/onnx/live_nodes.h"
#include "dashpot/output/exporters/onnx/onnx_graph.h"

namespace dashpot {
namespace {

using namespace trace;

constexpr std::array<const char*, 3> kInputs{"displacement", "velocity", "current"};
constexpr const char* kDamperInput =
    "typedef struct DamperInput {\n  double displacement;\n  double velocity;\n  double current;\n} "
    "DamperInput;\n\n";

/// What a step and a rest of a model compute. A step reads the inputs at its end, those at its start, which
/// are the first of the state, and the rest of the state.
class Calculation {
 public:
  Calculation(const std::string& code, std::size_t state_size, double sample_time, bool is_single)
      : graph(is_single),
        program_(parse_c(code)),
        size_(kInputs.size() + state_size),
        sample_time_(sample_time) {
    rest_ = rest_from({graph.input(0), graph.input(1), graph.input(2)}, false);
    fixed_ = rest_.state;
    while (!trace_step()) {
    }
    find_used();
  }

  struct Outputs {
    Node force = 0;
    std::vector<Node> state;
  };
  const Outputs& step() const { return step_; }
  const Outputs& rest() const { return rest_; }
  /// What the force depends on, now or later: places in the state.
  const std::vector<std::size_t>& used() const { return used_; }
  Node state_input(std::size_t place) { return graph.input(kInputs.size() + place); }
  /// The state at rest where displacement and current are zero.
  std::vector<double> initial() {
    const Node zero = graph.constant(0);
    std::vector<double> values;
    for (const Node node : rest_from({zero, zero, zero}, true).state) values.push_back(graph.value(node));
    return values;
  }

  Graph graph;

 private:
  Outputs rest_from(const std::vector<Node>& input, bool unrolls) {
    CTrace trace(program_, graph, unrolls);
    const std::size_t at = trace.room(input), state = trace.room(std::vector<Node>(size_ - input.size()));
    trace.call("model_rest", {{.address = at}, {.address = state}});
    Outputs out{trace.call("model_force", {{.address = at}, {.address = state}}), input};
    append_state(trace, state, out);
    return out;
  }

  void append_state(const CTrace& trace, std::size_t address, Outputs& out) const {
    for (std::size_t k = kInputs.size(); k < size_; ++k)
      out.state.push_back(trace.number(address + k - kInputs.size()));
  }

  /// Holds what a rest leaves constant for constant. False where a step does not: then that is no longer.
  bool trace_step() {
    std::vector<Node> now, before;
    for (std::size_t k = 0; k < size_; ++k)
      before.push_back(graph.is_constant(fixed_[k]) ? fixed_[k] : state_input(k));
    for (std::size_t k = 0; k < kInputs.size(); ++k) now.push_back(graph.input(k));
    const std::vector<Node> from(before.begin(), before.begin() + kInputs.size());
    CTrace trace(program_, graph);
    const std::size_t start = trace.room(from), end = trace.room(now);
    const std::size_t state = trace.room({before.begin() + kInputs.size(), before.end()});
    trace.call("model_advance", {{.address = start},
                                 {.address = end},
                                 {.is_pointer = false, .number = graph.constant(sample_time_)},
                                 {.address = state}});
    step_ = {trace.call("model_force", {{.address = end}, {.address = state}}), now};
    append_state(trace, state, step_);
    bool is_so = true;
    for (std::size_t k = 0; k < size_; ++k) {
      if (!graph.is_constant(fixed_[k]) || step_.state[k] == fixed_[k]) continue;
      fixed_[k] = state_input(k);
      is_so = false;
    }
    return is_so;
  }

  void find_used() {
    std::vector<bool> is_used(size_);
    std::vector<Node> needed{step_.force};
    for (bool grows = true; grows;) {
      grows = false;
      const LiveNodes live(graph, needed);
      for (std::size_t k = 0; k < size_; ++k) {
        const Node input = state_input(k);
        if (is_used[k] || !live.has(input)) continue;
        is_used[k] = grows = true;
        needed.push_back(step_.state[k]);
      }
    }
    for (std::size_t k = 0; k < size_; ++k)
      if (is_used[k]) used_.push_back(k);
  }

  const CProgram program_;
  const std::size_t size_;
  const double sample_time_;
  Outputs rest_, step_;
  std::vector<Node> fixed_;
  std::vector<std::size_t> used_;
};

std::string span_text(double low, double high, const std::string& unit) {
  return format_exact(low) + " ... " + format_exact(high) + ' ' + unit;
}

/// Of the places in the state that are used.
std::vector<std::string> state_names(const DamperModel& model, const std::vector<std::size_t>& used) {
  const auto* law = dynamic_cast<const LawModel*>(&model);
  std::vector<std::string> names;
  for (const std::size_t place : used) {
    if (place < kInputs.size()) {
      names.push_back(std::string("previous_") + kInputs[place]);
      continue;
    }
    const std::size_t k = place - kInputs.size();
    if (!law)
      names.push_back("state_" + std::to_string(k));
    else
      names.emplace_back(k < law->law().states.size() ? law->law().states[k].name : "coil_current");
  }
  return names;
}

class Files {
 public:
  Files(const ExportedModel& model, const ExportOptions& options)
      : model_(model),
        options_(options),
        is_single_(options.precision != CPrecision::Double),
        sample_time_(export_sample_time(model, options)),
        calculation_(in_precision(kDamperInput + with_texts(c_model(model.model).code),
                                  is_single_ ? CPrecision::Single : CPrecision::Double),
                     model.model.state_size(), sample_time_, is_single_) {}

  std::vector<ExportedFile> all() {
    const std::string name = export_name(model_, options_);
    std::vector<ExportedFile> files{{name + ".onnx", step()}};
    if (!calculation_.used().empty()) files.push_back({name + "_rest.onnx", rest()});
    return files;
  }

 private:
  std::string step() {
    std::vector<OnnxFace> outputs{force_face(calculation_.step())};
    std::vector<OnnxFace> states;
    if (!calculation_.used().empty()) {
      states.push_back({"state", "what the damper remembers: NAME_rest.onnx gives the first one", {}});
      outputs.push_back(state_face("next_state", calculation_.step()));
      for (const std::size_t place : calculation_.used())
        states[0].columns.push_back(calculation_.state_input(place));
    }
    return file(states, outputs, "One step of " + format_number(sample_time_) + " s of a damper: ");
  }

  std::string rest() {
    return file({}, {force_face(calculation_.rest()), state_face("state", calculation_.rest())},
                "Where a run begins, a damper after a long rest: ");
  }

  static OnnxFace force_face(const Calculation::Outputs& outputs) {
    return {"force", "N, positive when it resists extension", {outputs.force}};
  }

  OnnxFace state_face(const std::string& name, const Calculation::Outputs& outputs) const {
    OnnxFace face{name, "what the damper remembers, for the next step", {}};
    for (const std::size_t place : calculation_.used()) face.columns.push_back(outputs.state[place]);
    return face;
  }

  std::string file(const std::vector<OnnxFace>& states, const std::vector<OnnxFace>& outputs,
                   const std::string& what) {
    std::vector<Node> needed;
    for (const OnnxFace& output : outputs)
      needed.insert(needed.end(), output.columns.begin(), output.columns.end());
    const std::array<std::string, 3> meanings{"m, extension positive", "m/s, extension positive",
                                              model_.drive_unit + ", command to the coil"};
    std::vector<OnnxFace> inputs;
    for (std::size_t k = 0; k < kInputs.size(); ++k) {
      const Node input = calculation_.graph.input(k);
      if (k == 1 || LiveNodes(calculation_.graph, needed).has(input))
        inputs.push_back({kInputs[k], meanings[k], {input}});
    }
    inputs.insert(inputs.end(), states.begin(), states.end());
    const OnnxType type = is_single_ ? OnnxType::Float : OnnxType::Double;
    return onnx_bytes({.graph = onnx_graph(calculation_.graph, inputs, outputs, type),
                       .producer_version = options_.version,
                       .description = what + model_.model.name() + ". " + model_.origin,
                       .metadata = metadata()});
  }

  std::vector<std::pair<std::string, std::string>> metadata() {
    const Domain& d = model_.domain;
    std::string initial;
    if (!calculation_.used().empty()) {
      const std::vector<double> values = calculation_.initial();
      for (const std::size_t place : calculation_.used())
        initial += (initial.empty() ? "" : ", ") + format_exact(values[place]);
    }
    return {{"model", model_.model.name()},
            {"kind", model_.model.kind()},
            {"origin", model_.origin},
            {"sample_time", format_exact(sample_time_) + " s"},
            {"units", "displacement m, velocity m/s, current " + model_.drive_unit + ", force N"},
            {"signs", "extension positive; force positive when it resists extension"},
            {"domain_displacement", span_text(d.displacement_min, d.displacement_max, "m")},
            {"domain_velocity", span_text(d.velocity_min, d.velocity_max, "m/s")},
            {"domain_current", span_text(d.current_min, d.current_max, model_.drive_unit)},
            {"state", join(state_names(model_.model, calculation_.used()), ", ")},
            {"state_at_rest", initial},
            {"command", options_.command}};
  }

  const ExportedModel& model_;
  const ExportOptions& options_;
  const bool is_single_;
  const double sample_time_;
  Calculation calculation_;
};

}  // namespace

std::vector<ExportedFile> write_onnx(const ExportedModel& model, const ExportOptions& options) {
  try {
    return Files(model, options).all();
  } catch (const Error& error) {
    if (std::string(error.what()).find("C text") == std::string::npos) throw;
    throw Error(model.model.name(), std::string("cannot become a graph: ") + error.what(), "--to c or fmu3");
  }
}

}  // namespace dashpot
