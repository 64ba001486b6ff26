#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/core.h>

#include "commands.h"
#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/damper/physics/damper_physics.h"
#include "layout.h"

namespace dashpot::cli {
namespace {

struct PhysicsSettings {
  std::string damper, current = "1", velocity = "0.1", displacement = "0";
  std::vector<std::string> changes;
  bool fields = false;
};

constexpr std::string_view kPhysicsExample =
    "# Every step from the current to the force of a damper that comes with Dashpot:\n"
    "dashpot physics passenger_car --current 2 --velocity 0.3\n"
    "\n"
    "# The same of your own, with another gap:\n"
    "dashpot physics my_damper.yaml --set gap=0.8mm\n"
    "\n"
    "# What a description may state, with units and defaults:\n"
    "dashpot physics --fields";

DamperDescription described(const PhysicsSettings& settings) {
  const std::vector<std::string> known = description_names();
  DamperDescription description = std::ranges::find(known, settings.damper) != known.end()
                                      ? named_description(settings.damper)
                                      : load_description(settings.damper);

  // Each change is read in the unit of its field.
  for (const std::string& change : settings.changes) {
    const std::size_t equals = change.find('=');
    if (equals == std::string::npos)
      throw UsageError("--set", "'" + change + "' has no value; write gap=0.8mm");
    const DescriptionField& field = find_description_field(trim(change.substr(0, equals)), "--set");
    description.*field.field = parse_quantity(trim(std::string_view(change).substr(equals + 1)),
                                              field.unit, "--set " + std::string(field.name));
  }

  // A geometry that cannot be built is refused by the words that asked for it.
  require_possible(description,
                   settings.changes.empty() ? settings.damper : settings.damper + " with --set");
  return description;
}

std::string fields_table(int width) {
  Table table({"field", "unit", ">default", ">bounds", "meaning"});
  for (const DescriptionField& field : description_fields())
    table.row({std::string(field.name), std::string(field.unit), format_number(field.value),
               format_number(field.lower) + " ... " + format_number(field.upper),
               std::string(field.meaning)});
  return table.text(static_cast<std::size_t>(width)) +
         "\nBeside these: name, note, fluid (122EG, 132DG, 140CG), yield (carlson, paper, "
         "data_set), circuit (filled, paper), flow (plate, moving_wall, paper).\n";
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

int run_physics(const PhysicsSettings& settings, Console& console) {
  if (settings.fields) {
    console.print(fields_table(console.width()));
    return kDone;
  }

  if (settings.damper.empty())
    throw UsageError("DAMPER", "is missing: a file, or one of " + join(description_names(), ", "));

  // One operating point is evaluated, all steps of it.
  const DamperDescription description = described(settings);
  const DamperOperation operation{parse_quantity(settings.current, "A", "--current"),
                                  parse_quantity(settings.velocity, "m/s", "--velocity"),
                                  parse_quantity(settings.displacement, "m", "--displacement")};
  const DamperPhysics physics = evaluate_physics(description, operation);
  const std::vector<std::string> warnings = physics_warnings(description, physics);

  // Warnings are part of the JSON; on a terminal they follow the table.
  if (console.json) {
    console.print_json(Value::object({{"damper", description.name},
                                      {"current", operation.current},
                                      {"velocity", operation.velocity},
                                      {"displacement", operation.displacement},
                                      {"quantities", quantities_json(physics)},
                                      {"warnings", Value::array(warnings)}}));
    return kDone;
  }

  console.print(fmt::format("{} with {}, at {} A, {} m/s, {} m\n", description.name,
                            description.fluid->name, format_number(operation.current),
                            format_number(operation.velocity),
                            format_number(operation.displacement)) +
                quantities_text(physics));
  for (const std::string& warning : warnings) console.warn(warning);
  return kDone;
}

}  // namespace

Command physics_command() {
  auto settings = std::make_shared<PhysicsSettings>();
  return {.name = "physics",
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
                      {.names = "--fields",
                       .target = &settings->fields,
                       .help = "list the fields of a description"}},

          .example = std::string(kPhysicsExample),
          .run = [settings](Console& console) { return run_physics(*settings, console); }};
}

}  // namespace dashpot::cli
