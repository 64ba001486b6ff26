#include "dashpot/export/c/c_control_law.h"

#include <algorithm>
#include <array>

#include "dashpot/error.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"
#include "dashpot/export/c_subset/c_tokens.h"

namespace dashpot {
namespace {

constexpr std::array kSignals{
    StrutSignal{"body_velocity", "m/s", "of the strut's upper end", &StrutSignals::body_velocity},
    StrutSignal{"body_acceleration", "m/s^2", "of the strut's upper end",
                &StrutSignals::body_acceleration},
    StrutSignal{"wheel_velocity", "m/s", "of the strut's lower end", &StrutSignals::wheel_velocity},
    StrutSignal{"deflection", "m", "of the strut, extension positive", &StrutSignals::deflection},
    StrutSignal{"deflection_velocity", "m/s", "of the strut, extension positive",
                &StrutSignals::deflection_velocity},
    StrutSignal{"force", "N", "of the damper at the strut, positive when it resists extension",
                &StrutSignals::force},
    StrutSignal{"current", "", "in the coil now", &StrutSignals::current}};

/// Adds a law's text and numbers; returns the call that asks it for its demand. `number` keeps the
/// tables of two laws of a kind apart.
std::string add_law(const ControlDescription& law, int number, std::size_t first_memory,
                    CControlLaw& out) {
  const std::string text = "control_" + law.law + ".h", mark = std::to_string(number);
  if (law.law.empty() || !has_c_text(text))
    throw Error("controller",
                law.law.empty() ? "has no C text" : "'" + law.law + "' has no C text");

  // A law that asks for a force or a damping needs an inverse behind it.
  const std::string own = with_texts("#include \"" + text + "\"\n");
  out.gives_damping = out.gives_damping || has_c(own, "demand_of(kDemandDamping");
  out.gives_force = out.gives_force || has_c(own, "demand_of(kDemandForce");
  out.gives_current = out.gives_current || has_c(own, "demand_of(kDemandCurrent");
  out.code += "#include \"" + text + "\"\n";

  // Its arguments: its gain or its parameters, the limits, the strut's signals, its memory.
  std::string arguments;
  if (!law.gain.empty()) {
    out.code += c_table("kGain" + mark, law.gain) + "\n";
    out.states = law.gain.size() / out.struts;
    arguments = "regulator_force(&kGain" + mark +
                "[strut * DAMPER_PLANT_STATES], input->plant_state, DAMPER_PLANT_STATES), ";
  }
  if (!law.parameters.empty()) {
    out.code += "static const " + pascal_case(law.law) + " kLaw" + mark + " = " +
                c_numbers(law.parameters) + ";\n\n";
    arguments = "&kLaw" + mark + ", ";
  }
  arguments += "&kLimits, s";
  if (law.memory > 0) arguments += ", &state[" + std::to_string(first_memory + out.memory) + "]";
  out.memory += law.memory;
  return law.law + "_demand(" + arguments + ")";
}

}  // namespace

CControlLaw c_control_law(const ControlDescription& controller, std::size_t struts,
                          std::size_t first_memory) {
  CControlLaw out{.struts = struts};
  if (controller.law != "selector") {
    out.demand = add_law(controller, 0, first_memory, out);
    return out;
  }

  // A selector asks one of two laws, as the frequency of the motion has it.
  out.code = "#include \"selected_demand.h\"\n";
  const std::string low = add_law(controller.choices[0], 0, first_memory, out);
  const std::string high = add_law(controller.choices[1], 1, first_memory, out);
  out.demand = "selected_demand(s, " + c_number(controller.parameters[0]) + ", " + low +
               ",\n                         " + high + ")";
  return out;
}

std::span<const StrutSignal> strut_signals() { return kSignals; }

std::set<std::string> signals_in(const std::string& code) {
  std::set<std::string> names;
  for (const StrutSignal& signal : kSignals)
    if (has_c(code, "s->" + std::string(signal.name))) names.emplace(signal.name);
  return names;
}

}  // namespace dashpot
