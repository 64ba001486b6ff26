#include "dashpot/export/c/c_controller.h"

#include <algorithm>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/inverse/inverse.h"
#include "dashpot/error.h"
#include "dashpot/export/c/c_control_path.h"
#include "dashpot/export/c/c_controller_run.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {
namespace {

constexpr std::size_t kControllerTestSteps = 200;

constexpr const char* kControllerAbout =
    R"(Dampers: @dampers@.
Damping from @damping_min@ to @damping_max@ N*s/m over commands from @low@ to @high@@unit@.@inverse@
@sensors@@remarks@)";

constexpr const char* kControllerHeader = R"(/* @title@
 *
 * For @plant@. @about@
 *
 *   damper_model model;
 *   damper_init(&model);
 *   for (;;) damper_step(&model, &input, commands);
 *
 * C99 with math.h: no heap, no files, no variables outside a damper_model.
 * Made by Dashpot @version@:
 *   @command@
 * MISRA C:2012, deviations: @deviations@
 */
#ifndef DAMPER_H
#define DAMPER_H

#define DAMPER_STRUTS @struts@
@plant_states@#define DAMPER_STATE_SIZE @size@ /* numbers in the state, where they are needed */
#define DAMPER_SAMPLE_TIME @sample_time@ /* s, between two calls of damper_step */

)";

constexpr const char* kPlantState =
    "  double plant_state[DAMPER_PLANT_STATES]; /* heights and angles from where the plant would "
    "rest on this\n"
    "                                            * ground, then their rates */\n";

/// Lines in place of the comment that stands for them.
std::string with_lines(std::string text, const std::string& name, const std::string& lines) {
  const std::string place = "  /* @" + name + "@ */\n";
  return text.replace(text.find(place), place.size(), lines);
}

std::string fields_of(const CControlPath& path) {
  std::string fields;
  for (const StrutSignal* signal : path.measured)
    fields += "  double " + std::string(signal->name) + "; /* " +
              (signal->unit.empty() ? "" : std::string(signal->unit) + ", ") +
              std::string(signal->meaning) + " */\n";
  return fields;
}

std::string sensors_text(const Vehicle& vehicle, const CControlPath& path) {
  std::vector<std::string> made;
  if (path.has_integrals)
    made.push_back("the body's by integration that forgets below " +
                   format_number(vehicle.sensors.integration_corner) + " Hz");
  if (path.has_slopes)
    made.push_back("the deflection's by differences up to " +
                   format_number(vehicle.sensors.derivative_corner) + " Hz");
  return made.empty() ? "Signals are as they are, from wherever they come."
                      : "Velocities are made here: " + join(made, ", ") + ".";
}

std::string inverse_text(const MountedDamper& damper) {
  std::string text;
  if (damper.inverse)
    text = "A wanted force becomes a current by the inverse '" + damper.inverse->name() + "'";
  const ForceLoop& loop = damper.loop;
  if (damper.inverse && loop.is_closed())
    text += ", corrected by " + format_number(loop.proportional) + ", " +
            format_number(loop.integral) + "/s and " + format_number(loop.derivative) +
            " s of what the measured one misses";
  return text.empty() ? "" : text + ".";
}

/// What is known against its numbers, a line each.
std::string remarks_text(const Vehicle& vehicle) {
  std::string text;
  for (const std::string& note : vehicle.notes) text += '\n' + c_comment(note).text() + '.';
  for (const std::string& warning : vehicle.warnings)
    text += "\nWARNING: " + c_comment(warning).text() + '.';
  return text;
}

std::string without_marks(std::string text) {
  for (char& c : text)
    if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))) c = '_';
  while (text.ends_with('_')) text.pop_back();
  return text;
}

/// The share of their range within which commands must agree with the library's. Deflections in
/// single precision are 2 nm apart, and so are their differences: a damping F / d' may be off by
/// that over the sample time, beside a speed of 10 mm/s.
double tolerance_of(const Vehicle& vehicle, const CControlPath& path, CPrecision precision) {
  if (precision == CPrecision::Double) return 1e-12;
  return path.has_slopes ? std::max(1e-5, 2e-7 / vehicle.limits.sample_time) : 1e-5;
}

std::vector<std::pair<std::string, CText>> facts(const Vehicle& vehicle, const CControlPath& path,
                                                 const ExportOptions& options) {
  const ControlLimits& limits = vehicle.limits;
  const std::size_t struts = vehicle.dampers.size(), size = struts * path.strut_state;
  std::vector<std::string> dampers = vehicle.damper_names;
  dampers.erase(std::unique(dampers.begin(), dampers.end()), dampers.end());
  const bool states = path.plant_states > 0;
  const std::string inverse = inverse_text(vehicle.dampers.front());

  return {{"title", c_comment(vehicle.controller_name)},
          {"plant", c_comment(vehicle.set.name)},
          {"dampers", c_comment(join(dampers, "; "))},
          {"damping_min", CText::own(format_number(limits.damping_min))},
          {"damping_max", CText::own(format_number(limits.damping_max))},
          {"low", CText::own(format_number(limits.current_min))},
          {"high", CText::own(format_number(limits.current_max))},
          {"unit",
           CText::own(vehicle.drive_unit == DriveUnit::None ? ""
                                                            : " " + to_string(vehicle.drive_unit))},
          {"inverse", inverse.empty() ? CText() : "\n" + c_comment(inverse)},
          {"sensors", CText::own(sensors_text(vehicle, path))},
          {"remarks", CText::own(remarks_text(vehicle))},
          {"deviations", CText::own(std::string(c_deviations()))},
          {"version", c_comment(options.version)},
          {"struts", CText::own(std::to_string(struts))},
          {"plant_states", CText::own(states ? "#define DAMPER_PLANT_STATES " +
                                                   std::to_string(path.plant_states) + "\n"
                                             : std::string())},
          {"size", CText::own(std::to_string(size))},
          {"sample_time", CText::own(c_number(limits.sample_time))}};
}

/// A part of a port for each strut, with this unit.
std::vector<CPort::Part> strut_parts(const Vehicle& vehicle, const std::string& unit) {
  std::vector<CPort::Part> parts;
  for (const Strut& strut : vehicle.set.plant.struts) parts.push_back({strut.name, unit});
  return parts;
}

std::vector<CPort> ports_of(const Vehicle& vehicle, const CControlPath& path) {
  // The signals, each an array over the struts.
  std::vector<CPort> ports;
  for (const StrutSignal* signal : path.measured) {
    const std::string name(signal->name),
        unit(signal->unit.empty() ? to_string(vehicle.drive_unit) : signal->unit);
    ports.push_back({name, unit, std::string(signal->meaning), "struts[#]." + name,
                     vehicle.dampers.size(), strut_parts(vehicle, unit)});
  }
  if (path.plant_states == 0) return ports;

  // The plant's state: all coordinates, then all their rates.
  std::vector<CPort::Part> parts;
  for (const char* rate : {"", "/s"})
    for (const Coordinate& coordinate : vehicle.set.plant.coordinates)
      parts.push_back({coordinate.name, coordinate.unit + rate});
  ports.push_back({"plant_state", "",
                   "heights and angles of the plant from where it would rest, then their rates",
                   "plant_state[#]", path.plant_states, std::move(parts)});
  return ports;
}

}  // namespace

CBlockMaker controller_block(std::shared_ptr<const Vehicle> vehicle) {
  return [vehicle = std::move(vehicle)](const ExportOptions& options) {
    return c_controller_block(*vehicle, options);
  };
}

CBlock c_controller_block(const Vehicle& vehicle, const ExportOptions& options) {
  if (!vehicle.controller) throw Error("export", "the vehicle has no controller");
  const CControlPath path = c_control_path(vehicle);
  auto values = facts(vehicle, path, options);

  // The facts that the header states, each escaped where it came in, and its struct of signals.
  const std::vector<std::string> about = split(filled(kControllerAbout, values), '\n');
  values.emplace_back("about", CText::own(join(about, "\n * ")));
  const std::string interface =
      with_lines(with_lines(std::string(c_text("control_api.h")), "signals", fields_of(path)),
                 "plant_state", path.plant_states > 0 ? kPlantState : "");
  const ControlLimits& limits = vehicle.limits;
  const std::string usual =
      without_marks(split(vehicle.controller_name, ',').front()) + "_controller";

  // The texts, the interface port by port, and the run that checks them.
  return {
      .name = c_name(options.name.empty() ? usual : options.name),
      .title = "the controller " + vehicle.controller_name + " for " + vehicle.set.name,
      .about = join(about, " "),
      .precision = options.c_precision(),
      .header = filled(kControllerHeader + interface + kCHeaderEnd, values),
      .source = "#include \"@prefix@.h\"\n\n#include <math.h>\n\n#define STRUT_STATE " +
                std::to_string(path.strut_state) + "\n\n" + with_texts(path.code) +
                std::string(c_text("control_api.c")),
      .step = "damper_step(&model, &input, commands);",
      .inputs = ports_of(vehicle, path),
      .commands = {{"command", to_string(vehicle.drive_unit), "to the damper", "commands[#]",
                    vehicle.dampers.size(), strut_parts(vehicle, to_string(vehicle.drive_unit))}},
      .state_size = vehicle.dampers.size() * path.strut_state,
      .sample_time = limits.sample_time,
      .range = limits.current_max - limits.current_min,
      .tolerance = tolerance_of(vehicle, path, options.c_precision()),
      .samples = controller_run(vehicle, path, kControllerTestSteps),
      .version = options.version};
}

}  // namespace dashpot
