// A design run for programs: JSON and CSV.
#include <cmath>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/report/design_report.h"

namespace dashpot {
namespace {

/// Name, unit, and the unit to show with what one of it is in SI.
Value named(std::string_view name, std::string_view unit, std::string_view meaning) {
  const ShownUnit shown = shown_unit(unit);
  return Value::object({{"name", name},
                        {"unit", unit},
                        {"shown_unit", shown.unit},
                        {"shown_factor", shown.factor},
                        {"meaning", meaning}});
}

Value variables_json(const DesignRequest& request) {
  Value list = Value::array();
  for (const DesignVariable& variable : request.variables)
    list.push_back(variable.field
                       ? named(variable.name(), variable.field->unit, variable.field->meaning)
                       : named("fluid", "1", "magnetorheological fluid"));
  return list;
}

Value goals_json(const DesignRequest& request) {
  Value list = Value::array();
  for (const DesignGoal& goal : request.goals) {
    Value json = named(goal.quantity->name, goal.quantity->unit, goal.quantity->meaning);
    json.add("text", describe(goal));
    json.add("maximise", goal.maximise);
    list.push_back(std::move(json));
  }
  return list;
}

Value constraints_json(const DesignRequest& request) {
  Value list = Value::array();
  for (const DesignConstraint& constraint : request.constraints) {
    Value json =
        named(constraint.quantity->name, constraint.quantity->unit, constraint.quantity->meaning);
    json.add("text", describe(constraint));
    json.add("by", constraint.by == ToldBy::Second ? "second" : "first");
    json.add("at_least", constraint.at_least);
    json.add("bound", constraint.bound);
    list.push_back(std::move(json));
  }
  return list;
}

Value tolerances_json(const DesignRequest& request) {
  Value list = Value::array();
  for (const DesignTolerance& tolerance : request.tolerances) {
    Value json = named(tolerance.field->name, tolerance.field->unit, tolerance.field->meaning);
    json.add("width", tolerance.width);
    list.push_back(std::move(json));
  }
  return list;
}

Value sensitivity_json(const Sensitivity& sensitivity) {
  Value figures = Value::array();
  for (const Sensitivity::Figure& figure : sensitivity.figures)
    figures.push_back(Value::object({{"drawn", figure.drawn},
                                     {"low", figure.low},
                                     {"high", figure.high},
                                     {"local", Value::array(figure.local)},
                                     {"variance_alone", Value::array(figure.alone)},
                                     {"variance_total", Value::array(figure.total)}}));
  return Value::object({{"holding", sensitivity.holding}, {"figures", std::move(figures)}});
}

Value design_json(const Design& design, const DesignRequest& request) {
  Value variables = Value::array();
  for (const DesignVariable& variable : request.variables)
    variables.push_back(variable.field ? Value(design.damper.*variable.field->field)
                                       : Value(design.damper.fluid->name));
  Value json = Value::object({{"name", design.name},
                              {"role", design.role},
                              {"variables", std::move(variables)},
                              {"goals", Value::array(design.assessment.goals)},
                              {"constraints", Value::array(design.assessment.constraints)},
                              {"slack", Value::array(design.assessment.slack)}});

  // Parts that only some designs have.
  if (!design.second.empty()) {
    json.add("first", Value::array(design.first));
    json.add("second", Value::array(design.second));
    json.add("disagreement", design.disagreement);
  }
  if (!design.outside.empty()) json.add("beyond_family", Value::array(design.outside));
  if (design.sensitivity) json.add("sensitivity", sensitivity_json(*design.sensitivity));
  return json;
}

Value conflict_json(const DesignReport& report) {
  if (!report.conflict) return {};
  Value members = Value::array();
  for (std::size_t m = 0; m < report.conflict->members.size(); ++m)
    members.push_back(Value::object(
        {{"constraint", describe(report.request.constraints[report.conflict->members[m]])},
         {"reached", report.conflict->reached[m]}}));
  return Value::object({{"undrawable", report.conflict->undrawable},
                        {"refused", report.conflict->refused},
                        {"members", std::move(members)}});
}

}  // namespace

Value json_design(const DesignInput& input) {
  const DesignReport& report = input.design;
  const DesignRequest& request = report.request;
  Value designs = Value::array();
  for (const Design& design : report.designs) designs.push_back(design_json(design, request));

  // Provenance first, then request and designs.
  return presentable(Value::object({{"format", "dashpot design 1"},
                                    {"version", input.version},
                                    {"date", input.date},
                                    {"command", input.command},
                                    {"name", request.name},
                                    {"note", request.note},
                                    {"model", report.first_name},
                                    {"second_model", report.second_name},
                                    {"notes", Value::array(report.notes)},
                                    {"seed", static_cast<double>(report.options.seed)},
                                    {"share", request.share},
                                    {"verdict", design_verdict(report)},
                                    {"variables", variables_json(request)},
                                    {"goals", goals_json(request)},
                                    {"constraints", constraints_json(request)},
                                    {"tolerances", tolerances_json(request)},
                                    {"designs", std::move(designs)},
                                    {"conflict", conflict_json(report)},
                                    {"rejected", report.rejected},
                                    {"evaluations", report.evaluations},
                                    {"wall_seconds", report.wall_seconds},
                                    {"stopped", report.stopped}}));
}

std::string csv_design(const DesignReport& report) {
  const DesignRequest& request = report.request;
  std::vector<std::string> titles{"design"};
  const auto title = [&](const std::string& name, std::string_view unit) {
    titles.push_back(csv_field(unit == "1" ? name : name + "[" + std::string(unit) + "]"));
  };
  for (const DesignVariable& variable : request.variables)
    title(variable.name(), variable.field ? variable.field->unit : "1");
  for (const DesignGoal& goal : request.goals) title(describe(goal), goal.quantity->unit);
  for (const DesignConstraint& constraint : request.constraints)
    title(describe(constraint), constraint.quantity->unit);
  const bool has_second = !report.second_name.empty();
  if (has_second) titles.emplace_back("disagreement");
  titles.emplace_back("beyond_family");
  titles.emplace_back("role");
  std::string text = join(titles, ",") + "\n";

  // A design beyond a family says in which sizes.
  for (const Design& design : report.designs) {
    std::vector<std::string> row{design.name};
    for (const DesignVariable& variable : request.variables)
      row.push_back(variable.field ? format_exact(design.damper.*variable.field->field)
                                   : std::string(design.damper.fluid->name));
    for (const auto* figures : {&design.assessment.goals, &design.assessment.constraints})
      for (const double figure : *figures)
        row.push_back(std::isfinite(figure) ? format_exact(figure) : "");
    if (has_second) row.push_back(format_exact(design.disagreement));
    row.push_back(csv_field(join(design.outside, "; ")));
    row.push_back(csv_field(design.role));
    text += join(row, ",") + "\n";
  }
  return text;
}

}  // namespace dashpot
