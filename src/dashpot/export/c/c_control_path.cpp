#include "dashpot/export/c/c_control_path.h"

#include <algorithm>

#include "dashpot/base/escape.h"
#include "dashpot/damper/inverse/inverse.h"
#include "dashpot/error.h"
#include "dashpot/export/c/c_inverse.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/c_subset/c_tokens.h"
#include "dashpot/suspension/control/sensors.h"

namespace dashpot {
namespace {

constexpr const char* kTypes = R"(typedef damper_demand DamperDemand;
typedef damper_kind DemandKind;
#define kDemandDamping DAMPER_DAMPING
#define kDemandForce DAMPER_FORCE
#define kDemandCurrent DAMPER_CURRENT

typedef struct ControlLimits {
  double damping_min, damping_max; /* N*s/m */
  double current_min, current_max;
} ControlLimits;

static const ControlLimits kLimits = @limits@;

)";

constexpr const char* kCommand =
    R"(static double strut_command(const StrutSignals* s, const DamperDemand* demand,
                            double* state) {
@unused@  double command = demand->value;
@otherwise@  return command;
}

)";

constexpr const char* kStraight = R"(  if (demand->kind != kDemandCurrent) {
    command = straight_current(demand, @velocity@, &kLimits);
  }
)";

constexpr const char* kInverse = R"(  if (demand->kind != kDemandCurrent) {
    const double ratio = @ratio@; /* of the damper's travel to the strut's */
    InverseInput input;
    double wanted = demanded_force(demand, s->deflection_velocity);
@loop@    input.wanted = wanted / ratio;
    input.displacement = ratio * s->deflection;
    input.velocity = ratio * s->deflection_velocity;
    input.current = s->current;
    input.measured = @measured@;
    command = inverse_command(&kInverse, &input, &state[@inverse@]);
@limit@  }
)";

constexpr const char* kInverseTypes = R"(typedef struct DamperInput {
  double displacement, velocity, current;
} DamperInput;

typedef struct InverseInput {
  double wanted, displacement, velocity, current, measured;
} InverseInput;

)";

constexpr const char* kLoop = R"(typedef struct ForceLoop {
  double proportional, integral, derivative; /* 1, 1/s, s */
} ForceLoop;

static const ForceLoop kLoop = @gains@;

#include "force_loop.h"
)";

bool has(const std::set<std::string>& names, const char* name) { return names.count(name) > 0; }

/// The parts of a strut's state, one behind the other: the filters that make velocities, the laws'
/// memory, the force loop, the inverse.
struct Layout {
  bool body = false, slope = false;  ///< whether there is a filter for the body, the deflection
  std::size_t memory = 0, loop = 0, inverse = 0, end = 0;  ///< where they begin

  std::size_t slope_at() const { return body ? 2 : 0; }
};

/// The damper that all demands are for. Throws Error where there are several with an inverse each.
const MountedDamper& damper_of(const Vehicle& vehicle) {
  const MountedDamper& first = vehicle.dampers.front();
  for (std::size_t k = 1; k < vehicle.dampers.size(); ++k)
    if (first.inverse && (vehicle.damper_names[k] != vehicle.damper_names[0] ||
                          vehicle.dampers[k].motion_ratio != first.motion_ratio))
      throw Error("controller",
                  "has an inverse for each of " + vehicle.damper_names[0] + " and " +
                      vehicle.damper_names[k],
                  "one damper for all struts, or an export for each");
  return first;
}

/// The texts and the function from a demand to a command: the demand itself where laws ask for
/// currents, a straight line over the current where there is no inverse, else the inverse.
std::string command_code(const MountedDamper& damper, const CControlLaw& law, const Layout& at) {
  const bool only_current = !law.gives_damping && !law.gives_force, loops = damper.loop.is_closed();
  std::string texts, otherwise;
  if (!only_current && !damper.inverse) {
    texts = "#include \"straight_current.h\"\n";
    otherwise = filled(
        kStraight, {{"velocity", CText::own(law.gives_force ? "s->deflection_velocity" : "0")}});
  } else if (!only_current) {
    texts = kInverseTypes + c_inverse(*damper.inverse).code + "#include \"demanded_force.h\"\n";

    // The loop corrects the wanted force before the inverse, and learns of the limits behind it.
    const ForceLoop& loop = damper.loop;
    if (loops)
      texts += filled(kLoop, {{"gains", CText::own(c_numbers(std::vector{
                                            loop.proportional, loop.integral, loop.derivative}))}});
    otherwise = filled(
        kInverse,
        {{"ratio", CText::own(c_number(damper.motion_ratio))},
         {"loop", CText::own(loops ? "    wanted = force_loop_step(&kLoop, wanted, s->force, "
                                     "DAMPER_SAMPLE_TIME, &state[" +
                                         std::to_string(at.loop) + "]);\n"
                                   : "")},
         {"limit", CText::own(loops ? "    force_loop_limit(command, " +
                                          c_number(damper.driver.current_min) + ", " +
                                          c_number(damper.driver.current_max) + ", &state[" +
                                          std::to_string(at.loop) + "]);\n"
                                    : "")},
         {"measured", CText::own(damper.inverse->has_feedback() ? "s->force / ratio" : "0")},
         {"inverse", CText::own(std::to_string(at.inverse))}});
  }

  // A parameter that the function does without is named, as compilers ask for it.
  const bool sees = has_c(otherwise, "s->"), keeps = has_c(otherwise, "state");
  return texts + filled(kCommand, {{"unused", CText::own(std::string(sees ? "" : "  (void)s;\n") +
                                                         (keeps ? "" : "  (void)state;\n"))},
                                   {"otherwise", CText::own(otherwise)}});
}

std::string demand_function(const CControlLaw& law) {
  std::string unused;
  for (const char* name : {"input", "strut", "state"})
    if (!has_c(law.demand, name)) unused += "  (void)" + std::string(name) + ";\n";
  return "static DamperDemand strut_demand(const StrutSignals* s, const damper_input* input, int "
         "strut,\n"
         "                                 double* state) {\n" +
         unused + "  return " + law.demand + ";\n}\n\n";
}

/// The sensors that a car has for these signals.
std::set<std::string> sensors_for(const std::set<std::string>& signals) {
  std::set<std::string> sensors;
  for (const std::string& name : signals) {
    if (name == "force" || name == "current") sensors.insert(name);
    if (name.starts_with("body") || name == "wheel_velocity") sensors.insert("body_acceleration");
    if (name.starts_with("deflection") || name == "wheel_velocity") sensors.insert("deflection");
  }
  return sensors;
}

std::vector<const StrutSignal*> signals_named(const std::set<std::string>& names) {
  std::vector<const StrutSignal*> signals;
  for (const StrutSignal& signal : strut_signals())
    if (names.count(std::string(signal.name))) signals.push_back(&signal);
  return signals;
}

/// The function from what the sensors of a car measure to the signals that the laws look at.
std::string filters_function(const Vehicle& vehicle, const std::set<std::string>& used,
                             const Layout& at) {
  const Sensors filters(vehicle.sensors, 1, vehicle.limits.sample_time);
  std::string texts, fields, lines;
  if (at.body) {
    texts += "#include \"leaky_integral.h\"\n";
    lines += "  const double body_velocity =\n      leaky_integral(measured->body_acceleration, " +
             c_number(filters.keep()) + ", DAMPER_SAMPLE_TIME, &state[0]);\n";
  }
  if (at.slope) {
    texts += "#include \"filtered_slope.h\"\n";
    lines += "  const double deflection_velocity =\n      filtered_slope(measured->deflection, " +
             c_number(filters.share()) + ", DAMPER_SAMPLE_TIME, &state[" +
             std::to_string(at.slope_at()) + "]);\n";
  }

  // A field for each signal: measured, or made of what is.
  lines += "  StrutSignals s;\n";
  for (const StrutSignal* signal : signals_named(used)) {
    const std::string name(signal->name);
    const bool made = name.ends_with("velocity");
    fields += "  double " + name + "; /* " + std::string(signal->meaning) + " */\n";
    lines += "  s." + name + " = " +
             (name == "wheel_velocity" ? "body_velocity - deflection_velocity"
                                       : (made ? "" : "measured->") + name) +
             ";\n";
  }
  return "typedef struct StrutSignals {\n" + fields + "} StrutSignals;\n\n" + texts +
         "static StrutSignals strut_signals(const damper_signals* measured, double* state) {\n" +
         (at.body || at.slope ? "" : "  (void)state;\n") + lines + "  return s;\n}\n\n";
}

constexpr const char* kMeasured = R"(typedef damper_signals StrutSignals;

static StrutSignals strut_signals(const damper_signals* measured, double* state) {
  (void)state;
  return *measured;
}

)";

std::string rest_function(const MountedDamper& damper, const Layout& at, bool inverts) {
  // Filters and inverse begin at the first sample, as after a long rest there.
  std::string lines;
  if (at.body)
    lines +=
        "  state[1] = (isfinite(measured->body_acceleration) != 0) ? measured->body_acceleration : "
        "0;\n";
  if (at.slope)
    lines += "  state[" + std::to_string(at.slope_at() + 1) +
             "] = (isfinite(measured->deflection) != 0) ? measured->deflection : 0;\n";
  if (inverts)
    lines +=
        "  DamperInput still;\n  still.displacement = " + c_number(damper.motion_ratio) +
        " * measured->deflection;\n  still.velocity = 0;\n  still.current = measured->current;\n"
        "  inverse_rest(&still, &state[" +
        std::to_string(at.inverse) + "]);\n";
  if (lines.empty()) lines = "  (void)measured;\n  (void)state;\n";
  return "static void strut_rest(const damper_signals* measured, double* state) {\n" + lines +
         "}\n\n";
}

}  // namespace

CControlPath c_control_path(const Vehicle& vehicle) {
  // The laws say which signals they look at.
  const MountedDamper& damper = damper_of(vehicle);
  const ControlDescription description = vehicle.controller->description();
  CControlLaw law = c_control_law(description, vehicle.dampers.size(), 0);
  const bool inverts = damper.inverse && (law.gives_damping || law.gives_force);
  std::set<std::string> used = signals_in(with_texts(law.code + command_code(damper, law, {})));
  if (used.empty()) used.insert("deflection_velocity");  // C has no empty structs

  // With these the state is laid out; then the laws know where their memory is.
  const bool in_car = vehicle.sensors.in_car;
  Layout at;
  at.body = in_car && (has(used, "body_velocity") || has(used, "wheel_velocity"));
  at.slope = in_car && (has(used, "deflection_velocity") || has(used, "wheel_velocity"));
  at.memory = at.slope_at() + (at.slope ? 2 : 0);
  law = c_control_law(description, vehicle.dampers.size(), at.memory);
  at.loop = at.memory + law.memory;
  at.inverse = at.loop + (inverts && damper.loop.is_closed() ? 3 : 0);
  at.end = at.inverse + (inverts ? damper.inverse->state_size() : 0);

  const ControlLimits& limits = vehicle.limits;
  const std::string types = filled(
      kTypes,
      {{"limits", CText::own(c_numbers(std::vector{limits.damping_min, limits.damping_max,
                                                   limits.current_min, limits.current_max}))}});
  return {types + (in_car ? filters_function(vehicle, used, at) : kMeasured) + law.code +
              command_code(damper, law, at) + rest_function(damper, at, inverts) +
              demand_function(law),
          signals_named(in_car ? sensors_for(used) : used),
          std::max<std::size_t>(1, at.end),
          law.states,
          at.body,
          at.slope};
}

}  // namespace dashpot
