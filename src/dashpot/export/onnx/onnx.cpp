#include "dashpot/export/onnx/onnx.h"

#include <algorithm>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/error.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/onnx/calculation.h"
#include "dashpot/export/onnx/live_nodes.h"
#include "dashpot/export/onnx/onnx_graph.h"

namespace dashpot {
namespace {

using namespace trace;
using Rows = std::vector<std::pair<std::string, std::string>>;

/// A damper, an inverse or a controller that becomes a graph, with what the file says of it.
struct Subject {
  CBlock block;
  std::string first;                ///< in place of block.step where a run begins
  std::vector<std::string> states;  ///< names of block.state_size numbers, or none
  Rows facts;                       ///< metadata of its own, the first of which names it
  std::string signs, command;
};

std::string in_words(const CPort& port) {
  return (port.unit.empty() ? "" : port.unit + ", ") + port.meaning;
}

class Files {
 public:
  explicit Files(const Subject& subject)
      : subject_(subject), block_(subject.block), calculation_(block_, subject.first) {}

  std::vector<ExportedFile> all() {
    std::vector<ExportedFile> files{{block_.name + ".onnx", step()}};
    if (has_state()) files.push_back({block_.name + "_rest.onnx", first()});
    return files;
  }

 private:
  bool has_state() const { return !calculation_.used().empty(); }

  std::string step() {
    std::vector<OnnxFace> inputs = input_faces(), outputs = command_faces(calculation_.step());
    if (has_state()) {
      inputs.push_back({"state", "what is remembered: NAME_rest.onnx gives the first one", {}});
      outputs.push_back(state_face("next_state", calculation_.step()));
      for (const std::size_t place : calculation_.used())
        inputs.back().columns.push_back(calculation_.state_input(place));
    }
    return file(inputs, outputs, "One step of " + format_number(block_.sample_time) + " s of ");
  }

  std::string first() {
    std::vector<OnnxFace> outputs = command_faces(calculation_.first());
    outputs.push_back(state_face("state", calculation_.first()));
    return file(input_faces(), outputs, "How a run begins, after a long rest, of ");
  }

  std::vector<OnnxFace> command_faces(const Calculation::Outputs& outputs) const {
    std::vector<OnnxFace> faces;
    auto next = outputs.commands.begin();
    for (const CPort& port : block_.commands) {
      faces.push_back(
          {port.name, in_words(port), {next, next + static_cast<std::ptrdiff_t>(port.count)}});
      next += static_cast<std::ptrdiff_t>(port.count);
    }
    return faces;
  }

  OnnxFace state_face(const std::string& name, const Calculation::Outputs& outputs) const {
    OnnxFace face{name, "what is remembered, for the next step", {}};
    for (const std::size_t place : calculation_.used())
      face.columns.push_back(outputs.state[place]);
    return face;
  }

  /// The inputs that something reads; the first where none is read, since an input must say how
  /// large the batch is.
  std::vector<OnnxFace> input_faces() {
    std::vector<Node> needed;
    for (const Calculation::Outputs* outputs : {&calculation_.step(), &calculation_.first()}) {
      needed.insert(needed.end(), outputs->commands.begin(), outputs->commands.end());
      for (const std::size_t place : calculation_.used()) needed.push_back(outputs->state[place]);
    }

    // Divide the ports by whether anything needs one of their numbers.
    const LiveNodes live(calculation_.graph, needed);
    std::vector<OnnxFace> faces, unread;
    std::size_t place = 0;
    for (const CPort& port : block_.inputs) {
      OnnxFace face{port.name, in_words(port), {}};
      for (std::size_t k = 0; k < port.count; ++k)
        face.columns.push_back(calculation_.input(place++));
      const bool is_read =
          std::ranges::any_of(face.columns, [&](Node node) { return live.has(node); });
      (is_read ? faces : unread).push_back(std::move(face));
    }
    return faces.empty() ? std::vector{unread.front()} : faces;
  }

  std::string file(const std::vector<OnnxFace>& inputs, const std::vector<OnnxFace>& outputs,
                   const std::string& what) {
    const OnnxType type = calculation_.graph.is_single() ? OnnxType::Float : OnnxType::Double;
    return onnx_bytes({.graph = onnx_graph(calculation_.graph, inputs, outputs, type),
                       .producer_version = block_.version,
                       .description = what + block_.title,
                       .metadata = metadata()});
  }

  /// damper_model ends with the state of the C code; that of a damper begins with the last inputs.
  std::string state_name(std::size_t place) const {
    const std::size_t before = calculation_.state_size() - block_.state_size;
    if (place < before) return "previous_" + block_.inputs[place].name;
    return subject_.states.empty() ? "state_" + std::to_string(place - before)
                                   : subject_.states[place - before];
  }

  Rows metadata() {
    std::vector<std::string> units, names, initial;
    for (const auto* ports : {&block_.inputs, &block_.commands})
      for (const CPort& port : *ports)
        if (!port.unit.empty()) units.push_back(port.name + ' ' + port.unit);

    // The state, number by number: its names, and where a run may begin without NAME_rest.onnx.
    if (has_state())
      for (const std::vector<double> at_rest = calculation_.at_rest();
           const std::size_t place : calculation_.used()) {
        names.push_back(state_name(place));
        initial.push_back(format_exact(at_rest[place]));
      }

    // Rows that say nothing are left out.
    Rows rows = subject_.facts;
    rows.insert(rows.end(), {{"sample_time", format_exact(block_.sample_time) + " s"},
                             {"units", join(units, ", ")},
                             {"signs", subject_.signs},
                             {"state", join(names, ", ")},
                             {"state_at_rest", join(initial, ", ")},
                             {"command", subject_.command}});
    std::erase_if(rows, [](const auto& row) { return row.second.empty(); });
    return rows;
  }

  const Subject& subject_;
  const CBlock& block_;
  Calculation calculation_;
};

std::vector<ExportedFile> files_of(const Subject& subject) {
  try {
    return Files(subject).all();
  } catch (const Error& error) {
    throw Error(subject.facts.front().second, std::string("cannot become a graph: ") + error.what(),
                "--to c");
  }
}

CPrecision precision_of(const ExportOptions& options) {
  return options.precision.value_or(CPrecision::Single);
}

std::string span_text(double low, double high, const std::string& unit) {
  return format_exact(low) + " ... " + format_exact(high) + ' ' + unit;
}

Rows facts_of(const ExportedModel& model) {
  const Domain& d = model.domain;
  return {{"model", model.model.name()},
          {"kind", std::string(name_of(model.model.kind()))},
          {"origin", model.origin},
          {"domain_displacement", span_text(d.displacement_min, d.displacement_max, "m")},
          {"domain_velocity", span_text(d.velocity_min, d.velocity_max, "m/s")},
          {"domain_current", span_text(d.current_min, d.current_max, unit_of(model.drive_unit))}};
}

std::vector<std::string> state_names(const DamperModel& model) {
  const auto* law = model_as<LawModel>(model);
  std::vector<std::string> names;
  if (!law) return names;
  for (const StateInfo& state : law->law().states) names.emplace_back(state.name);
  names.resize(std::max<std::size_t>(1, model.state_size()), "coil_current");
  return names;
}

/// A damper as a block whose command is its force.
CBlock damper_block(const ExportedModel& model, const ExportOptions& options) {
  const std::size_t size = std::max<std::size_t>(1, model.model.state_size());
  const double sample_time = export_sample_time(model, options);
  return {.name = export_name(model, options),
          .title = "a damper: " + model.model.name() + ". " + model.origin,
          .precision = precision_of(options),

          // The code of write_c_source, without its comments and guards.
          .header = "#define DAMPER_STATE_SIZE " + std::to_string(size) +
                    "\n#define DAMPER_SAMPLE_TIME " + c_number(sample_time) + "\n" +
                    std::string(c_text("damper_api.h")),
          .source = "\ntypedef damper_input DamperInput;\n" +
                    with_texts(c_model(model.model).code) + std::string(c_text("damper_api.c")),
          .step = "commands[0] = damper_step(&model, &input);",
          .inputs = {{"displacement", "m", "extension positive", "displacement"},
                     {"velocity", "m/s", "extension positive", "velocity"},
                     {"current", unit_of(model.drive_unit), "command to the coil", "current"}},
          .commands = {{"force", "N", "positive when it resists extension", "commands[0]"}},
          .state_size = size,
          .sample_time = sample_time,
          .version = options.version};
}

}  // namespace

std::vector<ExportedFile> write_onnx(const ExportedModel& model, const ExportOptions& options) {
  return files_of({.block = damper_block(model, options),
                   .first = "commands[0] = damper_force(&input, model.state);",
                   .states = state_names(model.model),
                   .facts = facts_of(model),
                   .signs = "extension positive; force positive when it resists extension",
                   .command = options.command});
}

std::vector<ExportedFile> write_onnx_block(const CBlockMaker& block, const ExportOptions& options) {
  ExportOptions own = options;
  own.precision = precision_of(options);
  const CBlock made = block(own);
  return files_of({.block = made,
                   .first = made.step,
                   .states = {},
                   .facts = {{"model", made.title}},
                   .signs = "z up, extension positive; forces positive when they resist extension",
                   .command = options.command});
}

}  // namespace dashpot
