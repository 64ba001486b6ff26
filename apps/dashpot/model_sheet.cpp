#include "model_sheet.h"

#include <algorithm>

#include <fmt/core.h>

#include "dashpot/base/text.h"
#include "dashpot/damper/inverse/polynomial.h"
#include "dashpot/damper/kinds/family/family_force.h"
#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/state_space/state_space_model.h"
#include "dashpot/damper/nets/mlp.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/network_design.h"
#include "dashpot/report/safe_text.h"
#include "layout.h"

namespace dashpot::cli {
namespace {

const std::vector<std::string> kColumns = {"parameter", "unit",         "default",
                                           "bounds",    "over current", "meaning"};

std::string_view fit_name(Fit fit) {
  constexpr std::string_view kNames[] = {"free", "fixed", "scale", "drive", "bias"};
  return kNames[static_cast<std::size_t>(fit)];
}

/// What follows the form in a table for people.
std::string words_of(Fit fit) {
  constexpr std::string_view kWords[] = {"", ", fixed", ", size of the data", " (the coil current)",
                                         ", force zero"};
  return std::string(kWords[static_cast<std::size_t>(fit)]);
}

ParameterLine parameter_line(const ParamInfo& p) {
  return {std::string(p.name),
          std::string(p.unit),
          format_number(p.value),
          format_number(p.lower) + " ... " + format_number(p.upper),
          std::string(name_of(p.form)) + words_of(p.fit),
          std::string(p.meaning)};
}

void add_table(ModelSheet& sheet, const Law& law) {
  for (const StateInfo& state : law.states)
    sheet.states.push_back(std::string(state.name) + ", " + std::string(state.unit));
  for (const ParamInfo& p : law.params) {
    sheet.parameters.push_back(parameter_line(p));
    if (is_estimated(p.fit)) sheet.numbers += coefficient_count(p.form);
  }
}

/// The law with every parameter that may follow the current doing so, each at a pace of its own.
LawModel driven_example(const Law& law) {
  Dependence d;
  for (const ParamInfo& param : law.params) {
    const bool follows = param.fit == Fit::Free && param.form != Form::Constant;
    const double pace = 0.3 + 0.05 * static_cast<double>(d.forms.size());
    d.forms.push_back(follows || param.fit == Fit::Drive ? Form::Linear : Form::Constant);
    d.coefficients.push_back(param.fit == Fit::Drive ? std::vector<double>{0, 1}
                             : follows ? std::vector<double>{param.value, pace * param.value}
                                       : std::vector<double>{param.value});
  }
  return LawModel(law, std::move(d), DriveUnit::Ampere, 0);
}

/// How a wanted force becomes a current.
std::string inverse_of(const Law& law) {
  try {
    PolynomialInverse(driven_example(law), InverseLimits{});
    return "closed form";
  } catch (const Error&) {
    return "search";
  }
}

void add_numbers(ModelSheet& sheet, const NetworkPreset& preset) {
  std::vector<std::size_t> layers = {preset.inputs.size() * (preset.delays + 1) + preset.feedback};
  layers.insert(layers.end(), preset.hidden.begin(), preset.hidden.end());
  layers.push_back(1);
  sheet.numbers = Mlp::parameter_count(layers);
  if (preset.feedback == 0) return;
  for (const std::string& input : preset.inputs)
    sheet.states.insert(sheet.states.end(), preset.delays + 1, "past " + input);
  sheet.states.insert(sheet.states.end(), preset.feedback + 1, "past force, N");
  sheet.states.insert(sheet.states.end(), {"time in the step, s", "diverged, 1"});
}

void add_numbers(ModelSheet& sheet, const FuzzyPreset& preset) {
  std::size_t rules = 1, sets = 0;
  for (const std::size_t count : preset.sets) {
    rules *= count;
    sets += count > 1 ? count : 0;
  }
  sheet.numbers =
      sets * Membership{preset.shape}.parameter_count() + rules * (preset.inputs.size() + 1);
  const auto change = std::find(preset.inputs.begin(), preset.inputs.end(), "velocity_change");
  if (change == preset.inputs.end()) return;
  sheet.states.emplace_back("v_past, m/s");
  ++sheet.numbers;  // its lag
}

void add_numbers(ModelSheet& sheet, const HybridPreset& preset) {
  add_table(sheet, *preset.law);
  GatedNetwork network;
  network.currents = 1 + preset.current_lags;
  network.signals.resize(2 + preset.law->needs_displacement + preset.law->states.size() +
                         preset.path_states + preset.velocity_lags + network.currents);
  network.initialise(preset.hidden, 0);
  sheet.numbers += network.parameter_count();
  sheet.states.insert(sheet.states.end(), preset.path_states, "w, 1");
  sheet.states.insert(sheet.states.end(), preset.velocity_lags, "y, m/s");
  sheet.states.insert(sheet.states.end(), preset.current_lags, "u, A");
}

void add_numbers(ModelSheet& sheet, const StateNetworkPreset& preset) {
  BankNetwork member;
  member.bank.path_rates.resize(preset.path_states);
  member.bank.velocity_rates.resize(preset.velocity_lags);
  member.bank.current_rates.resize(preset.current_lags);
  member.network.currents = preset.current_lags;
  member.network.signals.resize(member.bank.signal_count());
  member.network.initialise(preset.hidden, 0);
  sheet.numbers = preset.members * member.parameter_count();
  sheet.states.insert(sheet.states.end(), preset.members * preset.path_states, "w, 1");
  sheet.states.insert(sheet.states.end(), preset.members * preset.velocity_lags, "y, m/s");
  sheet.states.insert(sheet.states.end(), preset.members * preset.current_lags, "u, A");
}

void add_numbers(ModelSheet& sheet, const FamilyPreset& preset) {
  if (!preset.inputs.empty()) {
    std::vector<std::size_t> layers = {preset.inputs.size()};
    layers.insert(layers.end(), preset.hidden.begin(), preset.hidden.end());
    layers.push_back(1);
    sheet.numbers = Mlp::parameter_count(layers);
    return;
  }
  FamilyGates gates;
  gates.bank.path_rates.resize(preset.path_states);
  gates.bank.velocity_rates.resize(preset.velocity_lags);
  gates.soft_speeds.resize(FamilyGates::kSoftSpeeds);
  sheet.numbers = gates.term_count() * FamilyGates::kGates;
  sheet.states.insert(sheet.states.end(), preset.path_states, "w, 1");
  sheet.states.insert(sheet.states.end(), preset.velocity_lags, "y, m/s");
}

void add_numbers(ModelSheet& sheet, const StateSpacePreset& preset) {
  StateSpaceNetwork member;
  member.cell.path_rates.resize(preset.path_states);
  member.cell.lag_rates.resize(preset.lags);
  member.cell.current_rates.resize(preset.current_lags);
  member.cell.initialise(preset.hidden, 0);
  member.network.currents = preset.current_lags;
  member.network.signals.resize(member.cell.signal_count());
  member.network.initialise(preset.output_hidden, 0);
  sheet.numbers = preset.members * member.parameter_count();
  sheet.states.insert(sheet.states.end(), preset.members * preset.path_states, "x, 1");
  sheet.states.insert(sheet.states.end(), preset.members * preset.lags, "y, 1");
  sheet.states.insert(sheet.states.end(), preset.members * preset.current_lags, "u, 1");
}

std::vector<std::string> cells(const ParameterLine& p) {
  return {p.name, p.unit, p.value, p.bounds, p.form, p.meaning};
}

/// "20 x w, 1; u, A": states of one name told together.
std::string states_text(const std::vector<std::string>& states) {
  std::vector<std::string> told;
  for (auto at = states.begin(); at != states.end();) {
    const auto end = std::find_if(at, states.end(), [&](const std::string& s) { return s != *at; });
    told.push_back((end - at > 1 ? std::to_string(end - at) + " x " : "") + *at);
    at = end;
  }
  return "states: " + join(told, "; ");
}

std::string facts(const ModelSheet& sheet) {
  std::string text = "inputs: " + join(sheet.inputs, ", ") + "; ";
  text += sheet.states.empty() ? "no state" : states_text(sheet.states);
  text += fmt::format("; {} numbers to fit; inverse: {}", sheet.numbers, sheet.inverse);
  if (sheet.settings.empty()) return text;
  return text + "; follows --network " + join({sheet.settings.begin(), sheet.settings.end()}, ", ");
}

}  // namespace

ModelSheet model_sheet(const std::string& name) {
  const ModelInfo info = model_info(name);
  ModelSheet sheet{.name = name,
                   .kind = std::string(info.kind),
                   .title = std::string(info.title),
                   .equation = std::string(info.equation),
                   .source = std::string(info.source),
                   .remarks = std::string(info.remarks),
                   .inputs = info.inputs,
                   .inverse = is_law(name) ? inverse_of(find_law(name)) : "search",
                   .settings = network_settings_of(name)};
  if (is_law(name))
    add_table(sheet, find_law(name));
  else if (info.kind == "network" || info.kind == "narx")
    add_numbers(sheet, find_network_preset(name));
  else if (info.kind == "state_network")
    add_numbers(sheet, find_state_network_preset(name));
  else if (info.kind == "state_space")
    add_numbers(sheet, find_state_space_preset(name));
  else if (info.kind == "hybrid")
    add_numbers(sheet, find_hybrid_preset(name));
  else if (info.kind == "family")
    add_numbers(sheet, find_family_preset(name));
  else
    add_numbers(sheet, find_fuzzy_preset(name));
  return sheet;
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
  std::string text = "## `" + sheet.name + "`: " + sheet.title + "\n\n```\n" + sheet.equation +
                     "\n```\n\n" + facts(sheet) + ".\n\n";
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
  if (const Law* law = law_inside(sheet.name))
    for (const ParamInfo& p : law->params)
      parameters.push_back(Value::object({{"name", p.name},
                                          {"unit", p.unit},
                                          {"default", p.value},
                                          {"lower", p.lower},
                                          {"upper", p.upper},
                                          {"form", name_of(p.form)},
                                          {"fit", fit_name(p.fit)},
                                          {"meaning", p.meaning}}));
  return Value::object({{"name", sheet.name},
                        {"kind", sheet.kind},
                        {"title", sheet.title},
                        {"equation", sheet.equation},
                        {"inputs", Value::array(sheet.inputs)},
                        {"states", Value::array(sheet.states)},
                        {"parameters", std::move(parameters)},
                        {"numbers", sheet.numbers},
                        {"inverse", sheet.inverse},
                        {"network", Value::array(std::vector<std::string>(sheet.settings.begin(),
                                                                          sheet.settings.end()))},
                        {"source", sheet.source},
                        {"remarks", sheet.remarks}});
}

}  // namespace dashpot::cli
