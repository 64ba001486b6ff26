#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/escape.h"
#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/dataset.h"
#include "dashpot/identify/fit/physics_calibration.h"
#include "dashpot/physics/damper_physics.h"
#include "document_text.h"
#include "layout.h"

namespace dashpot::cli {
namespace {

struct PhysicsSettings {
  std::string damper, current = "1", velocity = "0.1", displacement = "0";
  std::string fluid, steel, output;
  std::vector<std::string> changes, recordings;
  bool fields = false;
};

constexpr std::string_view kPhysicsExample =
    "# Every step from the current to the force of a damper that comes with Dashpot:\n"
    "dashpot physics passenger_car --current 2 --velocity 0.3\n"
    "\n"
    "# The same of your own, with another gap:\n"
    "dashpot physics my_damper.yaml --set gap=0.8mm\n"
    "\n"
    "# With a fluid of your own, as its file states it:\n"
    "dashpot physics my_damper.yaml --fluid my_fluid.yaml\n"
    "\n"
    "# What recordings of that damper tell of its fluid, friction and compliance:\n"
    "dashpot physics my_damper.yaml --recordings my_recordings/ -o calibrated.yaml\n"
    "\n"
    "# What a description may state, with units and defaults:\n"
    "dashpot physics --fields";

DamperDescription described(const PhysicsSettings& settings) {
  DamperDescription description = find_description(settings.damper);

  // A fluid or a steel in place of the description's; its first law, unless it has the one asked
  // for.
  if (!settings.fluid.empty()) {
    description.fluid = find_fluid(settings.fluid, "--fluid");
    if (!description.fluid->law(description.yield_law)) description.yield_law.clear();
  }
  if (!settings.steel.empty()) {
    description.steel = find_steel(settings.steel, "--steel");
    if (description.steel->points.empty()) {
      description.permeability = description.steel->permeability;
      description.saturation = description.steel->saturation;
    }
  }

  // Each change is read in the unit of its field.
  for (const std::string& change : settings.changes) {
    const std::size_t equals = change.find('=');
    if (equals == std::string::npos)
      throw UsageError("--set", "'" + change + "' has no value; write gap=0.8mm");
    const std::string name(trim(std::string_view(change).substr(0, equals)));
    if (name == "fluid" || name == "steel")
      throw UsageError("--set", "'" + name + "' is no number", "--" + name);
    const DescriptionField& field = find_description_field(name, "--set");
    if (description.steel && (field.field == &DamperDescription::saturation ||
                              field.field == &DamperDescription::permeability))
      throw UsageError("--set",
                       std::string(field.name) + " stands beside the steel " +
                           description.steel->name + ", which has its own",
                       "a drawing without 'steel', or another steel: --steel");
    description.*field.field = parse_quantity(trim(std::string_view(change).substr(equals + 1)),
                                              field.unit, "--set " + std::string(field.name));
  }

  // A geometry that cannot be built is refused by the words that asked for it.
  const std::string where =
      settings.changes.empty() ? settings.damper : settings.damper + " with --set";
  require_possible(description, where);
  require_field(description, where);
  return description;
}

std::string fields_table(int width) {
  Table table({"field", "unit", ">default", ">bounds", "meaning"});
  for (const DescriptionField& field : description_fields())
    table.row({std::string(field.name), std::string(field.unit), format_number(field.value),
               format_number(field.lower) + " ... " + format_number(field.upper),
               std::string(field.meaning)});
  return table.text(static_cast<std::size_t>(width)) + "\nBeside these: name, note, fluid (" +
         join(fluid_names(), ", ") +
         ", or a file), yield (a law of the fluid's file: carlson, paper, data_set), steel (" +
         join(steel_names(), ", ") +
         ", or a file), circuit (filled, paper), flow (plate, moving_wall, paper).\n";
}

std::string quantities_text(const DamperPhysics& physics) {
  std::string text;
  std::string_view group;
  for (const PhysicsQuantity& quantity : physics_quantities()) {
    if (quantity.group != group) text += fmt::format("\n{}\n", group = quantity.group);
    const std::string unit(quantity.unit == "1" ? "" : quantity.unit);
    text += fmt::format("  {:<46} {:>10} {:<6} {}\n", quantity.name,
                        format_number(physics.*quantity.value), unit, quantity.equation);
  }
  return text;
}

/// What the files of fluid and steel leave open of the force.
std::string uncertainty_text(const std::vector<KnownWithin>& known) {
  if (known.empty()) return {};
  std::string text = "\nknown within a standard deviation\n";
  double square = 0;
  for (const KnownWithin& one : known) {
    text += fmt::format("  {:<46} {:>10} %      force ±{} N\n", one.what,
                        format_number(100 * one.share, 3), format_number(one.force, 3));
    square += one.force * one.force;
  }
  return text + fmt::format("  {:<46} {:>10}        force ±{} N\n", "together", "",
                            format_number(std::sqrt(square), 3));
}

/// At rest the damper holds, whatever pulls, and no figure above says so.
std::string rest_warning(const DamperDescription& description, const DamperPhysics& physics) {
  return "at rest nothing flows: the forces are those of a spring, if there is one, and not the " +
         format_number(physics.piston_area * physics.yield_pressure + description.friction) +
         " N up to which the damper holds";
}

/// Where no piston can be: mostly a number of millimetres.
std::string stroke_warning(const DamperDescription& description, double displacement) {
  return "a displacement of " + format_number(displacement) + " m is beyond the stroke, " +
         format_number(description.stroke) + " m from end to end";
}

Value quantities_json(const DamperPhysics& physics) {
  Value list = Value::array();
  for (const PhysicsQuantity& quantity : physics_quantities()) {
    const double value = physics.*quantity.value;
    list.push_back(Value::object({{"group", quantity.group},
                                  {"name", quantity.name},
                                  {"value", std::isfinite(value) ? Value(value) : Value()},
                                  {"unit", quantity.unit},
                                  {"equation", quantity.equation}}));
  }
  return list;
}

std::string calibration_text(const PhysicsCalibration& found, int width) {
  Table table({"number", ">found", ">95 % interval", "unit", "is"});
  constexpr std::pair<std::string_view, std::string_view> kMeanings[] = {
      {"yield_stress", "times that of the fluid's file"},
      {"viscosity", "times that of the fluid's file"},
      {"friction", "of seals and guides"},
      {"seal_give", "way over which the seal gives before it slides"},
      {"stiffness", "of the spring in series with the flow: the compliance"}};
  for (const PhysicsCalibration::Number& number : found.numbers)
    for (const auto& [name, meaning] : kMeanings)
      if (name == number.name)
        table.row({number.name, format_number(number.value, 4),
                   number.is_known
                       ? format_number(number.low, 4) + " ... " + format_number(number.high, 4)
                       : "not told",
                   number.unit == "1" ? "" : number.unit, std::string(meaning)});

  Table levels({">current", ">field", ">yield stress", ">times the file's"});
  for (const PhysicsCalibration::Level& level : found.levels)
    levels.row({format_number(level.current) + " A", format_number(level.field / 1e3, 4) + " kA/m",
                format_number(level.yield_stress / 1e3, 4) + " kPa",
                format_number(level.ratio, 4)});
  return table.text(static_cast<std::size_t>(width)) +
         "\nEach current by itself, the rest as above:\n\n" +
         levels.text(static_cast<std::size_t>(width)) +
         fmt::format(
             "\nThe drawing leaves {} % of the force's power in free run, calibrated {} %.\n",
             format_number(found.esr_before, 3), format_number(found.esr_after, 3));
}

Value calibration_json(const PhysicsCalibration& found) {
  Value numbers = Value::object(), levels = Value::array();
  for (const PhysicsCalibration::Number& number : found.numbers)
    numbers.add(number.name, Value::object({{"value", number.value},
                                            {"low", number.low},
                                            {"high", number.high},
                                            {"unit", number.unit},
                                            {"known", number.is_known}}));

  for (const PhysicsCalibration::Level& level : found.levels)
    levels.push_back(Value::object({{"current", level.current},
                                    {"field", level.field},
                                    {"yield_stress", level.yield_stress},
                                    {"ratio", level.ratio}}));

  return Value::object({{"numbers", std::move(numbers)},
                        {"levels", std::move(levels)},
                        {"esr_before", found.esr_before},
                        {"esr_after", found.esr_after},
                        {"doubts", Value::array(found.doubts)}});
}

/// Recordings of the drawn damper say what its drawing does not know.
int run_calibration(const PhysicsSettings& settings, Console& console) {
  require_output(settings.output);
  const Dataset data = load_dataset({settings.recordings.begin(), settings.recordings.end()});
  const PhysicsCalibration found = calibrate_physics(described(settings), data, console.monitor());

  if (console.json)
    console.print_json(calibration_json(found));
  else
    console.print(calibration_text(found, console.width()));
  for (const std::string& doubt : found.doubts) console.warn(doubt);

  // The calibrated drawing holds its fluid, so that every command takes it.
  if (settings.output.empty()) return kDone;
  const PhysicsCalibration::Number& spring = found.numbers.back();
  write_file(settings.output,
             "# Calibrated on " + yaml_comment(data.name) + " by " +
                 yaml_comment(console.command_line()) +
                 "\n# In series with the flow: " + format_number(spring.value, 4) + " N/m" +
                 (spring.is_known ? ", " + format_number(spring.low, 4) + " ... " +
                                        format_number(spring.high, 4) + " N/m with 95 %"
                                  : ", which the recordings do not tell") +
                 '\n' + format_description(found.damper));
  if (!console.json) console.print("\nDrawing  " + settings.output + '\n');
  return kDone;
}

int run_physics(const PhysicsSettings& settings, Console& console) {
  if (settings.fields) {
    console.print(fields_table(console.width()));
    return kDone;
  }

  if (settings.damper.empty())
    throw UsageError("DAMPER", "is missing: a file, or one of " + join(description_names(), ", "));

  if (!settings.recordings.empty()) return run_calibration(settings, console);
  if (!settings.output.empty())
    throw UsageError("--output", "is of a calibration", "give --recordings, too");

  // One operating point is evaluated, all steps of it.
  const DamperDescription description = described(settings);
  const DamperOperation operation{parse_quantity(settings.current, "A", "--current"),
                                  parse_quantity(settings.velocity, "m/s", "--velocity"),
                                  parse_quantity(settings.displacement, "m", "--displacement")};
  const DamperPhysics physics = evaluate_physics(description, operation);
  std::vector<std::string> warnings = physics_warnings(description, physics);
  if (operation.velocity == 0) warnings.push_back(rest_warning(description, physics));
  if (std::abs(operation.displacement) > description.stroke)
    warnings.push_back(stroke_warning(description, operation.displacement));
  const std::vector<KnownWithin> known = force_uncertainty(description, operation);

  // Warnings are part of the JSON; on a terminal they follow the table.
  if (console.json) {
    Value json = Value::object({{"damper", description.name},
                                {"current", operation.current},
                                {"velocity", operation.velocity},
                                {"displacement", operation.displacement},
                                {"quantities", quantities_json(physics)},
                                {"warnings", Value::array(warnings)}});
    Value within = Value::array();
    for (const KnownWithin& one : known)
      within.push_back(
          Value::object({{"what", one.what}, {"share", one.share}, {"force", one.force}}));
    if (!known.empty()) json.add("known_within", std::move(within));
    console.print_json(json);
    return kDone;
  }

  console.print(fmt::format("{} with {}, at {} A, {} m/s, {} m\n", description.name,
                            description.fluid->name, format_number(operation.current),
                            format_number(operation.velocity),
                            format_number(operation.displacement)) +
                quantities_text(physics) + uncertainty_text(known));
  for (const std::string& warning : warnings) console.warn(warning);
  return kDone;
}

}  // namespace

Command physics_command() {
  auto settings = std::make_shared<PhysicsSettings>();
  return {
      .name = "physics",
      .title = "From drawing, coil and fluid to force: every step with its unit",
      .description =
          "Reads a damper description (YAML: gap: 1 mm, turns: 150, fluid: 140CG ...) and "
          "prints spring, magnetic circuit, coil, fluid, pressures and forces at one current "
          "and speed. By itself it solves the circuit with fluid in the gap and steel that "
          "saturates, and the exact flow of a Bingham fluid between plates; a description may "
          "ask for the equations of the family paper instead.",

      .options = {{.names = "DAMPER",
                   .target = &settings->damper,
                   .help = "a damper description, or one that comes with Dashpot: " +
                           join(description_names(), ", "),
                   .takes = Takes::File},

                  // The operating point.
                  {.names = "--current",
                   .target = &settings->current,
                   .help = "current in the coil",
                   .value = "A"},
                  {.names = "--velocity",
                   .target = &settings->velocity,
                   .help = "velocity of the piston, extension positive",
                   .value = "M/S"},
                  {.names = "--displacement",
                   .target = &settings->displacement,
                   .help = "displacement of the piston from where the spring is free",
                   .value = "M"},

                  // The description's fields.
                  {.names = "--set",
                   .target = &settings->changes,
                   .help = "fields in place of the description's, as gap=0.8mm,turns=200",
                   .value = "LIST"},
                  {.names = "--fluid",
                   .target = &settings->fluid,
                   .help = "a fluid in its place: a file, or one of " + join(fluid_names(), ", "),
                   .value = "FLUID",
                   .takes = Takes::File},
                  {.names = "--steel",
                   .target = &settings->steel,
                   .help = "a steel in its place: a file with its B-H curve, or one of " +
                           join(steel_names(), ", "),
                   .value = "STEEL",
                   .takes = Takes::File},

                  // Recordings of the drawn damper.
                  {.names = "--recordings",
                   .target = &settings->recordings,
                   .help = "recordings of this damper: how its yield stress, viscosity, "
                           "friction and compliance differ from the drawing's, and how well "
                           "they are known",
                   .value = "DATA",
                   .takes = Takes::File,
                   .idles = {{{"--current", "--velocity", "--displacement"},
                              ", which have currents and motions of their own"}}},
                  {.names = "-o,--output",
                   .target = &settings->output,
                   .help = "write the calibrated drawing, its fluid in it",
                   .value = "FILE",
                   .takes = Takes::File},
                  {.names = "--fields",
                   .target = &settings->fields,
                   .help = "list the fields of a description"}},

      .example = std::string(kPhysicsExample),
      .run = [settings](Console& console) { return run_physics(*settings, console); }};
}

}  // namespace dashpot::cli
