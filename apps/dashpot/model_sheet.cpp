#include "model_sheet.h"

#include <fmt/core.h>

#include "dashpot/base/text.h"
#include "dashpot/damper/neural/mlp.h"
#include "dashpot/damper/registry.h"
#include "dashpot/output/safe_text.h"
#include "layout.h"

namespace dashpot::cli {
namespace {

const std::vector<std::string> kColumns = {"parameter", "unit",         "default",
                                           "bounds",    "over current", "meaning"};

ParameterLine parameter_line(const ParamInfo& p) {
  return {std::string(p.name),
          std::string(p.unit),
          format_number(p.value),
          format_number(p.lower) + " ... " + format_number(p.upper),
          std::string(name_of(p.form)) + (p.fixed ? ", fixed" : "") + (p.bias ? ", force zero" : ""),
          std::string(p.meaning)};
}

ModelSheet law_sheet(const Law& law) {
  ModelSheet sheet{.name = std::string(law.name),
                   .kind = "law",
                   .title = std::string(law.title),
                   .equation = std::string(law.equation),
                   .source = std::string(law.source),
                   .remarks = std::string(law.remarks)};
  if (law.needs_displacement) sheet.inputs.push_back("displacement");
  sheet.inputs.insert(sheet.inputs.end(), {"velocity", "current"});
  for (const StateInfo& state : law.states)
    sheet.states.push_back(std::string(state.name) + ", " + std::string(state.unit));
  for (const ParamInfo& p : law.params) {
    sheet.parameters.push_back(parameter_line(p));
    if (!p.fixed) sheet.numbers += coefficient_count(p.form);
  }
  return sheet;
}

ModelSheet network_sheet(const NetworkPreset& preset) {
  std::vector<std::size_t> layers = {preset.inputs.size()};
  layers.insert(layers.end(), preset.hidden.begin(), preset.hidden.end());
  layers.push_back(1);
  return {.name = std::string(preset.name),
          .kind = "network",
          .title = std::string(preset.title),
          .equation = std::string(preset.equation),
          .source = std::string(preset.source),
          .remarks = std::string(preset.remarks),
          .inputs = preset.inputs,
          .states = {},
          .parameters = {},
          .numbers = Mlp::parameter_count(layers)};
}

std::vector<std::string> cells(const ParameterLine& p) {
  return {p.name, p.unit, p.value, p.bounds, p.form, p.meaning};
}

std::string facts(const ModelSheet& sheet) {
  std::string text = "inputs: " + join(sheet.inputs, ", ") + "; ";
  text += sheet.states.empty() ? "no state" : "states: " + join(sheet.states, "; ");
  return text + fmt::format("; {} numbers to fit", sheet.numbers);
}

}  // namespace

ModelSheet model_sheet(const std::string& name) {
  return is_law(name) ? law_sheet(find_law(name)) : network_sheet(find_network_preset(name));
}

std::string sheet_text(const ModelSheet& sheet, int width) {
  const auto columns = static_cast<std::size_t>(width);
  std::string text = fmt::format("{} ({}): {}\n\n", sheet.name, sheet.kind, sheet.title);
  for (const std::string& line : split(sheet.equation, '\n')) text += "    " + line + '\n';
  text += '\n' + paragraph(facts(sheet), columns);
  if (!sheet.parameters.empty()) {
    Table table({"parameter", "unit", ">default", ">bounds", "over current", "meaning"});
    for (const ParameterLine& p : sheet.parameters) table.row(cells(p));
    text += '\n' + table.text(columns);
  }
  text += '\n' + paragraph("Source: " + sheet.source, columns);
  if (!sheet.remarks.empty()) text += paragraph("Remarks: " + sheet.remarks, columns);
  return text;
}

std::string sheet_markdown(const ModelSheet& sheet) {
  std::string text = "## `" + sheet.name + "`: " + sheet.title + "\n\n```\n" + sheet.equation + "\n```\n\n" +
                     facts(sheet) + ".\n\n";
  if (!sheet.parameters.empty()) {
    text += markdown_row(kColumns) + "|---|---|---|---|---|---|\n";
    for (const ParameterLine& p : sheet.parameters) text += markdown_row(cells(p));
    text += '\n';
  }
  text += "Source: " + sheet.source + "\n";
  return sheet.remarks.empty() ? text : text + "\nRemarks: " + sheet.remarks + "\n";
}

Value sheet_json(const ModelSheet& sheet) {
  Value parameters = Value::array();
  if (sheet.kind == "law")
    for (const ParamInfo& p : find_law(sheet.name).params)
      parameters.push_back(Value::object({{"name", p.name},
                                          {"unit", p.unit},
                                          {"default", p.value},
                                          {"lower", p.lower},
                                          {"upper", p.upper},
                                          {"form", name_of(p.form)},
                                          {"fixed", p.fixed},
                                          {"bias", p.bias},
                                          {"meaning", p.meaning}}));
  return Value::object({{"name", sheet.name},
                        {"kind", sheet.kind},
                        {"title", sheet.title},
                        {"equation", sheet.equation},
                        {"inputs", Value::array(sheet.inputs)},
                        {"states", Value::array(sheet.states)},
                        {"parameters", std::move(parameters)},
                        {"numbers", sheet.numbers},
                        {"source", sheet.source},
                        {"remarks", sheet.remarks}});
}

}  // namespace dashpot::cli
