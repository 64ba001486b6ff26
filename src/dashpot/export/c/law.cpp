#include <algorithm>

#include "dashpot/base/escape.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/law/law_text.h"
#include "dashpot/error.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/c/law_equations.h"

namespace dashpot {
namespace {

constexpr std::string_view kLagRate = "lag_rate";

/// A parameter as an expression in `current`: with its coefficients as they are or, when they can
/// be set, as fields of `m`.
std::string expression(const LawModel& model, std::size_t k, bool settable) {
  const std::vector<double>& c = model.parameters().coefficients[k];
  const Form form = model.parameters().forms[k];
  const bool fields = settable && model.law().params[k].fit != Fit::Drive;
  const auto term = [&](std::size_t index) {
    return fields ? "m->" + coefficient_name(model.law().params[k].name, form, index)
                  : c_number(c[index]);
  };

  // An exponential as its two ends and rate, a polynomial by Horner's scheme.
  if (form == Form::Exponential)
    return term(1) + " + (" +
           (fields ? "(" + term(0) + " - " + term(1) + ")" : c_number(c[0] - c[1])) + " * exp(" +
           (fields ? "-" + term(2) : c_number(-c[2])) + " * current))";
  std::string sum = term(c.size() - 1);
  for (std::size_t power = c.size() - 1; power-- > 0;)
    sum = term(power) + " + (current * " + (power + 2 == c.size() ? sum : "(" + sum + ")") + ")";
  return sum;
}

/// The numbers that stay the same while the law works; settable ones stand behind the state.
std::string constants(const LawModel& model, bool settable) {
  std::string fields, values;
  if (settable)
    for (const CParameter& parameter : c_parameters(model)) {
      if (parameter.name == kLagRate) continue;
      fields += "  double " + parameter.name + "; /* " + c_comment(parameter.unit).text() + " */\n";
      values += c_number(parameter.value) + ", ";
    }

  // The numbers as a struct, and the law's own values of it.
  std::string code = "typedef struct LawModel {\n" + fields +
                     "  double lag_rate; /* 1/s, of the coil; 0: none */\n} LawModel;\n\n"
                     "static const LawModel kLaw = {" +
                     values + c_number(model.lag_rate()) + "};\n\n";

  // Settable numbers stand behind each damper's own state.
  if (settable)
    code +=
        "static inline const LawModel* law_behind(const double* state) {\n"
        "  return (const LawModel*)(const void*)(state + @size@);\n}\n\n"
        "static void @stem@_defaults(double* state) {\n"
        "  LawModel* law = (LawModel*)(void*)(state + @size@);\n  *law = kLaw;\n}\n\n";
  return filled(code, {{"size", CText::own(std::to_string(model.state_size()))}});
}

std::string parameter_function(const LawModel& model, bool settable) {
  const std::size_t own =
      model.law().side_row > 0 ? model.law().side_row : model.law().params.size();
  std::string lines;
  for (std::size_t k = 0; k < own; ++k) {
    const ParamInfo& info = model.law().params[k];
    lines += "  p->" + std::string(info.name) + " = " + expression(model, k, settable) + "; /* " +
             c_comment(info.unit).text() + ", " + c_comment(info.meaning).text() + " */\n";
  }
  return "/* The parameters at a current in the coil. */\n"
         "static inline void law_parameters(const LawModel* m, double current, LawParameters* p) "
         "{\n"
         "  (void)m;\n" +
         std::string(model.follows_current() && own == model.law().params.size()
                         ? ""
                         : "  (void)current;\n") +
         lines + "}\n\n";
}

/// What the damper gives more in one direction, where rebound and compression differ.
std::string side_function(const LawModel& model, bool settable) {
  const std::size_t first = model.law().side_row;
  if (first == 0) return "";
  const auto row = [&](std::size_t k) { return expression(model, first + k, settable); };
  return "#include \"law_side.h\"\n"
         "static inline double law_side_at(const LawModel* m, double current, double v) {\n"
         "  (void)m;\n" +
         std::string(model.follows_current() ? "" : "  (void)current;\n") + "  return law_side(" +
         row(0) + ", " + row(1) + ", " + row(2) + ", v);\n}\n\n";
}

/// The functions that the text of the integrator calls.
constexpr const char* kSteps = R"(static inline int law_states(const LawModel* m) {
  (void)m;
  return @states@;
}

static inline double law_rate(const LawModel* m, const LawParameters* p, double speed) {
  (void)m;
  return @law@_rate(p, speed);
}

static inline int law_has_own_step(const LawModel* m) {
  (void)m;
  return @has_step@;
}

static inline int law_own_step_is_exact(const LawModel* m) {
  (void)m;
  return @exact@;
}

static inline int law_own_step(const LawModel* m, const LawParameters* p, const double* x, const double* v,
                               double h, double* z) {
  (void)m;
@own_step@}

static inline void law_explicit_step(const LawModel* m, const LawParameters* const* p, const double* x,
                                     const double* v, double h, double* z) {
  (void)m;
  law_runge_kutta(p, x, v, h, @states@, z);
}

)";

std::string own_step(const Law& law) {
  const std::string name = c_law_name(law);
  if (!law.step) return "  (void)p;\n  (void)x;\n  (void)v;\n  (void)h;\n  (void)z;\n  return 0;\n";
  if (!law.exact_step) return "  return " + name + "_step(p, x, v, h, z);\n";
  const std::string travels = "  (void)x;\n  z[0] = law_travel_step(p, v, h, z[0]);\n";
  if (!law.text) {
    const bool filters =
        c_text(name + ".h").find(' ' + name + "_filter(") != std::string_view::npos;
    return travels + (filters ? "  " + name + "_filter(p, v, h, z);\n" : "") + "  return 1;\n";
  }

  // The closed form of a law from a file may ask for certain parameters.
  if (!law.text->travel()->holds) return travels + "  return 1;\n";
  return "  int done = 0;\n  (void)x;\n  if (" + name +
         "_travel_holds(p) != 0) {\n    z[0] = law_travel_step(p, v, h, z[0]);\n    done = 1;\n"
         "  }\n  return done;\n";
}

/// From the law's derivative to law_advance().
std::string integration(const Law& law) {
  const std::string name = c_law_name(law), states = std::to_string(law.states.size());
  std::string code =
      "#define LAW_MOST_STATES " + states +
      "\n\nstatic inline void law_derivative(const LawParameters* p, double x, double v, const "
      "double* z, double* dz) {\n  " +
      name + "_derivative(p, x, v, z, dz);\n}\n\n" + "#include \"law_runge_kutta.h\"\n";

  // A law with an exact step brings its own.
  if (law.exact_step)
    code +=
        "static inline double law_travel(const LawParameters* p, double z, double s) {\n  return " +
        name + "_travel(p, z, s);\n}\n\n" + "#include \"law_travel.h\"\n";
  code += filled(kSteps, {{"states", CText::own(states)},
                          {"law", CText::own(name)},
                          {"has_step", CText::own(law.step ? "1" : "0")},
                          {"exact", CText::own(law.exact_step ? "1" : "0")},
                          {"own_step", CText::own(own_step(law))}});
  return code + "#include \"law_path.h\"\n#include \"law_integrate.h\"\n";
}

constexpr const char* kCoilAlone =
    R"(static void @stem@_advance(const DamperInput* from, const DamperInput* to, double dt,
                          double* state) {
  const LawPath path = law_path(@law_model@, from, to, dt, state[0]);
  state[0] = law_path_current(&path, dt);
}

)";

constexpr const char* kNoState =
    R"(static void @stem@_advance(const DamperInput* from, const DamperInput* to, double dt,
                          double* state) {
  (void)from;
  (void)to;
  (void)dt;
  (void)state;
}

)";

constexpr const char* kAdvance =
    R"(static void @stem@_advance(const DamperInput* from, const DamperInput* to, double dt,
                          double* state) {
  law_advance(@law_model@, from, to, dt, state);
}

)";

std::string advance_function(const LawModel& model) {
  if (!model.law().states.empty()) return kAdvance;
  return model.lag_rate() > 0 ? kCoilAlone : kNoState;
}

std::string rest_function(const LawModel& model) {
  std::string code = "static void @stem@_rest(const DamperInput* input, double* state) {\n";
  if (model.law().rest)
    code +=
        "  LawParameters p;\n"
        "  law_parameters(@law_model@, input->current, &p);\n"
        "  @law@_rest(&p, input->displacement, input->velocity, state);\n";
  if (model.lag_rate() > 0) code += "  state[@states@] = input->current; /* in the coil */\n";
  if (model.state_size() == 0) code += "  (void)input;\n  (void)state;\n";
  return code + "}\n\n";
}

std::string force_function(const LawModel& model) {
  const std::string current = model.lag_rate() > 0 ? "state[@states@]" : "input->current";
  const std::string side = model.law().side_row > 0 ? " +\n         law_side_at(@law_model@, " +
                                                          current + ", input->velocity)"
                                                    : "";
  return "static double @stem@_force(const DamperInput* input, const double* state) {\n"
         "  LawParameters p;\n"
         "  law_parameters(@law_model@, " +
         current +
         ", &p);\n"
         "  return @law@_force(&p, input->displacement, input->velocity, state)" +
         side + ";\n}\n\n";
}

std::string derivative_function(const LawModel& model) {
  std::string code =
      "static void @stem@_derivatives(const DamperInput* input, const double* state, double* "
      "derivatives) "
      "{\n";
  if (!model.law().states.empty())
    code += "  LawParameters p;\n  law_parameters(@law_model@, " +
            std::string(model.lag_rate() > 0 ? "state[@states@]" : "input->current") +
            ", &p);\n"
            "  @law@_derivative(&p, input->displacement, input->velocity, state, derivatives);\n";
  if (model.lag_rate() > 0)
    code +=
        "  derivatives[@states@] = (@law_model@)->lag_rate * (input->current - state[@states@]);\n";
  return code + "}\n\n";
}

}  // namespace

std::vector<CParameter> c_parameters(const LawModel& model) {
  std::vector<CParameter> parameters;
  const Dependence& values = model.parameters();
  for (std::size_t k = 0; k < model.law().params.size(); ++k) {
    const ParamInfo& info = model.law().params[k];
    if (info.fit == Fit::Drive) continue;
    const Form form = values.forms[k];
    for (std::size_t index = 0; index < values.coefficients[k].size(); ++index) {
      CParameter& row = parameters.emplace_back();
      row = {coefficient_name(info.name, form, index),
             coefficient_unit(info.unit, form, index, model.drive_unit()),
             std::string(info.meaning) + std::string(coefficient_place(form, index)),
             values.coefficients[k][index]};
      // The first coefficient of a polynomial is the parameter itself at current 0; records at
      // other currents may have left it beyond the bounds there.
      if (is_polynomial(form) && index == 0) {
        row.lower = std::min(info.lower, row.value);
        row.upper = std::max(info.upper, row.value);
      }
    }
  }

  // The coil's lag can be set where there is one.
  constexpr double kSlowest = 1e-3, kFastest = 1e6;  // 1/s
  if (model.lag_rate() > 0)
    parameters.push_back({std::string(kLagRate), "1/s",
                          "of the coil: its current follows the command at this rate",
                          model.lag_rate(), std::min(kSlowest, model.lag_rate()),
                          std::max(kFastest, model.lag_rate())});
  return parameters;
}

CModel c_law(const LawModel& model, const std::string& stem, bool settable) {
  const Law& law = model.law();
  const std::string name = c_law_name(law);
  if (!law.text && !has_c_text(name + ".h"))
    throw Error(name, "its law has no C text in this build of Dashpot");
  std::string code = (law.text ? c_law_equations(law) : "#include \"" + name + ".h\"\n") +
                     "typedef " + pascal_case(name) + " LawParameters;\n\n" +
                     constants(model, settable) + parameter_function(model, settable) +
                     side_function(model, settable);

  // The integrator of the states, where there are any.
  if (model.state_size() > 0)
    code +=
        "static inline double law_lag_rate(const LawModel* m) {\n  return m->lag_rate;\n}\n\n"
        "static inline int law_follows_current(const LawModel* m) {\n  (void)m;\n  return " +
        std::string(model.follows_current() ? "1" : "0") + ";\n}\n\n";
  if (!law.states.empty())
    code += integration(law);
  else if (model.lag_rate() > 0)
    code += "#include \"law_path.h\"\n";

  // The functions of the model, with its numbers filled in.
  const bool has_derivatives = model.state_size() > 0 && stem == "model";
  code = filled(code + rest_function(model) + advance_function(model) + force_function(model) +
                    (has_derivatives ? derivative_function(model) : ""),
                {{"law_model", CText::own(settable ? "law_behind(state)" : "&kLaw")},
                 {"stem", CText::own(stem)},
                 {"law", CText::own(name)},
                 {"states", CText::own(std::to_string(law.states.size()))}});
  return {code, has_derivatives};
}

}  // namespace dashpot
