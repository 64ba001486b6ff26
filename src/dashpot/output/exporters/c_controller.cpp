#include "dashpot/output/exporters/c_controller.h"

#include <algorithm>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"
#include "dashpot/output/exporters/c_control_path.h"
#include "dashpot/output/exporters/c_controller_run.h"
#include "dashpot/output/exporters/c_model.h"

namespace dashpot {
namespace {

constexpr std::size_t kTestSteps = 200;

constexpr const char* kHeader = R"(/* @title@
 *
 * For @plant@. Dampers: @dampers@.
 * Damping from @damping_min@ to @damping_max@ N*s/m over commands from @low@ to @high@@unit@.@inverse@
 * @sensors@
 *
 *   damper_model model;
 *   damper_init(&model);
 *   for (;;) damper_step(&model, &input, commands);
 *
 * C99 with math.h: no heap, no files, no variables outside a damper_model. Made by Dashpot @version@:
 *   @command@
 * MISRA C:2012, deviations: @deviations@
 */
#ifndef DAMPER_H
#define DAMPER_H

#define DAMPER_STRUTS @struts@
@plant_states@#define DAMPER_STATE_SIZE @size@ /* numbers in the state, where they are needed */
#define DAMPER_SAMPLE_TIME @sample_time@ /* s, between two calls of damper_step */

)";

constexpr const char* kTest =
    R"(/* Steps through a run and compares the commands with those that Dashpot @version@ computed in double precision.
 * Returns 0 when they agree within @tolerance@ of their range. */
#include "@prefix@.h"

#include <math.h>
#include <stdio.h>

#define STEPS @steps@
#define SIGNALS @signals@
#define STATES @states@
#define INPUTS ((DAMPER_STRUTS * SIGNALS) + STATES)

/* what is measured, strut by strut@and_states@; the commands */
static const double kRun[STEPS][INPUTS + DAMPER_STRUTS] = {
@rows@};

static void read_input(const double* row, damper_input* input) {
  int k;
  for (k = 0; k < DAMPER_STRUTS; ++k) {
@reads@  }
@read_states@}

int main(void) {
  damper_model model;
  double largest = 0.0;
  int k, j;
  damper_init(&model);
  for (k = 0; k < STEPS; ++k) {
    damper_input input;
    double commands[DAMPER_STRUTS];
    read_input(kRun[k], &input);
    damper_step(&model, &input, commands);
    for (j = 0; j < DAMPER_STRUTS; ++j) {
      const double difference = fabs(commands[j] - kRun[k][INPUTS + j]);
      if (!(difference <= @range@)) {
        return 2;
      }
      largest = fmax(largest, difference);
    }
  }
  printf("largest difference %g, range %g\n", (double)largest, (double)@range@);
  return (largest <= @tolerance@ * @range@) ? 0 : 1;
}
)";

constexpr const char* kPlantState =
    "  double plant_state[DAMPER_PLANT_STATES]; /* heights and angles from where the plant would rest on "
    "this\n"
    "                                            * ground, then their rates */\n";

/// Lines in place of the comment that stands for them.
std::string with_lines(std::string text, const std::string& name, const std::string& lines) {
  const std::string place = "  /* @" + name + "@ */\n";
  return text.replace(text.find(place), place.size(), lines);
}

std::string number(std::size_t count) { return std::to_string(count); }

std::string fields_of(const CControlPath& path) {
  std::string fields;
  for (const StrutSignal* signal : path.measured)
    fields += "  double " + std::string(signal->name) + "; /* " + std::string(signal->meaning) + " */\n";
  return fields;
}

std::string reads_of(const CControlPath& path) {
  std::string lines;
  for (std::size_t k = 0; k < path.measured.size(); ++k)
    lines += "    input->struts[k]." + std::string(path.measured[k]->name) + " = row[(k * SIGNALS) + " +
             number(k) + "];\n";
  return lines;
}

std::string sensors_text(const Vehicle& vehicle) {
  const SensorOptions& sensors = vehicle.sensors;
  if (!sensors.in_car) return "Signals are as they are, from wherever they come.";
  return "Velocities are made here: the body's by integration that forgets below " +
         format_number(sensors.integration_corner) + " Hz, the deflection's by differences up to " +
         format_number(sensors.derivative_corner) + " Hz.";
}

std::string inverse_text(const MountedDamper& damper) {
  std::string text;
  if (damper.inverse)
    text = "\n * A wanted force becomes a current by the inverse '" + damper.inverse->name() + "'";
  const ForceLoop& loop = damper.loop;
  if (damper.inverse && loop.is_closed())
    text += ", corrected by " + format_number(loop.proportional) + ", " + format_number(loop.integral) +
            "/s and " + format_number(loop.derivative) + " s of what the measured one misses";
  return text.empty() ? "" : text + ".";
}

std::string without_marks(std::string text) {
  for (char& c : text)
    if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))) c = '_';
  while (text.ends_with('_')) text.pop_back();
  return text;
}

/// Deflections in single precision are 2 nm apart, and so are their differences: that over the sample time
/// beside a speed of 10 mm/s is what a damping F / d may be off.
std::string tolerance_of(const Vehicle& vehicle, const CControlPath& path, CPrecision precision) {
  if (precision == CPrecision::Double) return "1e-12";
  return c_number(path.has_slopes ? std::max(1e-5, 2e-7 / vehicle.limits.sample_time) : 1e-5);
}

std::vector<std::pair<std::string, std::string>> facts(const Vehicle& vehicle, const CControlPath& path,
                                                       const ExportOptions& options) {
  const ControlLimits& limits = vehicle.limits;
  const std::size_t struts = vehicle.dampers.size(), size = struts * path.strut_state;
  std::vector<std::string> dampers = vehicle.damper_names;
  dampers.erase(std::unique(dampers.begin(), dampers.end()), dampers.end());
  const bool states = path.plant_states > 0;
  return {{"title", vehicle.controller_name},
          {"plant", vehicle.set.name},
          {"dampers", join(dampers, "; ")},
          {"damping_min", format_number(limits.damping_min)},
          {"damping_max", format_number(limits.damping_max)},
          {"low", format_number(limits.current_min)},
          {"high", format_number(limits.current_max)},
          {"unit", vehicle.drive_unit.empty() ? "" : " " + vehicle.drive_unit},
          {"inverse", inverse_text(vehicle.dampers.front())},
          {"sensors", sensors_text(vehicle)},
          {"deviations", std::string(c_deviations())},
          {"version", options.version},
          {"struts", number(struts)},
          {"plant_states",
           states ? "#define DAMPER_PLANT_STATES " + number(path.plant_states) + "\n" : std::string()},
          {"size", number(size)},
          {"sample_time", c_number(limits.sample_time)},
          {"signals", number(path.measured.size())},
          {"states", number(path.plant_states)},
          {"and_states", states ? "; the plant's state" : ""},
          {"read_states",
           states ? "  for (k = 0; k < STATES; ++k) {\n    input->plant_state[k] = row[(DAMPER_STRUTS * "
                    "SIGNALS) + k];\n  }\n"
                  : std::string()},
          {"reads", reads_of(path)},
          {"range", c_number(limits.current_max - limits.current_min)},
          {"steps", number(kTestSteps)},
          {"tolerance", tolerance_of(vehicle, path, options.c_precision())}};
}

}  // namespace

std::vector<ExportedFile> write_c_controller(const Vehicle& vehicle, const ExportOptions& options) {
  if (!vehicle.controller) throw Error("export", "the vehicle has no controller");
  const CControlPath path = c_control_path(vehicle, options.c_precision());
  const std::string prefix =
      c_name(options.name.empty() ? without_marks(split(vehicle.controller_name, ',').front()) + "_controller"
                                  : options.name);
  const std::string code = with_texts(path.code);
  require_free_names(prefix, code);
  std::vector<std::pair<std::string, std::string>> values = facts(vehicle, path, options);
  values.emplace_back("prefix", prefix);
  std::string rows;
  for (const std::vector<double>& row : controller_run(vehicle, path, kTestSteps))
    rows += "    " + c_numbers(row) + ",\n";
  values.emplace_back("rows", rows);
  const auto finished = [&](const std::string& text) {
    return filled(with_prefix(in_precision(filled(text, values), options.c_precision()), prefix),
                  {{"command", in_comment(options.command)}});
  };
  const std::string interface =
      with_lines(with_lines(std::string(c_text("control_api.h")), "signals", fields_of(path)), "plant_state",
                 path.plant_states > 0 ? kPlantState : "");
  return {{prefix + ".h", finished(kHeader + interface + kCHeaderEnd)},
          {prefix + ".c",
           finished("#include \"@prefix@.h\"\n\n#include <math.h>\n\n#define STRUT_STATE " +
                    number(path.strut_state) + "\n\n" + code + std::string(c_text("control_api.c")))},
          {prefix + "_test.c", finished(kTest)}};
}

}  // namespace dashpot
