#include "dashpot/damper/kinds/law/law_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "dashpot/base/escape.h"
#include "dashpot/base/file.h"
#include "dashpot/base/file_kind.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/damper/law_side.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr std::size_t kMostLines = 200, kLongestName = 24, kLongestRemark = 2000;
constexpr double kMostOffset = 1e6, kMostCurrent = 1e3;  // N, A or V

/// What the equations of every law know without saying it.
constexpr std::string_view kOffset = "f0", kCurrent = "i", kForceSign = "F";

/// Names that mean something else: to the equations, to the fit, or in exported C.
constexpr std::array<std::string_view, 50> kTakenNames{
    "x",        "v",        "s",      "t",      "i",        "F",        "f0",       "lag_rate",
    "f_side",   "c_side",   "v_side", "auto",   "break",    "case",     "char",     "const",
    "continue", "default",  "do",     "double", "else",     "enum",     "extern",   "float",
    "for",      "goto",     "if",     "inline", "int",      "long",     "register", "restrict",
    "return",   "short",    "signed", "sizeof", "static",   "struct",   "switch",   "typedef",
    "union",    "unsigned", "void",   "while",  "volatile", "INFINITY", "NAN",      "linux",
    "unix",     "HUGE_VAL"};

bool is_name(std::string_view text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !text.empty() && text.size() <= kLongestName && is_letter(text.front()) &&
         std::ranges::all_of(
             text, [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

bool is_law_name(std::string_view text) {
  return is_name(text) && std::ranges::none_of(text, [](char c) { return c >= 'A' && c <= 'Z'; });
}

Fit parse_role(const Value& value) {
  constexpr std::array kRoles{std::pair{std::string_view("free"), Fit::Free},
                              std::pair{std::string_view("rises"), Fit::Rises},
                              std::pair{std::string_view("fixed"), Fit::Fixed},
                              std::pair{std::string_view("scale"), Fit::Scale}};
  for (const auto& [name, role] : kRoles)
    if (value.as_string() == name) return role;
  throw Error(value.where(), "unknown role in a fit '" + value.as_string() + "'",
              suggest(value.as_string(), {"free", "rises", "fixed", "scale"}));
}

/// A text that may be written as a number alone: the unit 1, a state that rests at 0.
std::string text_of(const Value& value) {
  return value.kind() == Value::Kind::Number ? format_exact(value.as_number()) : value.as_string();
}

/// A unit in which the law's numbers stand as they are.
std::string si_unit(const Value& unit) {
  const std::string text = text_of(unit);
  const Unit known = require_unit(text, unit.where());
  if (known.factor != 1 || known.offset != 0)
    throw Error(unit.where(), "'" + text + "' is no SI unit",
                "state value and bounds in SI, as N*s/m, N/m, 1/m or 1");
  return text;
}

}  // namespace

/// The functions that a law calls, for one from a text.
struct LawTextRun {
  static const LawText& text(const void* with) { return *static_cast<const LawText*>(with); }

  static void take(const LawProgram::Piece& piece, const double* r, double* to) {
    for (const std::uint16_t output : piece.outputs) *to++ = r[output];
  }

  static void rest(const void* with, const double* p, double x, double v, double* z) {
    const LawText& t = text(with);
    constexpr std::array<double, kMaxStates> kNone{};
    double* const r = t.program_->registers(p);
    t.program_->run(t.rests_piece_, r, x, v, kNone.data());
    take(t.rests_piece_, r, z);
  }

  static void derivative(const void* with, const double* p, double x, double v, const double* z,
                         double* dz) {
    const LawText& t = text(with);
    double* const r = t.program_->registers(p);
    t.program_->run(t.rates_piece_, r, x, v, z);
    take(t.rates_piece_, r, dz);
  }

  static double force(const void* with, const double* p, double x, double v, const double* z) {
    const LawText& t = text(with);
    double* const r = t.program_->registers(p);
    t.program_->run(t.force_piece_, r, x, v, z);
    return r[t.force_piece_.outputs[0]];
  }

  static void forces(const void* with, const double* p, std::span<const DamperInput> inputs,
                     double* force) {
    const LawText& t = text(with);
    double* const r = t.program_->registers(p);
    for (const DamperInput& at : inputs) {
      t.program_->run(t.force_piece_, r, at.displacement, at.velocity, nullptr);
      *force++ = r[t.force_piece_.outputs[0]];
    }
  }

  static double flow(const void* with, const double* p, double x, double v, const double* z,
                     double* dz) {
    const LawText& t = text(with);
    double* const r = t.program_->registers(p);
    t.program_->run(t.flow_piece_, r, x, v, z);
    const std::vector<std::uint16_t>& outputs = t.flow_piece_.outputs;
    for (std::size_t k = 0; k + 1 < outputs.size(); ++k) dz[k] = r[outputs[k]];
    return r[outputs.back()];
  }

  static double rate(const void* with, const double* p, double v) {
    const LawText& t = text(with);
    constexpr std::array<double, kMaxStates> kNone{};
    double* const r = t.program_->registers(p);
    t.program_->run(t.rate_piece_, r, 0, v, kNone.data());
    return r[t.rate_piece_.outputs[0]];
  }

  /// The C text of the steps, for whatever text stands behind.
  struct LawParameters {
    const void* with;
    const double* p;
  };
  static void law_derivative(const LawParameters* p, double x, double v, const double* z,
                             double* dz) {
    derivative(p->with, p->p, x, v, z, dz);
  }
  static double law_travel(const LawParameters* p, double z, double s) {
    const LawText& t = text(p->with);
    double* const r = t.program_->registers(p->p);
    t.program_->run(t.travel_piece_, r, 0, 0, &z, s);
    return r[t.travel_piece_.outputs[0]];
  }
  enum { LAW_MOST_STATES = kMaxStates };
#include "dashpot/damper/c_text/law_runge_kutta.h"
#include "dashpot/damper/c_text/law_travel.h"

  static void runge_kutta(const void* with, const double* const* p, const double* x,
                          const double* v, double h, std::size_t count, double* z) {
    const LawText& t = text(with);
    if (p[0] == p[1] && p[1] == p[2]) {
      t.program_->step(t.step_piece_, t.program_->registers(p[0]), x, v, h, z);
      return;
    }
    const LawParameters stages[] = {{with, p[0]}, {with, p[1]}, {with, p[2]}};
    const LawParameters* const at[] = {&stages[0], &stages[1], &stages[2]};
    law_runge_kutta(at, x, v, h, static_cast<int>(count), z);
  }

  static int step(const void* with, const double* p, const double*, const double* v, double h,
                  double* z) {
    const LawText& t = text(with);
    double* const r = t.program_->registers(p);
    if (t.travel_->holds) {
      t.program_->run(t.holds_piece_, r, 0, 0, z);
      if (r[t.holds_piece_.outputs[0]] == 0) return 0;
    }
    const LawParameters own{with, p};
    z[0] = law_travel_step(&own, v, h, z[0]);
    return 1;
  }

  static void bind(LawText& t) {
    Law& law = t.law_;
    law.text = &t;
    law.force = {&t, force};
    if (law.states.empty()) {
      law.forces = {&t, forces};
      return;
    }
    law.rest = {&t, rest};
    law.derivative = {&t, derivative};
    law.flow = {&t, flow};
    law.runge_kutta = {&t, runge_kutta};
    law.rate = {&t, rate};
    if (!t.travel_) return;
    law.step = {&t, step};
    law.exact_step = true;
  }
};

/// Reads the parts of a definition, in the order in which they need each other.
class LawTextReader {
 public:
  LawTextReader(LawText& text, const Value& definition)
      : text_(text), law_(text.law_), reader_(definition, "the file of a law") {}

  void read() {
    const Value& name = reader_.required("law");
    require_law_name(name);
    law_.name = keep(name.as_string());
    define("law", name);
    law_.title = described("title", law_.name);
    law_.source = described("source");
    law_.remarks = described("remarks", "");

    // What the equations may name, then the equations.
    read_states(reader_.optional("states"));
    read_parameters(reader_.required("parameters"));
    const Value* rate = reader_.optional("rate");
    const Value* travel = reader_.optional("travel");
    const Value* holds = reader_.optional("travel_holds");
    const Value& equations = reader_.required("equations");
    reader_.finish();
    read_equations(equations);
    read_rests();
    read_rate(rate, equations.where());
    read_travel(travel, holds);

    // What follows from them, and what no equation takes.
    add_own_rows();
    require_used();
    compile();
    LawTextRun::bind(text_);
    text_.sided_ = extended_by_side(law_);
    law_.sided = &text_.sided_;
    require_sound(equations.where());
  }

 private:
  std::string_view keep(std::string word) { return text_.words_.emplace_back(std::move(word)); }

  /// Puts a part into the definition that model files hold, without its place in this file.
  void define(const std::string& key, Value value) { text_.definition_.add(key, std::move(value)); }

  void require_law_name(const Value& name) {
    if (!is_law_name(name.as_string()))
      throw Error(name.where(), "'" + name.as_string() + "' cannot name a law",
                  "a small letter, then small letters, digits and _; at most " +
                      std::to_string(kLongestName));
  }

  std::string_view described(const std::string& key,
                             std::optional<std::string_view> fallback = {}) {
    const Value* value = fallback ? reader_.optional(key) : &reader_.required(key);
    if (!value) return *fallback;
    if (value->as_string().size() > kLongestRemark)
      throw Error(value->where(),
                  key + " is longer than " + std::to_string(kLongestRemark) + " characters");
    const std::string words = valid_utf8(value->as_string());
    define(key, words);
    return keep(words);
  }

  /// A new name of the equations.
  void name_node(const std::string& name, const LawNode& node, const std::string& where) {
    require_new_name(name, where);
    names_.emplace(name, text_.nodes_.add(node, where));
  }

  void require_new_name(const std::string& name, const std::string& where) const {
    if (!is_name(name))
      throw Error(where, "'" + name + "' cannot be a name in equations",
                  "a letter, then letters, digits and _; at most " + std::to_string(kLongestName));
    const bool taken = std::ranges::find(kTakenNames, name) != kTakenNames.end();
    if (taken || is_word_of_equations(name))
      throw Error(where, "'" + name + "' has a meaning of its own",
                  "take another name, as " + name + "_1");
    if (names_.contains(name)) throw Error(where, "the name '" + name + "' is given twice");
  }

  void read_states(const Value* states) {
    if (!states) return;
    Value defined = Value::object();
    for (const auto& [name, state] : states->members()) {
      if (law_.states.size() == kMaxStates)
        throw Error(state.where(), "has more than " + std::to_string(kMaxStates) + " states");
      ObjectReader reader(state, "state " + name);
      const Value& unit = reader.required("unit");
      const Value* rest = reader.optional("rest");
      reader.finish();
      const std::string si = si_unit(unit);

      const auto index = static_cast<std::uint16_t>(law_.states.size());
      name_node(name, {.op = LawOp::State, .index = index}, state.where());
      law_.states.push_back({keep(name), keep(si)});
      rest_texts_.push_back(rest);
      Value own = Value::object({{"unit", si}});
      if (rest) own.add("rest", *rest);
      defined.add(name, std::move(own));
    }
    if (!law_.states.empty()) define("states", std::move(defined));
  }

  void read_parameters(const Value& parameters) {
    // The valve of one direction, the current and the offset have rows beside these.
    const std::size_t most = kMaxParams - side_rows().size() - 2;
    Value defined = Value::object();
    for (const auto& [name, parameter] : parameters.members()) {
      if (law_.params.size() == most)
        throw Error(parameter.where(), "has more than " + std::to_string(most) + " parameters");
      const auto index = static_cast<std::uint16_t>(law_.params.size());
      name_node(name, {.op = LawOp::Parameter, .index = index}, parameter.where());
      require_own_coefficients(name, parameters);
      law_.params.push_back(parameter_row(name, parameter));
      defined.add(name, defined_parameter(parameter));
      parameter_places_.push_back(parameter.where());
    }
    define("parameters", std::move(defined));
  }

  /// c_a, c_b ... are the coefficients of a c that follows the current.
  static void require_own_coefficients(const std::string& name, const Value& parameters) {
    if (name.size() < 3 || name[name.size() - 2] != '_') return;
    const char letter = name.back();
    const std::string base = name.substr(0, name.size() - 2);
    if (letter >= 'a' && letter <= 'd' && parameters.find(base))
      throw Error(parameters.where(),
                  "'" + name + "' is also a coefficient of '" + base + "' over the current",
                  "rename one of them");
  }

  ParamInfo parameter_row(const std::string& name, const Value& parameter) {
    ObjectReader reader(parameter, "parameter " + name);
    const Value& unit = reader.required("unit");
    const Value& value = reader.required("value");
    const Value& bounds = reader.required("bounds");
    const std::vector<double> ends = bounds.as_numbers();
    const double start = reader.number("start", 1);
    const Value* form = reader.optional("form");
    const Value* role = reader.optional("fit");
    const std::string meaning = valid_utf8(reader.string("meaning", "parameter " + name));
    reader.finish();
    const std::string si = si_unit(unit);

    // Numbers that a fit can start from.
    if (ends.size() != 2 || !(ends[0] < ends[1]) || !std::isfinite(ends[0]) ||
        !std::isfinite(ends[1]))
      throw Error(bounds.where(), "are no bounds", "write [lowest, highest], both finite");
    if (!(value.as_number() >= ends[0] && value.as_number() <= ends[1]))
      throw Error(
          value.where(), name + " is " + format_number(value.as_number()),
          "within its bounds, " + format_number(ends[0]) + " ... " + format_number(ends[1]));
    if (!std::isfinite(start))
      throw Error(parameter.where(), "start of " + name + " is not finite",
                  "a number, in the data's own size of " + si);
    if (meaning.size() > kLongestRemark)
      throw Error(parameter.where(), "the meaning of " + name + " is too long");

    return {.name = keep(name),
            .unit = keep(si),
            .value = value.as_number(),
            .lower = ends[0],
            .upper = ends[1],
            .start = start,
            .form = form ? parse_form(form->as_string(), form->where()) : Form::Constant,
            .fit = role ? parse_role(*role) : Fit::Free,
            .meaning = keep(meaning)};
  }

  static Value defined_parameter(const Value& parameter) {
    Value own = Value::object();
    for (const char* key : {"unit", "value", "bounds", "start", "form", "fit", "meaning"})
      if (const Value* part = parameter.find(key); part && !part->is_null())
        own.add(key,
                part->kind() == Value::Kind::String ? Value(valid_utf8(part->as_string())) : *part);
    return own;
  }

  void read_equations(const Value& equations) {
    if (equations.items().size() > kMostLines)
      throw Error(equations.where(), "are more than " + std::to_string(kMostLines));
    add_inputs();
    rates_.resize(law_.states.size());

    std::vector<std::string> lines;
    for (const Value& line : equations.items()) {
      read_equation(line.as_string(), line.where());
      lines.emplace_back(trim(line.as_string()));
    }
    define("equations", Value::array(lines));

    // Every state has a rate, and the law a force.
    for (std::size_t k = 0; k < rates_.size(); ++k) {
      const std::string name(law_.states[k].name);
      if (!rates_[k])
        throw Error(equations.where(), "say nothing of how the state " + name + " changes",
                    "add an equation d" + name + "/dt = ...");
      text_.rates_.push_back(*rates_[k]);
    }
    if (!force_) throw Error(equations.where(), "give no force", "add an equation F = ...");
    law_.equation = keep(join(lines, "\n") + "\nwith f0 added to F");
  }

  void add_inputs() {
    names_.emplace("x", text_.nodes_.add({.op = LawOp::Displacement}, ""));
    names_.emplace("v", text_.nodes_.add({.op = LawOp::Velocity}, ""));
    const auto row = static_cast<std::uint16_t>(law_.params.size());
    current_ = text_.nodes_.add({.op = LawOp::Parameter, .index = row}, "");
    names_.emplace(kCurrent, *current_);
  }

  static std::string left_of(const std::string& line, const std::string& where) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos)
      throw Error(where, "'" + line + "' is no equation",
                  "write F = ..., dz/dt = ... for a state z, or name = ...");
    return std::string(trim(line.substr(0, equals)));
  }

  void read_equation(const std::string& line, const std::string& where) {
    const std::string left = left_of(line, where);
    const std::string_view right = std::string_view(line).substr(line.find('=') + 1);

    // The force, the rate of a state, or a name for what stands on the right.
    if (left == kForceSign) {
      if (force_) throw Error(where, "F is given twice");
      force_ = value_of(right, where);
      return;
    }
    for (std::size_t k = 0; k < rates_.size(); ++k) {
      const std::string state(law_.states[k].name);
      if (left != "d" + state + "/dt" && left != state + "'") continue;
      if (rates_[k]) throw Error(where, "the rate of " + state + " is given twice");
      rates_[k] = value_of(right, where);
      return;
    }
    if (left.find_first_of("/'") != std::string::npos)
      throw Error(where, "'" + left + "' is the rate of no state",
                  law_.states.empty() ? "name the states under 'states'" : rates_known());
    require_new_name(left, where);
    const std::uint16_t value = value_of(right, where);
    names_.emplace(left, value);
    definitions_.emplace_back(left, where);
  }

  std::string rates_known() const {
    std::vector<std::string> known;
    for (const StateInfo& state : law_.states)
      known.push_back("d" + std::string(state.name) + "/dt");
    return "known: " + join(known, ", ");
  }

  /// Reads an expression and remembers which names it takes.
  std::uint16_t value_of(std::string_view expression, const std::string& where) {
    note_names(expression);
    return parse_law_expression(expression, names_, text_.nodes_, where);
  }

  void note_names(std::string_view expression) {
    const auto is_word = [](char c) {
      return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    for (std::size_t at = 0; at < expression.size();) {
      std::size_t end = at;
      while (end < expression.size() && is_word(expression[end])) ++end;
      if (end > at) taken_.emplace(expression.substr(at, end - at));
      at = std::max(end, at + 1);
    }
  }

  /// The names without those that would make the expression mean nothing.
  LawNames names_without(const std::vector<std::string_view>& out) const {
    LawNames left = names_;
    for (const StateInfo& state : law_.states) left.erase(std::string(state.name));
    for (const std::string_view name : out) left.erase(std::string(name));
    return left;
  }

  void require_without_states(std::uint16_t node, bool motion, const std::string& where,
                              const std::string& what, const std::string& right) const {
    bool wrong = motion && (text_.nodes_.needs(node, LawOp::Displacement) ||
                            text_.nodes_.needs(node, LawOp::Velocity));
    for (std::size_t k = 0; k < law_.states.size(); ++k)
      wrong |= text_.nodes_.needs(node, LawOp::State, static_cast<std::uint16_t>(k));
    if (wrong) throw Error(where, what, right);
  }

  void read_rests() {
    const LawNames names = names_without({});
    for (const Value* rest : rest_texts_) {
      if (!rest) {
        text_.rests_.push_back(text_.nodes_.add({.op = LawOp::Number}, ""));
        continue;
      }
      const std::string expression = text_of(*rest);
      note_names(expression);
      text_.rests_.push_back(parse_law_expression(expression, names, text_.nodes_, rest->where()));
      require_without_states(text_.rests_.back(), false, rest->where(),
                             "where a state rests follows from another state",
                             "take x, v and parameters");
    }
  }

  void read_rate(const Value* rate, const std::string& where) {
    if (law_.states.empty()) {
      if (rate) throw Error(rate->where(), "a law without states has no rate");
      return;
    }
    if (!rate)
      throw Error(where, "the key 'rate' is missing, which says how fast the states settle, 1/s",
                  "for a filter dz/dt = r*(v - z) it is 'rate: r', for a hysteresis whose slope is "
                  "rho per metre 'rate: rho*abs(v)'; the step of the integrator follows from it");
    const std::string expression = text_of(*rate);
    define("rate", *rate);
    note_names(expression);
    text_.rate_ =
        parse_law_expression(expression, names_without({"x"}), text_.nodes_, rate->where());
    require_without_states(text_.rate_, false, rate->where(),
                           "the rate follows from a state or from x",
                           "take the largest that it has: of v and parameters");
    if (text_.nodes_.needs(text_.rate_, LawOp::Displacement))
      throw Error(rate->where(), "the rate follows from x", "take v and parameters");
  }

  void read_travel(const Value* travel, const Value* holds) {
    if (!travel) {
      if (holds) throw Error(holds->where(), "holds for nothing", "state 'travel' as well");
      return;
    }
    if (law_.states.size() != 1)
      throw Error(travel->where(), "a closed form is known to laws with one state only",
                  "leave 'travel' out");

    // The state after a displacement s, whatever time that takes, with names on the way to it.
    LawText::Travel own{.value = travelled(*travel), .holds = {}};
    for (const LawOp op : {LawOp::Displacement, LawOp::Velocity})
      if (text_.nodes_.needs(own.value, op))
        throw Error(travel->where(), "the closed form follows from x or v",
                    "take s, the displacement on the way, the state at its start and parameters");

    // The condition on parameters under which it may be taken.
    if (holds) {
      define("travel_holds", *holds);
      note_names(holds->as_string());
      own.holds = parse_law_condition(holds->as_string(), names_without({"x", "v"}), text_.nodes_,
                                      holds->where());
      require_without_states(*own.holds, true, holds->where(),
                             "whether the closed form holds follows from the motion",
                             "compare parameters, as n == 2");
    }
    text_.travel_ = own;
  }

  std::uint16_t travelled(const Value& travel) {
    const std::string state(law_.states.front().name);
    LawNames names = names_;
    names.erase("x");
    names.erase("v");
    names.emplace("s", text_.nodes_.add({.op = LawOp::Travel}, ""));

    std::optional<std::uint16_t> value;
    std::vector<std::string> lines;
    for (const Value& item : travel.items()) {
      const std::string &line = item.as_string(), left = left_of(line, item.where());
      lines.emplace_back(trim(line));
      const std::string_view right = std::string_view(line).substr(line.find('=') + 1);
      if (value) throw Error(item.where(), "stands behind '" + state + " = ...', which ends these");
      if (left != state) require_new_name(left, item.where());
      note_names(right);
      const std::uint16_t node = parse_law_expression(right, names, text_.nodes_, item.where());
      if (left == state)
        value = node;
      else if (names.emplace(left, node).second)
        definitions_.emplace_back(left, item.where());
      else
        throw Error(item.where(), "the name '" + left + "' is given twice");
    }
    define("travel", Value::array(lines));
    if (!value)
      throw Error(travel.where(), "does not say what becomes of " + state,
                  "end with a line " + state + " = ...");
    return *value;
  }

  /// The coil current where an equation takes it, and the offset of every law, added to the force.
  void add_own_rows() {
    std::vector<std::uint16_t> all = outputs();
    const std::vector<bool> needed = text_.nodes_.needed(all);
    if (needed[*current_])
      law_.params.push_back({.name = kCurrent,
                             .unit = "A",
                             .value = 1,
                             .lower = -kMostCurrent,
                             .upper = kMostCurrent,
                             .start = 0,
                             .form = Form::Linear,
                             .fit = Fit::Drive,
                             .meaning = "current in the coil"});
    const auto row = static_cast<std::uint16_t>(law_.params.size());
    law_.params.push_back({.name = kOffset,
                           .unit = "N",
                           .value = 0,
                           .lower = -kMostOffset,
                           .upper = kMostOffset,
                           .start = 0,
                           .form = Form::Constant,
                           .fit = Fit::Bias,
                           .meaning = "offset force"});

    // Where the current is not taken, its row is the offset's: then the node is the same.
    const std::uint16_t offset = text_.nodes_.add({.op = LawOp::Parameter, .index = row}, "");
    text_.force_ = text_.nodes_.add({.op = LawOp::Add, .of = {*force_, offset}}, "");
    law_.needs_displacement = text_.nodes_.needed(outputs())[names_.find("x")->second];
  }

  /// All values that the law computes.
  std::vector<std::uint16_t> outputs() const {
    std::vector<std::uint16_t> all = text_.rates_;
    all.insert(all.end(), text_.rests_.begin(), text_.rests_.end());
    all.push_back(force_ ? *force_ : text_.force_);
    if (!law_.states.empty()) all.push_back(text_.rate_);
    if (text_.travel_) all.push_back(text_.travel_->value);
    if (text_.travel_ && text_.travel_->holds) all.push_back(*text_.travel_->holds);
    return all;
  }

  void require_used() const {
    for (std::size_t k = 0; k < parameter_places_.size(); ++k)
      if (!taken_.contains(law_.params[k].name))
        throw Error(parameter_places_[k],
                    "no equation takes the parameter " + std::string(law_.params[k].name),
                    "use it, or leave it out: a fit could not find it");
    for (const auto& [name, where] : definitions_)
      if (!taken_.contains(name))
        throw Error(where, "no equation takes '" + name + "'", "use it, or leave it out");
    for (const StateInfo& state : law_.states)
      if (!taken_.contains(state.name))
        throw Error(std::string(law_.name),
                    "no equation takes the state " + std::string(state.name),
                    "use it in F, or leave it out");
  }

  void compile() {
    text_.program_ =
        std::make_unique<LawProgram>(text_.nodes_, law_.params.size(), law_.states.size());
    LawProgram& program = *text_.program_;
    const std::array force{text_.force_};
    text_.force_piece_ = program.add(force);
    if (law_.states.empty()) return;
    text_.rates_piece_ = program.add(text_.rates_);
    text_.step_piece_ = program.add_step(text_.rates_);
    text_.rests_piece_ = program.add(text_.rests_);
    const std::array rate{text_.rate_};
    text_.rate_piece_ = program.add(rate);
    std::vector<std::uint16_t> both = text_.rates_;
    both.push_back(text_.force_);
    text_.flow_piece_ = program.add(both);
    if (!text_.travel_) return;
    const std::array travel{text_.travel_->value};
    text_.travel_piece_ = program.add(travel);
    if (!text_.travel_->holds) return;
    const std::array holds{*text_.travel_->holds};
    text_.holds_piece_ = program.add(holds);
  }

  /// Runs the law with its example values where every damper goes: at rest and through a slow sine.
  void require_sound(const std::string& where) const {
    std::vector<double> p;
    for (const ParamInfo& row : law_.params) p.push_back(row.value);
    require_rest(p, where);
    require_steps(p, where);
  }

  void require_rest(const std::vector<double>& p, const std::string& where) const {
    constexpr double kSlow = 1e-9;  // of what it does in motion
    std::array<double, kMaxStates> z{}, still{}, moving{};
    for (const double x : {-0.02, 0.0, 0.013}) {
      if (law_.states.empty()) return;
      law_.rest(p.data(), x, 0, z.data());
      law_.derivative(p.data(), x, 0, z.data(), still.data());
      law_.derivative(p.data(), x, 0.1, z.data(), moving.data());
      for (std::size_t k = 0; k < law_.states.size(); ++k)
        if (!(std::abs(still[k]) <= kSlow * std::abs(moving[k])))
          throw Error(where,
                      "the state " + std::string(law_.states[k].name) + " does not rest at x = " +
                          format_number(x) + " m, v = 0: it is " + format_number(z[k]) +
                          " and changes by " + format_number(still[k]) + " a second",
                      "say where it rests, as 'rest: v' or 'rest: x' beside its unit");
    }
  }

  void require_steps(const std::vector<double>& p, const std::string& where) const {
    constexpr int kSteps = 1000;
    constexpr double kStep = 1e-3, kStroke = 0.01, kAngular = 6.283185307179586;
    constexpr double kMostStable = 2, kMostSubsteps = 200;
    std::array<double, kMaxStates> z{};
    if (!law_.states.empty()) law_.rest(p.data(), 0, kStroke * kAngular, z.data());
    for (int k = 0; k <= kSteps; ++k) {
      const double t = k * kStep, x = kStroke * std::sin(kAngular * t),
                   v = kStroke * kAngular * std::cos(kAngular * t);
      const double force = law_.force(p.data(), x, v, z.data());
      if (!std::isfinite(force))
        throw Error(where,
                    "with the values of its table the force is no number at t = " +
                        format_number(t) + " s of a sine of 10 mm and 1 Hz",
                    law_.states.empty()
                        ? "mind roots and logarithms of negative numbers, and divisors of 0"
                        : "mind roots of negative numbers and divisors of 0; where 'rate' is too "
                          "small the integrator's steps are too long");
      if (law_.states.empty()) continue;

      // As many steps as the law asks for, with the motion held: enough to see it run away.
      const double rate = law_.rate(p.data(), v);
      if (!(rate >= 0 && std::isfinite(rate)))
        throw Error(where,
                    "'rate' is " + format_number(rate) + " at v = " + format_number(v) + " m/s",
                    "a number of 1/s, 0 or more, at every v");
      const double steps =
          std::min(kMostSubsteps, std::max(1.0, std::ceil(rate * kStep / kMostStable)));
      const double h = kStep / steps;
      const double* const stages[] = {p.data(), p.data(), p.data()};
      const std::array xs{x, x, x}, vs{v, v, v};
      for (int step = 0; step < static_cast<int>(steps); ++step)
        law_.runge_kutta(stages, xs.data(), vs.data(), h, law_.states.size(), z.data());
    }
  }

  LawText& text_;
  Law& law_;
  ObjectReader reader_;
  LawNames names_;
  std::vector<const Value*> rest_texts_;
  std::vector<std::string> parameter_places_;
  std::vector<std::pair<std::string, std::string>> definitions_;  ///< with their places
  std::set<std::string, std::less<>> taken_;                      ///< words of all equations
  std::vector<std::optional<std::uint16_t>> rates_;
  std::optional<std::uint16_t> force_, current_;
};

std::shared_ptr<const LawText> LawText::make(const Value& definition) {
  const std::shared_ptr<LawText> text(new LawText);
  text->definition_ = Value::object();
  LawTextReader(*text, definition).read();
  return text;
}

bool is_law_file(std::string_view word) {
  return word.ends_with(".yaml") || word.ends_with(".yml") || word.ends_with(".json");
}

std::shared_ptr<const LawText> load_law_text(const std::filesystem::path& path) {
  return parse_law_text(read_file(path), path.string());
}

std::shared_ptr<const LawText> parse_law_text(std::string_view text, const std::string& source) {
  const Value definition =
      trim(text).starts_with('{') ? parse_json(text, source) : parse_yaml(text, source);
  refuse_other_kind(definition, "the file of a law");
  return LawText::make(definition);
}

}  // namespace dashpot
