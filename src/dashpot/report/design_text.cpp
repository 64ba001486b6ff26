// The report of a design run for a terminal, as Markdown and as CSV.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/design_report.h"
#include "dashpot/report/safe_text.h"
#include "dashpot/report/text_table.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

std::string with_unit(std::string_view name, std::string_view si_unit) {
  const std::string unit = shown_unit(si_unit).unit;
  return std::string(name) + (unit.empty() ? "" : " " + unit);
}

std::string shown(double value, std::string_view si_unit) {
  return number_text(value / shown_unit(si_unit).factor, 4);
}

std::string variable_text(const DesignVariable& variable, const DamperDescription& damper) {
  if (!variable.field) return std::string(damper.fluid->name);
  return shown(damper.*variable.field->field, variable.field->unit);
}

/// Its role, and whether a family's model extrapolates.
std::string design_note(const Design& design) {
  if (design.outside.empty()) return design.role;
  return design.role + (design.role.empty() ? "" : "; ") + "beyond the family";
}

std::vector<TextColumn> design_columns(const DesignReport& report) {
  std::vector<TextColumn> columns{{"Design"}};
  for (const DesignVariable& variable : report.request.variables)
    columns.push_back(
        {variable.field ? with_unit(variable.name(), variable.field->unit) : variable.name(), true,
         2});
  for (const DesignGoal& goal : report.request.goals)
    columns.push_back({with_unit(goal.quantity->name, goal.quantity->unit), true});
  if (!report.second_name.empty()) columns.push_back({"Models differ %", true, 1});
  columns.push_back({"Note", false, 0, true});
  return columns;
}

std::vector<std::string> design_row(const DesignReport& report, const Design& design) {
  std::vector<std::string> row{design.name};
  for (const DesignVariable& variable : report.request.variables)
    row.push_back(variable_text(variable, design.damper));
  for (std::size_t k = 0; k < report.request.goals.size(); ++k)
    row.push_back(shown(design.assessment.goals[k], report.request.goals[k].quantity->unit));
  if (!report.second_name.empty()) row.push_back(percent_text(100 * design.disagreement));
  row.push_back(design_note(design));
  return row;
}

/// Those that stand out, then as many others as fit, evenly from the front; all in its order.
std::vector<const Design*> selection(const DesignReport& report, std::size_t most) {
  const std::size_t count = report.designs.size();
  std::vector<bool> taken(count, false);
  std::size_t number = 0;
  for (std::size_t k = 0; k < count; ++k) number += taken[k] = !report.designs[k].role.empty();
  const std::size_t room = most > number ? most - number : 0,
                    step = room ? count / room + 1 : count + 1;
  for (std::size_t k = 0; k < count; k += step) taken[k] = true;
  std::vector<const Design*> chosen;
  for (std::size_t k = 0; k < count; ++k)
    if (taken[k] || count <= most) chosen.push_back(&report.designs[k]);
  return chosen;
}

std::vector<std::vector<std::string>> design_rows(const DesignReport& report, std::size_t most) {
  std::vector<std::vector<std::string>> rows;
  for (const Design* design : selection(report, most)) rows.push_back(design_row(report, *design));
  return rows;
}

std::string conflict_verdict(const DesignReport& report) {
  const Conflict& conflict = *report.conflict;
  if (conflict.undrawable) return "There is no design: " + describe(conflict, report.request) + ".";
  std::vector<std::string> lines = split(describe(conflict, report.request), '\n');
  std::erase(lines, "");
  if (lines.size() == 1) return "There is no design. It cannot hold: " + lines.front() + ".";
  return fmt::format(
      "There is no design. These {} constraints cannot hold together; without any one of them the "
      "rest "
      "can:\n* {}",
      lines.size(), join(lines, "\n* "));
}

/// What is to be known of designs beyond a family, and of how far two models agree.
std::string models_verdict(const DesignReport& report) {
  std::string text;
  const auto outside =
      std::ranges::count_if(report.designs, [](const Design& d) { return !d.outside.empty(); });
  if (outside > 0)
    text += fmt::format(" {} of them {} beyond the dampers that the family's model was fitted on.",
                        outside, outside == 1 ? "lies" : "lie");
  if (report.second_name.empty()) return text;
  double most = 0;
  for (const Design& design : report.designs) most = std::max(most, design.disagreement);
  return text + fmt::format(" {} and {} differ by {} % at most.", report.first_name,
                            report.second_name, percent_text(100 * most));
}

std::string best_of(const DesignReport& report) {
  const DesignGoal& goal = report.request.goals.front();
  return fmt::format(
      "{}: {}", describe(goal),
      shown_figure(report.designs.front().assessment.goals.front(), goal.quantity->unit));
}

}  // namespace

std::string design_table(const DesignReport& report, int width, std::size_t most) {
  return text_table(design_columns(report), design_rows(report, most), width);
}

std::string constraint_table(const DesignReport& report, const Design& design, int width) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < report.request.constraints.size(); ++k) {
    const DesignConstraint& own = report.request.constraints[k];
    rows.push_back({describe(own), shown(design.assessment.constraints[k], own.quantity->unit),
                    shown_unit(own.quantity->unit).unit,
                    percent_text(100 * design.assessment.slack[k])});
    if (!report.second_name.empty())
      for (const auto* told : {&design.first, &design.second})
        rows.back().push_back(shown((*told)[report.request.goals.size() + k], own.quantity->unit));
  }
  std::vector<TextColumn> columns{
      {"Constraint", false, 0, true}, {"Reached", true}, {"Unit"}, {"Left over %", true}};
  if (!report.second_name.empty())
    for (const std::string& name : {report.first_name, report.second_name})
      columns.push_back({name, true, 1});
  return text_table(columns, rows, width);
}

std::string sensitivity_table(const DesignReport& report, const Design& design, int width) {
  if (!design.sensitivity) return {};
  const DesignRequest& request = report.request;
  std::vector<TextColumn> columns{
      {"Figure", false, 0, true}, {"Drawn", true}, {"90 % of those made", true}};
  for (const DesignTolerance& tolerance : request.tolerances)
    columns.push_back(
        {fmt::format("{} {}", tolerance.field->name, shown(tolerance.width, tolerance.field->unit)),
         true, 1});
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < design.sensitivity->figures.size(); ++k) {
    const Sensitivity::Figure& figure = design.sensitivity->figures[k];
    const bool is_goal = k < request.goals.size();
    const DesignQuantity& quantity = is_goal
                                         ? *request.goals[k].quantity
                                         : *request.constraints[k - request.goals.size()].quantity;
    if (std::ranges::all_of(figure.local, [](double value) { return value == 0; }))
      continue;  // none matters
    rows.push_back(
        {with_unit(quantity.name, quantity.unit), shown(figure.drawn, quantity.unit),
         shown(figure.low, quantity.unit) + " ... " + shown(figure.high, quantity.unit)});
    for (std::size_t t = 0; t < figure.local.size(); ++t)
      rows.back().push_back(fmt::format("{} ({} %)", shown(figure.local[t], quantity.unit),
                                        percent_text(100 * std::clamp(figure.total[t], 0., 1.))));
  }
  return text_table(columns, rows, width);
}

std::string design_verdict(const DesignReport& report) {
  if (report.conflict) return conflict_verdict(report);
  if (report.designs.empty())
    return report.stopped ? "Stopped before there was a design."
                          : "No design was found, although the constraints may hold: such designs "
                            "are rare. Widen a "
                            "range, or try another --seed.";
  std::string text = report.request.goals.size() == 1
                         ? best_of(report) + "."
                         : fmt::format("{} of which none is better than another in all goals.",
                                       counted(report.designs.size(), "design"));
  text += report.request.share > 0
              ? fmt::format(" {} % of the dampers made hold the constraints and reach the goals.",
                            number_text(100 * report.request.share))
              : " Every one holds all constraints, as drawn.";
  text += models_verdict(report);
  if (report.rejected)
    text += fmt::format(" {} failed when checked by themselves and are left out.",
                        counted(report.rejected, "design"));
  if (report.stopped) text += " Stopped early: the best so far.";
  return text;
}

std::string markdown_design(const DesignInput& input) {
  const DesignReport& report = input.design;
  std::string text =
      "# " + markdown_cell(report.request.name) + "\n\n" + design_verdict(report) + "\n";
  if (!report.designs.empty())
    text +=
        "\n" + markdown_table(design_columns(report), design_rows(report, report.designs.size()));
  text += "\nGoals: ";
  std::vector<std::string> goals, constraints;
  for (const DesignGoal& goal : report.request.goals) goals.push_back(describe(goal));
  for (const DesignConstraint& constraint : report.request.constraints)
    constraints.push_back(describe(constraint));
  text += join(goals, "; ") + ".\n";
  if (!constraints.empty()) text += "Constraints: " + join(constraints, "; ") + ".\n";
  for (const std::string& note : report.notes) text += "\nNote: " + note + ".\n";
  return text + "\nMade by `" + input.command + "`, Dashpot " + input.version + ".\n";
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
