#include "model_sheet.h"

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/inverse/polynomial.h"
#include "dashpot/damper/kinds/family/family_force.h"
#include "dashpot/damper/kinds/family/line_family.h"
#include "dashpot/damper/kinds/family/physics_family.h"
#include "dashpot/damper/kinds/family/presets.h"
#include "dashpot/damper/kinds/fuzzy/presets.h"
#include "dashpot/damper/kinds/hybrid/hybrid_model.h"
#include "dashpot/damper/kinds/hybrid/presets.h"
#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"
#include "dashpot/damper/kinds/hysteresis_network/presets.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/narx/presets.h"
#include "dashpot/damper/kinds/network/presets.h"
#include "dashpot/damper/kinds/passive_hybrid/presets.h"
#include "dashpot/damper/kinds/passive_network/passive_network.h"
#include "dashpot/damper/kinds/passive_network/presets.h"
#include "dashpot/damper/kinds/state_space/presets.h"
#include "dashpot/damper/kinds/state_space/state_space_model.h"
#include "dashpot/damper/nets/mlp.h"
#include "dashpot/damper/registry.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/fit.h"
#include "layout.h"

namespace dashpot::cli {
namespace {

const std::vector<std::string> kColumns = {"parameter", "unit",         "default",
                                           "bounds",    "over current", "meaning"};

/// How a role in the fit is called in JSON, and the words that follow the form in a table for
/// people.
struct RoleWords {
  std::string_view name, words;
};

RoleWords words_of(Fit fit) {
  switch (fit) {
    case Fit::Free:
      return {"free", ""};
    case Fit::Rises:
      return {"rises", ", not falling"};
    case Fit::Fixed:
      return {"fixed", ", fixed"};
    case Fit::Scale:
      return {"scale", ", size of the data"};
    case Fit::Drive:
      return {"drive", " (the coil current)"};
    case Fit::Bias:
      return {"bias", ", force zero"};
  }
  return {};
}

ParameterLine parameter_line(const ParamInfo& p) {
  return {std::string(p.name),
          std::string(p.unit),
          format_number(p.value),
          format_number(p.lower) + " ... " + format_number(p.upper),
          std::string(name_of(p.form)) + std::string(words_of(p.fit).words),
          std::string(p.meaning)};
}

/// The law with every parameter that may follow the current doing so, each at a pace of its own.
LawModel driven_example(const Law& law) {
  Dependence d;
  for (const ParamInfo& param : law.params) {
    const bool follows = is_estimated(param.fit) && param.form != Form::Constant;
    const double pace = 0.3 + 0.05 * static_cast<double>(d.forms.size());
    d.forms.push_back(follows || param.fit == Fit::Drive ? Form::Linear : Form::Constant);
    d.coefficients.push_back(param.fit == Fit::Drive ? std::vector<double>{0, 1}
                             : follows ? std::vector<double>{param.value, pace * param.value}
                                       : std::vector<double>{param.value});
  }
  return LawModel(law, std::move(d), DriveUnit::Ampere, 0);
}

/// Says how a wanted force becomes a current.
std::string inverse_of(const Law& law) {
  try {
    PolynomialInverse(driven_example(law), InverseLimits{});
    return "closed form";
  } catch (const Error&) {
    return "search";
  }
}

/// States and parameters of a law, alone or inside a hybrid.
void add_table(ModelSheet& sheet, const Law& law) {
  for (const StateInfo& state : law.states)
    sheet.states.push_back(std::string(state.name) + ", " + std::string(state.unit));
  for (const ParamInfo& p : law.params) {
    sheet.parameters.push_back(parameter_line(p));
    if (is_estimated(p.fit)) sheet.numbers += coefficient_count(p.form);
  }
}

/// `count` times the same state.
void add_states(ModelSheet& sheet, std::size_t count, const std::string& state) {
  sheet.states.insert(sheet.states.end(), count, state);
}

/// Weights of a perceptron between so many inputs and one force.
std::size_t weights(std::size_t inputs, const std::vector<std::size_t>& hidden) {
  std::vector<std::size_t> layers{inputs};
  layers.insert(layers.end(), hidden.begin(), hidden.end());
  layers.push_back(1);
  return Mlp::parameter_count(layers);
}

// One per kind: its states, and how many numbers its fit finds.

void describe_law(ModelSheet& sheet) {
  const Law& law = find_law(sheet.name);
  sheet.inverse = inverse_of(law);
  add_table(sheet, law);
}

void describe(ModelSheet& sheet, const NetworkPreset& preset) {
  sheet.numbers = weights(preset.inputs.size(), preset.hidden);
}

void describe(ModelSheet& sheet, const NarxPreset& preset) {
  sheet.numbers =
      weights(preset.inputs.size() * (preset.delays + 1) + preset.feedback, preset.hidden);
  for (const std::string& input : preset.inputs)
    add_states(sheet, preset.delays + 1, "past " + input);
  add_states(sheet, preset.feedback + 1, "past force, N");
  add_states(sheet, 1, "time in the step, s");
  add_states(sheet, 1, "diverged, 1");
}

void describe(ModelSheet& sheet, const FuzzyPreset& preset) {
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

void describe(ModelSheet& sheet, const HybridPreset& preset) {
  add_table(sheet, *preset.law);
  GatedNetwork network;
  network.currents = 1 + preset.current_lags;
  network.signals.resize(2 + preset.law->needs_displacement + preset.law->states.size() +
                         preset.path_states + preset.velocity_lags + network.currents);
  network.initialise(preset.hidden, 0);
  sheet.numbers += network.parameter_count();
  add_states(sheet, preset.path_states, "w, 1");
  add_states(sheet, preset.velocity_lags, "y, m/s");
  add_states(sheet, preset.current_lags, "u, A");
}

void describe(ModelSheet& sheet, const HysteresisNetworkPreset& preset) {
  HysteresisNetwork member;
  member.bank.path_rates.resize(preset.path_states);
  member.bank.velocity_rates.resize(preset.velocity_lags);
  member.bank.current_rates.resize(preset.current_lags);
  member.network.currents = preset.current_lags;
  member.network.signals.resize(member.bank.signal_count());
  member.network.initialise(preset.hidden, 0);
  sheet.numbers = preset.members * member.parameter_count();
  add_states(sheet, preset.members * preset.path_states, "w, 1");
  add_states(sheet, preset.members * preset.velocity_lags, "y, m/s");
  add_states(sheet, preset.members * preset.current_lags, "u, A");
}

void describe(ModelSheet& sheet, const FamilyPreset& preset) {
  if (preset.form == FamilyForm::Network) {
    sheet.numbers = weights(preset.inputs.size(), preset.hidden);
    return;
  }
  if (preset.form == FamilyForm::Line) {
    sheet.numbers = 2 * FamilyLine::kMostFeatures + 1;
    add_states(sheet, 1, "q, m/s");
    return;
  }
  if (preset.form == FamilyForm::Physics) {
    sheet.numbers = kPhysicsNumbers + 1;
    add_states(sheet, 2, "f, N");
    add_states(sheet, 1, "p, m/s");
    return;
  }

  // Gates stand over a bank of states.
  FamilyGates gates;
  gates.bank.path_rates.resize(preset.path_states);
  gates.bank.velocity_rates.resize(preset.velocity_lags);
  gates.soft_speeds.resize(FamilyGates::kSoftSpeeds);
  sheet.numbers = gates.term_count() * FamilyGates::kGates;
  add_states(sheet, preset.path_states, "w, 1");
  add_states(sheet, preset.velocity_lags, "y, m/s");
}

void describe(ModelSheet& sheet, const StateSpacePreset& preset) {
  StateSpaceNetwork member;
  member.cell.path_rates.resize(preset.path_states);
  member.cell.lag_rates.resize(preset.lags);
  member.cell.current_rates.resize(preset.current_lags);
  member.cell.initialise(preset.hidden, 0);
  member.network.currents = preset.current_lags;
  member.network.signals.resize(member.cell.signal_count());
  member.network.initialise(preset.output_hidden, 0);
  sheet.numbers = preset.members * member.parameter_count();
  add_states(sheet, preset.members * preset.path_states, "x, 1");
  add_states(sheet, preset.members * preset.lags, "y, 1");
  add_states(sheet, preset.members * preset.current_lags, "u, 1");
}

void describe(ModelSheet& sheet, const PassiveNetworkPreset& preset) {
  sheet.numbers += preset.members * PassiveLayout(preset.sizes).count;
  add_states(sheet, preset.members, "q, 1 (where the drive varies)");
  add_states(sheet, preset.members * preset.sizes.memories, "u, 1");
  add_states(sheet, preset.members * preset.sizes.springs, "s, 1");
  add_states(sheet, preset.members, "w, 1");
}

void describe(ModelSheet& sheet, const PassiveHybridPreset& preset) {
  add_table(sheet, *preset.law);
  describe(sheet, *preset.network);
  ++sheet.numbers;  // the share
}

void describe_mean(ModelSheet& sheet) { add_states(sheet, 1, "those of its members"); }

template <auto presets>
void describe_preset(ModelSheet& sheet) {
  describe(sheet, find_preset(presets(), sheet.name));
}

struct KindDescription {
  ModelKind kind;
  void (*describe)(ModelSheet& sheet);  ///< adds to a sheet that has its name
};
constexpr std::array kDescriptions{
    KindDescription{ModelKind::Law, describe_law},
    KindDescription{ModelKind::Network, describe_preset<network_presets>},
    KindDescription{ModelKind::Narx, describe_preset<narx_presets>},
    KindDescription{ModelKind::HysteresisNetwork, describe_preset<hysteresis_network_presets>},
    KindDescription{ModelKind::StateSpace, describe_preset<state_space_presets>},
    KindDescription{ModelKind::PassiveNetwork, describe_preset<passive_network_presets>},
    KindDescription{ModelKind::Fuzzy, describe_preset<fuzzy_presets>},
    KindDescription{ModelKind::Hybrid, describe_preset<hybrid_presets>},
    KindDescription{ModelKind::PassiveHybrid, describe_preset<passive_hybrid_presets>},
    KindDescription{ModelKind::Family, describe_preset<family_presets>},
    KindDescription{ModelKind::Mean, describe_mean},
};

std::vector<std::string> cells(const ParameterLine& p) {
  return {p.name, p.unit, p.value, p.bounds, p.form, p.meaning};
}

/// "20 x w, 1; u, A": neighbouring states of one name are counted.
std::string states_text(const std::vector<std::string>& states) {
  std::vector<std::string> parts;
  for (auto at = states.begin(); at != states.end();) {
    const auto end = std::find_if(at, states.end(), [&](const std::string& s) { return s != *at; });
    parts.push_back((end - at > 1 ? std::to_string(end - at) + " x " : "") + *at);
    at = end;
  }
  return "states: " + join(parts, "; ");
}

/// A relation, indented; what does not fit into a line goes on below, further in.
std::string equation_text(const std::string& relation, std::size_t columns) {
  constexpr std::size_t kIndent = 4;
  std::string text, indent(kIndent, ' ');
  if (kIndent + columns_of(relation) <= columns) return indent + relation + '\n';
  for (const std::string& part : wrap(relation, columns - 2 * kIndent)) {
    text += indent + part + '\n';
    indent.assign(2 * kIndent, ' ');
  }
  return text;
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
  const ModelInfo& info = model_info(name);
  ModelSheet sheet{.name = name,
                   .kind = std::string(name_of(info.kind)),
                   .title = std::string(info.title),
                   .equation = std::string(info.equation),
                   .source = std::string(info.source),
                   .remarks = std::string(info.remarks),
                   .inputs = info.inputs,
                   .settings = network_settings_of(name)};
  if (is_law(name)) sheet.dissipates = find_law(name).dissipates;
  if (info.kind == ModelKind::Mean)
    sheet.dissipates = "Where all of its members do: what they take out adds up.";
  if (info.kind == ModelKind::PassiveHybrid)
    sheet.dissipates = "The network always; the law at constant drive. The law: " +
                       std::string(info.law->dissipates);
  row_of<kDescriptions>(info.kind).describe(sheet);
  return sheet;
}

std::string sheet_text(const ModelSheet& sheet, int width) {
  const auto columns = static_cast<std::size_t>(width);
  std::string text =
      paragraph(fmt::format("{} ({}): {}", sheet.name, sheet.kind, sheet.title), columns) + '\n';
  for (const std::string& line : split(sheet.equation, '\n')) text += equation_text(line, columns);
  text += '\n' + paragraph(facts(sheet), columns);
  if (!sheet.parameters.empty()) {
    Table table({"parameter", "unit", ">default", ">bounds", "over current", "meaning"});
    for (const ParameterLine& p : sheet.parameters) table.row(cells(p));
    text += '\n' + table.text(columns);
  }
  if (!sheet.dissipates.empty())
    text += '\n' + paragraph("Dissipates: " + sheet.dissipates, columns);
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
  if (!sheet.dissipates.empty()) text += "Dissipates: " + sheet.dissipates + "\n\n";
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
                                          {"fit", words_of(p.fit).name},
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
                        {"dissipates", sheet.dissipates},
                        {"source", sheet.source},
                        {"remarks", sheet.remarks}});
}

}  // namespace dashpot::cli
