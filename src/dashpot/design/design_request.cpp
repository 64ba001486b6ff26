#include "dashpot/design/design_request.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/data_folder.h"
#include "dashpot/base/file.h"
#include "dashpot/base/file_kind.h"
#include "dashpot/base/read_quantity.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/value.h"

namespace dashpot {
namespace {

double positive(double value, const Value& at, const std::string& what) {
  if (value > 0) return value;
  throw Error(at.where(), what + " is " + format_number(value), "more than 0");
}

DesignVariable read_fluids(const Value& value, const std::filesystem::path& folder) {
  DesignVariable variable;
  for (const Value& item : value.items())
    variable.fluids.push_back(find_fluid(item.as_string(), item.where(), folder));
  if (variable.fluids.empty())
    throw Error(value.where(), "no fluid to choose from", "[122EG, 132DG]");
  return variable;
}

void read_range(const Value& value, DesignVariable& variable) {
  constexpr double kMostSteps = 1e6;

  // The ends and the step, in the field's unit.
  ObjectReader reader(value, "a range");
  variable.from = read_field(reader.required("from"), *variable.field);
  variable.to = read_field(reader.required("to"), *variable.field);
  if (const Value* step = reader.optional("step"))
    variable.step = positive(read_quantity(*step, variable.field->unit), *step, "the step");
  reader.finish();

  // A range has a width, and a million steps at most.
  const auto shown = [&](double number) {
    return format_number(number) + ' ' + std::string(variable.field->unit);
  };
  if (!(variable.from < variable.to))
    throw Error(value.where(),
                "the range of " + variable.name() + " is empty: " + shown(variable.from) + " to " +
                    shown(variable.to),
                "from less than to");
  if (variable.step > 0 && (variable.to - variable.from) / variable.step > kMostSteps)
    throw Error(value.where(), "the step of " + variable.name() + " is too small for its range");
}

/// A coil has whole turns, whatever the request says of steps. Those of the paper's circuit stand
/// for its saturation as well, and need not be whole.
void wind_whole_turns(DesignVariable& variable, const DamperDescription& damper) {
  if (!variable.field || variable.field->field != &DamperDescription::turns) return;
  if (variable.step > 0 || !variable.values.empty()) return;
  if (damper.circuit_law == CircuitLaw::Paper) return;
  variable.from = std::ceil(variable.from);
  variable.step = 1;
}

DesignVariable read_variable(const std::string& name, const Value& value,
                             const std::filesystem::path& folder) {
  if (name == "fluid") return read_fluids(value, folder);
  DesignVariable variable;
  variable.field = &find_description_field(name, value.where());
  if (value.kind() == Value::Kind::Object) {
    read_range(value, variable);
    return variable;
  }
  for (const Value& item : value.items())
    variable.values.push_back(read_field(item, *variable.field));
  if (variable.values.empty())
    throw Error(value.where(), "no " + name + " to choose from",
                "{from: ..., to: ...} or a list of values");
  return variable;
}

void read_operation(ObjectReader& reader, DamperOperation& operation) {
  const auto read = [&](std::string_view key, std::string_view unit, double& target) {
    if (const Value* value = reader.optional(key)) target = read_quantity(*value, unit);
  };
  read("current", "A", operation.current);
  read("velocity", "m/s", operation.velocity);
  read("displacement", "m", operation.displacement);
}

/// By which models; a constraint may be asked of both.
std::vector<ToldBy> read_by(ObjectReader& reader, bool both_allowed) {
  const Value* value = reader.optional("by");
  const std::string by = value ? value->as_string() : "first";
  if (by == "first") return {ToldBy::First};
  if (by == "second") return {ToldBy::Second};
  if (by == "both" && both_allowed) return {ToldBy::First, ToldBy::Second};
  throw Error(value->where(), "by is '" + by + "'",
              both_allowed ? "first, second or both" : "first or second");
}

/// Throws Error where the quantity would be the same number for every damper: forces at rest, heat
/// or a range of forces without a current.
void require_telling(const DesignQuantity& quantity, const DamperOperation& at,
                     const Value& asked) {
  const std::string example = "at: {current: 2 A, velocity: 0.3 m/s}";
  const std::string name(quantity.name);
  if (at.velocity == 0 && quantity.needs_flow())
    throw Error(asked.where(), name + " is asked at rest, where nothing flows",
                "a velocity, as " + example);
  if (at.current == 0 && quantity.needs_current())
    throw Error(asked.where(),
                name + " is asked without a current, where it is the same for every damper",
                "a current, as " + example);
}

/// Throws Error where a force is bounded on the side where it never is about the middle of the
/// stroke: every damper would hold that, or none.
void require_side(const DesignConstraint& constraint, const std::string& where) {
  const double velocity = constraint.at.velocity;
  if (!constraint.quantity->is_signed() || constraint.at.displacement != 0 ||
      velocity * constraint.bound >= 0)
    return;
  const bool always = constraint.at_least == (velocity > 0);
  const std::string side = velocity > 0 ? "positive" : "negative";
  throw Error(where,
              std::string(constraint.quantity->name) + " is " + side + " at " +
                  format_number(velocity) + " m/s, so that " + (always ? "every" : "no") +
                  " damper holds this",
              "a " + side + " bound, as " + (constraint.at_least ? "max" : "min") + ": " +
                  format_number(-constraint.bound) + " N");
}

void read_constraint(const Value& value, const DamperOperation& at, DesignRequest& request) {
  // The quantity, where it is asked, its bounds, and the models that are asked.
  ObjectReader reader(value, "a constraint");
  const Value& named = reader.required("quantity");
  DesignConstraint constraint{&find_design_quantity(named.as_string(), named.where()), at};
  read_operation(reader, constraint.at);
  const Value *least = reader.optional("min"), *most = reader.optional("max");
  const std::vector<ToldBy> asked_of = read_by(reader, true);
  reader.finish();

  // Every bound becomes a constraint, for every model that is asked.
  if (!least && !most)
    throw Error(value.where(), "the constraint has no bound", "min, max or both");
  for (const ToldBy by : asked_of)
    for (const Value* bound : {least, most}) {
      if (!bound) continue;
      constraint.by = by;
      constraint.at_least = bound == least;
      constraint.bound = read_quantity(*bound, constraint.quantity->unit);
      require_side(constraint, bound->where());
      request.constraints.push_back(constraint);
    }

  // The two that were added last are min and max for one model.
  const std::size_t count = request.constraints.size();
  if (least && most && request.constraints[count - 2].bound > request.constraints[count - 1].bound)
    throw Error(value.where(), std::string(constraint.quantity->name) + " has a min above its max");
  require_telling(*constraint.quantity, constraint.at, named);
}

DesignGoal read_goal(const Value& value, const DamperOperation& at) {
  // The goal's operating point and model.
  ObjectReader reader(value, "a goal");
  const Value *most = reader.optional("maximise"), *least = reader.optional("minimise");
  DesignGoal goal;
  goal.at = at;
  read_operation(reader, goal.at);
  goal.by = read_by(reader, false).front();
  reader.finish();

  // Exactly one of the two keys names the quantity and its direction.
  if (!most == !least)
    throw Error(value.where(), "a goal is one quantity",
                "maximise: dynamic_range, or minimise: mass");
  const Value& named = most ? *most : *least;
  goal.quantity = &find_design_quantity(named.as_string(), named.where());
  goal.maximise = most != nullptr;
  require_telling(*goal.quantity, goal.at, named);
  return goal;
}

FollowingField read_following(const std::string& name, const Value& value) {
  FollowingField following;
  following.field = &find_description_field(name, value.where());
  for (const auto& [key, factor] : value.members())
    if (key == "constant")
      following.constant = read_quantity(factor, following.field->unit);
    else
      following.terms.emplace_back(&find_description_field(key, factor.where()),
                                   factor.as_number());
  return following;
}

void read_robust(const Value& value, DesignRequest& request) {
  constexpr double kMostSamples = 10000;

  // The share of the dampers made, and how many stand for them.
  ObjectReader reader(value, "robust");
  request.share = reader.number("share");
  const double samples = reader.number("samples", request.samples);
  reader.finish();

  // Both within their limits, and there must be tolerances to be robust against.
  if (!(request.share > 0 && request.share <= 1))
    throw Error(value.where(), "share is " + format_number(request.share),
                "more than 0, 1 at most");
  if (!(samples >= 2 && samples <= kMostSamples && samples == std::floor(samples)))
    throw Error(value.where(), "samples is " + format_number(samples),
                "a whole number from 2 to 10000");
  request.samples = static_cast<int>(samples);
  if (request.tolerances.empty())
    throw Error(value.where(), "robust against nothing: no tolerances are stated",
                "tolerances: {gap: 0.05 mm}");
}

DamperDescription read_damper(const Value& value, const std::filesystem::path& folder) {
  const std::string& name = value.as_string();
  const std::vector<std::string> known = description_names();
  if (std::ranges::find(known, name) != known.end()) return named_description(name);
  if (!name.ends_with(".yaml"))
    throw Error(value.where(), "unknown damper '" + name + "'",
                suggest(name, known) + ", or a .yaml file");
  return load_description(folder / name);
}

/// Whether both are of the same figure, whichever way they want it.
bool are_of_one_figure(const DesignGoal& a, const DesignGoal& b) {
  return a.quantity == b.quantity && a.by == b.by && (a.quantity->of_drawing || a.at == b.at);
}

/// A goal that is asked twice adds nothing; asked both ways, every damper would be a design.
void require_one_goal_each(const std::vector<DesignGoal>& goals, const std::string& source) {
  for (std::size_t k = 1; k < goals.size(); ++k)
    for (std::size_t other = 0; other < k; ++other)
      if (are_of_one_figure(goals[k], goals[other]))
        throw Error(source,
                    "the goals " + describe(goals[other]) + " and " + describe(goals[k]) +
                        " are of one figure",
                    "one goal for each figure");
}

bool varies(const DesignRequest& request, const DescriptionField* field) {
  return std::ranges::any_of(request.variables,
                             [&](const DesignVariable& v) { return v.field == field; });
}

void require_consistent(const DesignRequest& request, const std::string& source, Goals goals) {
  // Something varies, and something is wanted, of the ride as well where there is one.
  if (request.variables.empty())
    throw Error(source, "nothing may vary", "vary: {gap: {from: 0.5 mm, to: 2 mm}}");
  if (goals == Goals::Required && request.goals.empty())
    throw Error(source, "there is no goal", "goals: [{minimise: mass}]");
  require_one_goal_each(request.goals, source);
  if (asks_comfort(request) && !request.ride)
    throw Error(source, "comfort is asked, and of no ride",
                "ride: {plant: savaresi_spelta, controller: skyhook}");
  if (goals == Goals::Required && request.ride && !asks_comfort(request))
    throw Error(source, "nothing is asked of the ride", "goals: [{minimise: comfort}]");

  // Every fluid has the law that the damper asks for, and no field is told twice.
  for (const DesignVariable& variable : request.variables)
    for (const std::shared_ptr<const Fluid>& fluid : variable.fluids)
      if (!fluid->law(request.damper.yield_law))
        throw Error(source,
                    fluid->name + " has no yield stress '" + request.damper.yield_law +
                        "', which the damper asks for",
                    "another fluid, or another `yield` of the damper");
  for (const FollowingField& following : request.following) {
    const std::string name(following.field->name);
    if (varies(request, following.field))
      throw Error(source, name + " both varies and follows others");
    for (const auto& [term, factor] : following.terms)
      if (term == following.field) throw Error(source, name + " follows itself");
  }
}

/// Those that are followed before those that follow them, so that one pass sets them all.
void put_in_order(std::vector<FollowingField>& following, const std::string& source) {
  std::vector<FollowingField> ordered;
  while (!following.empty()) {
    const auto waits = [&](const FollowingField& one) {
      return std::ranges::any_of(one.terms, [&](const auto& term) {
        return std::ranges::find(following, term.first, &FollowingField::field) != following.end();
      });
    };
    const auto next = std::ranges::find_if_not(following, waits);
    if (next == following.end()) {
      std::vector<std::string> names;
      for (const FollowingField& one : following) names.emplace_back(one.field->name);
      throw Error(source, join(names, ", ") + " follow each other in a circle",
                  "one of them a value of the damper, or one that varies");
    }
    ordered.push_back(std::move(*next));
    following.erase(next);
  }
  following = std::move(ordered);
}

template <class Read>
void each_member(ObjectReader& reader, std::string_view key, Read read) {
  if (const Value* value = reader.optional(key))
    for (const auto& [name, member] : value->members()) read(name, member);
}

std::string place_text(const DamperOperation& at) {
  std::string text =
      " at " + format_number(at.current) + " A, " + format_number(at.velocity) + " m/s";
  return at.displacement == 0 ? text : text + ", " + format_number(at.displacement) + " m";
}

}  // namespace

std::size_t DesignVariable::levels() const {
  if (!field) return fluids.size();
  if (!values.empty()) return values.size();
  return step > 0 ? static_cast<std::size_t>(std::floor((to - from) / step * (1 + 1e-12))) + 1 : 0;
}

bool is_of_ride(const DesignQuantity& quantity) { return quantity.name == kRideComfort; }

bool asks_comfort(const DesignRequest& request) {
  const auto asks = [](const auto& asked) { return is_of_ride(*asked.quantity); };
  return std::ranges::any_of(request.goals, asks) || std::ranges::any_of(request.constraints, asks);
}

std::string place_of(const DesignQuantity& quantity, const DamperOperation& at, ToldBy by) {
  // Fields and sizes are the same at any current and speed.
  const bool anywhere = quantity.of_drawing || (at.current == 0 && at.velocity == 0);
  return (anywhere ? "" : place_text(at)) + (by == ToldBy::Second ? ", by the second model" : "");
}

std::string describe(const DesignConstraint& c) {
  return std::string(c.quantity->name) + (c.at_least ? " at least " : " at most ") +
         shown_figure(c.bound, c.quantity->unit) + place_of(*c.quantity, c.at, c.by);
}

std::string describe(const DesignGoal& goal) {
  return (goal.maximise ? "largest " : "smallest ") + std::string(goal.quantity->name) +
         place_of(*goal.quantity, goal.at, goal.by);
}

DesignRequest parse_request(std::string_view text, const std::string& source,
                            const std::filesystem::path& folder, Goals goals,
                            RideReader read_ride) {
  const Value document = parse_yaml(text, source);
  refuse_other_kind(document, "a design request");
  ObjectReader reader(document, "a design request");

  // Name, note and the damper that the request starts from.
  DesignRequest request;
  request.name = reader.string("name", "");
  request.note = reader.string("note", "");
  request.damper = read_damper(reader.required("damper"), folder);

  // The operation that constraints and goals share unless they state their own.
  DamperOperation at;
  if (const Value* place = reader.optional("at")) {
    ObjectReader operation(*place, "at");
    read_operation(operation, at);
    operation.finish();
  }

  // The fields that vary and those that follow them, and how exactly parts are made.
  each_member(reader, "vary", [&](const std::string& name, const Value& value) {
    request.variables.push_back(read_variable(name, value, folder));
  });
  for (DesignVariable& variable : request.variables) wind_whole_turns(variable, request.damper);
  each_member(reader, "follow", [&](const std::string& name, const Value& value) {
    request.following.push_back(read_following(name, value));
  });
  each_member(reader, "tolerances", [&](const std::string& name, const Value& value) {
    const DescriptionField& field = find_description_field(name, value.where());
    request.tolerances.push_back(
        {&field, positive(read_quantity(value, field.unit), value, "the tolerance")});
  });

  // The requirements: the ride, robustness, constraints and goals.
  if (const Value* ride = reader.optional("ride")) {
    if (!read_ride) throw Error(ride->where(), "a ride cannot be asked about here");
    request.ride = read_ride(*ride);
  }
  if (const Value* robust = reader.optional("robust")) read_robust(*robust, request);
  if (const Value* list = reader.optional("constraints"))
    for (const Value& item : list->items()) read_constraint(item, at, request);
  if (const Value* list = reader.optional("goals"))
    for (const Value& item : list->items()) request.goals.push_back(read_goal(item, at));

  // Unknown keys and contradictions are refused.
  reader.finish();
  require_consistent(request, source, goals);
  put_in_order(request.following, source);
  return request;
}

DesignRequest load_request(const std::filesystem::path& path, Goals goals, RideReader read_ride) {
  return parse_request(read_file(path), path.string(), path.parent_path(), goals, read_ride);
}

DesignRequest named_request(const std::string& name) {
  const std::vector<std::string> known = request_names();
  if (std::ranges::find(known, name) == known.end())
    throw Error("", "unknown design request '" + name + "'", suggest(name, known));
  return load_request(data_folder("designs") / (name + ".yaml"));
}

std::vector<std::string> request_names() { return data_names("designs", ".yaml"); }

}  // namespace dashpot
