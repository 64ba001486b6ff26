// A design run for people: the front on axes of choice, all designs, constraints, tolerances.
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/design_report.h"
#include "dashpot/report/provenance.h"
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

/// Its role, and whether a family's model extrapolates.
std::string design_note(const Design& design) {
  if (design.outside.empty()) return design.role;
  return design.role + (design.role.empty() ? "" : "; ") + "beyond the family";
}

/// Those that stand out, then as many others as fit, evenly from the front; all in its order.
std::vector<std::size_t> selection(const DesignReport& report, std::size_t most) {
  const std::size_t count = report.designs.size();
  std::vector<bool> taken(count, false);
  std::size_t number = 0;
  for (std::size_t k = 0; k < count; ++k) number += taken[k] = !report.designs[k].role.empty();
  const std::size_t room = most > number ? most - number : 0,
                    step = room ? count / room + 1 : count + 1;
  for (std::size_t k = 0; k < count; k += step) taken[k] = true;
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < count; ++k)
    if (taken[k] || count <= most) chosen.push_back(k);
  return chosen;
}

std::string conflict_verdict(const DesignReport& report) {
  const Conflict& conflict = *report.conflict;
  if (conflict.undrawable || conflict.refused)
    return "There is no design: " + describe(conflict, report.request) + ".";
  std::vector<std::string> lines = split(describe(conflict, report.request), '\n');
  std::erase(lines, "");
  if (lines.size() == 1) return "There is no design. It cannot hold: " + lines.front() + ".";
  return fmt::format(
      "There is no design. These {} constraints cannot hold together; without any one of them the "
      "rest can:\n* {}",
      lines.size(), join(lines, "\n* "));
}

/// How many designs lie beyond a family, and how far two models agree.
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

/// Goals, then constraints: what a design is assessed by.
struct Assessed {
  const DesignQuantity* quantity;
  std::string text;
  std::string place;  ///< where the quantity is asked for at several
  std::optional<double> bound;

  /// "force N", "force N at 2 A, 1 m/s"
  std::string name() const { return with_unit(quantity->name, quantity->unit) + place; }
};
std::vector<Assessed> assessed(const DesignRequest& request) {
  std::vector<Assessed> all;
  for (const DesignGoal& goal : request.goals)
    all.push_back({goal.quantity, describe(goal), place_of(*goal.quantity, goal.at, goal.by), {}});
  for (const DesignConstraint& own : request.constraints)
    all.push_back(
        {own.quantity, describe(own), place_of(*own.quantity, own.at, own.by), own.bound});

  // A quantity that is asked for at one place alone needs no name of it.
  std::vector<bool> has_one_place;
  for (const Assessed& own : all)
    has_one_place.push_back(std::ranges::none_of(all, [&](const Assessed& other) {
      return other.quantity == own.quantity && other.place != own.place;
    }));
  for (std::size_t k = 0; k < all.size(); ++k)
    if (has_one_place[k]) all[k].place.clear();
  return all;
}

/// A figure in the unit that people read.
DocumentCell figure_cell(double value, std::string_view unit) {
  return {shown(value, unit), value};
}

/// The place of the design that is shown in full: the one that weighs all goals.
std::size_t knee_of(const DesignReport& report) {
  const auto knee = std::ranges::find_if(report.designs, [](const Design& design) {
    return design.role.find("knee") != std::string::npos;
  });
  return knee == report.designs.end() ? 0 : static_cast<std::size_t>(knee - report.designs.begin());
}

/// Every quantity that can stand on an axis.
DocumentPlane plane_of(const DesignReport& report) {
  const DesignRequest& request = report.request;
  DocumentPlane plane{
      .title = "Designs",
      .note = "Every point is a damper. Drag to zoom; a row of the table marks its point.",
      .quantities = {},
      .names = {},
      .outstanding = {},
      .points_label = "designs",
      .outstanding_label = "best of a goal, and the knee",
      .second_label = "by " + report.second_name,
      .choice = "design"};
  if (!report.second_name.empty())
    plane.note +=
        " Where a model has a band, its forces stand at the pessimistic end of it; what the models "
        "differ by is of the middles.";
  for (const Design& design : report.designs) {
    plane.names.push_back(design.name + (design.role.empty() ? "" : ", " + design.role));
    plane.outstanding.push_back(!design.role.empty());
  }
  const auto add = [&](const std::string& name, const std::string& quantity, std::string_view unit,
                       std::optional<double> bound, const auto& value, const auto& second) {
    const ShownUnit read = shown_unit(unit);
    DocumentPlane::Quantity axis{
        .name = name,
        .label = quantity + (read.unit.empty() ? "" : " (" + read.unit + ")"),
        .values = {},
        .second = {},
        .bound = {}};
    if (bound) axis.bound = *bound / read.factor;
    for (const Design& design : report.designs) {
      axis.values.push_back(value(design) / read.factor);
      if (const std::optional<double> other = second(design))
        axis.second.push_back(*other / read.factor);
    }
    plane.quantities.push_back(std::move(axis));
  };

  // Goals first: they are the axes at first.
  const std::vector<Assessed> figures = assessed(request);
  for (std::size_t k = 0; k < figures.size(); ++k)
    add(
        figures[k].text, std::string(figures[k].quantity->name) + figures[k].place,
        figures[k].quantity->unit, figures[k].bound,
        [&](const Design& design) {
          const std::size_t goals = request.goals.size();
          return k < goals ? design.assessment.goals[k] : design.assessment.constraints[k - goals];
        },
        [&](const Design& design) {
          return design.second.empty() ? std::nullopt : std::optional(design.second[k]);
        });
  for (const DesignVariable& variable : request.variables)
    if (variable.field)
      add(
          variable.name(), variable.name(), variable.field->unit, {},
          [&](const Design& design) { return design.damper.*variable.field->field; },
          [](const Design&) { return std::optional<double>(); });
  return plane;
}

Terms design_terms() {
  return {{"Design",
           "a damper that holds every constraint. Its description was written, read again and "
           "assessed anew before it was listed."},
          {"Front", "designs of which none is better than another in all goals."},
          {"Knee",
           "the design nearest to the best of all goals at once, each goal measured in its extent "
           "over the front."},
          {"Left over", "how far a figure is inside its bound, in shares of the bound."},
          {"Tolerance",
           "a made part lies anywhere within ±, all places alike. The cells say what the whole "
           "tolerance moves (derivative × tolerance); their shade is its share of the variance, "
           "with all it takes part in (Jansen 1999)."}};
}

std::vector<KeyFigure> key_figures(const DesignReport& report) {
  constexpr std::size_t kMost = 3;
  std::vector<KeyFigure> figures;
  if (report.designs.empty()) return figures;

  // The range of each goal over the designs.
  for (std::size_t k = 0; k < std::min(kMost, report.request.goals.size()); ++k) {
    const DesignGoal& goal = report.request.goals[k];
    const auto [low, high] = std::ranges::minmax(
        report.designs, {}, [&](const Design& design) { return design.assessment.goals[k]; });
    const std::string least = shown(low.assessment.goals[k], goal.quantity->unit),
                      most = shown(high.assessment.goals[k], goal.quantity->unit);
    figures.push_back({least == most ? least : least + " … " + most,
                       shown_unit(goal.quantity->unit).unit, describe(goal)});
  }
  figures.push_back({std::to_string(report.designs.size()), "",
                     report.designs.size() == 1 ? "design" : "designs"});
  return figures;
}

DocumentSection front_section(const DesignReport& report) {
  return {.name = "front",
          .title = "The front",
          .paragraphs = {},
          .lead = "Choose what stands on the axes: goals, constrained figures, or what varies.",
          .plane = plane_of(report),
          .audience = Audience::Page};
}

DocumentSection design_section(const DesignReport& report) {
  return {.name = "designs",
          .title = "Designs",
          .paragraphs = {},
          .tables = {design_table(report)},
          .lead =
              "A click on a row shows its constraints below; a click on a head sorts. Each is a "
              "damper's description in designs/ and a model in models/."};
}

/// The constraints of the chosen design.
DocumentSection constraint_section(const DesignReport& report) {
  DocumentSection section{.name = "constraints",
                          .title = "Constraints",
                          .paragraphs = {},
                          .lead = report.request.share > 0
                                      ? fmt::format("As {} % of the dampers made reach them.",
                                                    percent_text(100 * report.request.share))
                                      : "As drawn."};

  // One table per design, of which the chosen one is shown.
  DocumentChoice choice{"design", "Design", {}, knee_of(report)};
  for (std::size_t k = 0; k < report.designs.size(); ++k) {
    choice.options.push_back(report.designs[k].name);
    section.tables.push_back(constraint_table(report, report.designs[k]));
    section.tables.back().when = {{"design", {k}}};
  }
  section.choices.push_back(std::move(choice));
  return section;
}

/// The tolerances of every design that has them assessed; on a terminal of the one shown in full.
DocumentSection tolerance_section(const DesignReport& report) {
  DocumentSection section{.name = "tolerances",
                          .title = "Effect of tolerances",
                          .paragraphs = {},
                          .lead = "Made dampers differ from their drawing."};
  for (std::size_t k = 0; k < report.designs.size(); ++k) {
    if (!report.designs[k].sensitivity) continue;
    section.tables.push_back(sensitivity_table(report, report.designs[k]));
    if (k != knee_of(report)) section.tables.back().audience = Audience::Files;
  }
  return section;
}

}  // namespace

DocumentTable design_table(const DesignReport& report) {
  constexpr std::size_t kBrief = 20;  // designs on a terminal
  const DesignRequest& request = report.request;
  DocumentTable table{.title = {}, .columns = {{"Design"}}, .rows = {}};
  for (const DesignVariable& variable : request.variables)
    table.columns.push_back({.title = variable.field
                                          ? with_unit(variable.name(), variable.field->unit)
                                          : variable.name(),
                             .numeric = true,
                             .priority = 2,
                             .hint = variable.field ? std::string(variable.field->meaning) : ""});
  const std::vector<Assessed> figures = assessed(request);
  for (std::size_t k = 0; k < request.goals.size(); ++k) {
    const DesignGoal& goal = request.goals[k];
    table.columns.push_back({.title = figures[k].name(),
                             .numeric = true,
                             .hint = describe(goal) + ": " + std::string(goal.quantity->meaning),
                             .descending = goal.maximise});
  }
  if (!report.second_name.empty())
    table.columns.push_back({.title = "Models differ %",
                             .numeric = true,
                             .priority = 1,
                             .hint = "The largest difference of a goal or constraint, as drawn"});
  table.columns.push_back({.title = "Note",
                           .elastic = true,
                           .hint = "Beyond the family: its model extrapolates there"});

  for (const Design& design : report.designs) {
    std::vector<DocumentCell> row{{design.name}};
    for (const DesignVariable& variable : request.variables)
      row.push_back(variable.field
                        ? figure_cell(design.damper.*variable.field->field, variable.field->unit)
                        : DocumentCell{std::string(design.damper.fluid->name)});
    for (std::size_t k = 0; k < request.goals.size(); ++k)
      row.push_back(figure_cell(design.assessment.goals[k], request.goals[k].quantity->unit));
    if (!report.second_name.empty())
      row.push_back({percent_text(100 * design.disagreement), design.disagreement});
    row.push_back({design_note(design)});
    table.chooses.push_back({{"design", table.rows.size()}});
    add_row(table, row);
  }
  if (report.designs.size() > kBrief) table.brief = selection(report, kBrief);
  return table;
}

DocumentTable constraint_table(const DesignReport& report, const Design& design) {
  const DesignRequest& request = report.request;
  DocumentTable table{
      .title = design.name,
      .columns = {{.title = "Constraint", .elastic = true},
                  {"Reached", true},
                  {"Unit"},
                  {.title = "Left over %", .numeric = true, .hint = "In shares of the bound"}},
      .rows = {}};
  const bool has_second = !report.second_name.empty();
  if (has_second)
    for (const std::string& name : {report.first_name, report.second_name})
      table.columns.push_back(
          {.title = name, .numeric = true, .priority = 1, .hint = "By this model, as drawn"});

  // A row per constraint: asked, reached, left over, and what each model says.
  for (std::size_t k = 0; k < request.constraints.size(); ++k) {
    const DesignConstraint& own = request.constraints[k];
    std::vector<DocumentCell> row{
        {describe(own)},
        figure_cell(design.assessment.constraints[k], own.quantity->unit),
        {shown_unit(own.quantity->unit).unit},
        {percent_text(100 * design.assessment.slack[k]), design.assessment.slack[k]}};
    if (has_second)
      for (const auto* by : {&design.first, &design.second})
        row.push_back(figure_cell((*by)[request.goals.size() + k], own.quantity->unit));
    add_row(table, row);
  }
  return table;
}

DocumentTable sensitivity_table(const DesignReport& report, const Design& design) {
  const DesignRequest& request = report.request;
  DocumentTable table{
      .title = fmt::format("{}{}: what each tolerance moves (its share of the variance); {} % of "
                           "the dampers made hold every constraint",
                           design.name, design.role.empty() ? "" : ", " + design.role,
                           format_number(100 * design.sensitivity->holding, 3)),
      .columns = {{.title = "Figure", .elastic = true},
                  {"Drawn", true},
                  {"90 % of those made", true}},
      .rows = {}};
  for (const DesignTolerance& tolerance : request.tolerances)
    table.columns.push_back(
        {.title = fmt::format("{} ±{}", with_unit(tolerance.field->name, tolerance.field->unit),
                              shown(tolerance.width, tolerance.field->unit)),
         .numeric = true,
         .priority = 1});

  // A row per figure. One with a least and a greatest bound is one figure, except of a model with a
  // band, whose ends stand for the two.
  const std::vector<Assessed> all = assessed(request);
  const auto row_name = [&](std::size_t k) {
    for (std::size_t other = 0; other < all.size(); ++other)
      if (all[other].name() == all[k].name() &&
          design.sensitivity->figures[other].drawn != design.sensitivity->figures[k].drawn)
        return all[k].text;
    return all[k].name();
  };
  std::set<std::string> told;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Sensitivity::Figure& figure = design.sensitivity->figures[k];
    const std::string name = row_name(k);
    if (!told.insert(name).second) continue;
    if (std::ranges::all_of(figure.local, [](double value) { return value == 0; }))
      continue;  // no tolerance matters to it
    const DesignQuantity& quantity = *all[k].quantity;
    std::vector<DocumentCell> row{
        {name},
        figure_cell(figure.drawn, quantity.unit),
        {shown(figure.low, quantity.unit) + " ... " + shown(figure.high, quantity.unit)}};
    std::vector<double> shades(row.size(), NAN);
    for (std::size_t t = 0; t < figure.local.size(); ++t) {
      const double share = std::clamp(figure.total[t], 0., 1.);
      row.push_back({fmt::format("{} ({} %)", shown(figure.local[t], quantity.unit),
                                 percent_text(100 * share)),
                     figure.local[t]});
      shades.push_back(share);
    }
    add_row(table, row);
    table.shades.push_back(std::move(shades));
  }
  return table;
}

std::string design_verdict(const DesignReport& report) {
  if (report.conflict) return conflict_verdict(report);
  if (report.designs.empty() && report.rejected > 0)
    return fmt::format("No design is left: what the search found, {}, failed its own check.",
                       counted(report.rejected, "design"));
  if (report.designs.empty())
    return report.stopped ? "Stopped before there was a design."
                          : "No design was found, although the constraints may hold: such designs "
                            "are rare. Widen a range, or try another --seed.";
  std::string text = report.request.goals.size() == 1
                         ? best_of(report) + "."
                         : fmt::format("{} of which none is better than another in all goals.",
                                       counted(report.designs.size(), "design"));

  // How the constraints hold, and how far models can be trusted.
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

Document design_document(const DesignInput& input) {
  const DesignReport& report = input.design;
  const DesignRequest& request = report.request;
  const std::string models =
      report.first_name + (report.second_name.empty() ? "" : ", beside it " + report.second_name);
  Document document{
      .title = request.name.empty() ? "Design" : request.name,
      .subtitle = models + " · " + fmt::format("{} dampers assessed", report.evaluations),
      .verdict = design_verdict(report),
      .sections = {},
      .command = input.command,
      .version = input.version,
      .date = input.date,
      .kind = "design",
      .key_figures = key_figures(report),
      .data = json_design(input)};
  if (report.designs.size() > 1) document.sections.push_back(front_section(report));
  if (!report.designs.empty()) document.sections.push_back(design_section(report));
  if (!report.designs.empty() && !request.constraints.empty())
    document.sections.push_back(constraint_section(report));
  if (std::ranges::any_of(report.designs,
                          [](const Design& design) { return design.sensitivity.has_value(); }))
    document.sections.push_back(tolerance_section(report));

  // The request, so that the report stands by itself.
  std::vector<std::string> goals, constraints;
  for (const DesignGoal& goal : request.goals) goals.push_back(describe(goal));
  for (const DesignConstraint& own : request.constraints) constraints.push_back(describe(own));
  document.sections.push_back({.name = "request",
                               .title = "The request",
                               .paragraphs = {},
                               .remarks = report.notes,
                               .facts = {{"Goals", join(goals, "; ")},
                                         {"Constraints", join(constraints, "; ")},
                                         {"Note", request.note}},
                               .audience = Audience::Files});
  document.provenance.facts = design_terms();
  return document;
}

}  // namespace dashpot
