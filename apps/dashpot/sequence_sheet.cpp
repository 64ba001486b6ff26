#include "sequence_sheet.h"

#include "dashpot/base/text.h"
#include "dashpot/damper/bench_experiments.h"
#include "layout.h"

namespace dashpot::cli {

static constexpr std::size_t kIndent = 2;

std::string sheet_text(const SequenceInfo& info, std::size_t width) {
  std::string text = '\n' + std::string(info.name) + "  " + std::string(info.title) + '\n' +
                     paragraph(info.equation, width, kIndent) +
                     paragraph(info.remarks, width, kIndent) +
                     paragraph("source: " + std::string(info.source), width, kIndent);
  if (info.params.empty()) return text;
  Table table({"parameter", ">default", "unit", "meaning"});
  for (const ParameterRow& param : info.params)
    table.row({std::string(param.name), format_number(param.value), std::string(param.unit),
               std::string(param.meaning)});
  return text + table.text(width, kIndent);
}

Value sheet_json(const SequenceInfo& info) {
  Value params = Value::array();
  for (const ParameterRow& param : info.params)
    params.push_back(Value::object({{"name", param.name},
                                    {"unit", param.unit},
                                    {"default", param.value},
                                    {"lower", param.lower},
                                    {"upper", param.upper},
                                    {"meaning", param.meaning}}));

  return Value::object({{"name", info.name},
                        {"title", info.title},
                        {"equation", info.equation},
                        {"source", info.source},
                        {"remarks", info.remarks},
                        {"parameters", std::move(params)}});
}

namespace {

template <class Sequences>
Value list_json(const Sequences& sequences) {
  Value list = Value::array();
  for (const auto& sequence : sequences) list.push_back(sheet_json(sequence.info));
  return list;
}

std::string text_of(const Excitation& excitation) {
  return std::string(excitation.motion) + " with " + std::string(excitation.drive);
}

}  // namespace

std::string sequences_text(int width) {
  const auto columns = static_cast<std::size_t>(width);
  std::string text = "Sequences of motion (--motion)\n";
  for (const MotionSequence& sequence : motion_sequences())
    text += sheet_text(sequence.info, columns);
  text += "\nSequences of current or voltage (--drive)\n";
  for (const DriveSequence& sequence : drive_sequences())
    text += sheet_text(sequence.info, columns);
  Table table({"experiment", "damper of any current", "damper of two levels"});
  for (const BenchExperiment& experiment : bench_experiments())
    table.row({std::string(experiment.name), text_of(experiment.continuous),
               text_of(experiment.switched)});
  return text + "\nExperiments of the one-sensor paper (--experiment)\n\n" + table.text(columns);
}

Value sequences_json() {
  Value experiments = Value::array();
  const auto json_of = [](const Excitation& excitation) {
    return Value::object({{"motion", excitation.motion}, {"drive", excitation.drive}});
  };
  for (const BenchExperiment& experiment : bench_experiments())
    experiments.push_back(Value::object({{"name", experiment.name},
                                         {"title", experiment.title},
                                         {"continuous", json_of(experiment.continuous)},
                                         {"switched", json_of(experiment.switched)}}));
  return Value::object({{"motions", list_json(motion_sequences())},
                        {"drives", list_json(drive_sequences())},
                        {"experiments", std::move(experiments)}});
}

}  // namespace dashpot::cli
