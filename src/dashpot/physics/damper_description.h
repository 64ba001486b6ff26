#pragma once
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/physics/fluid.h"
#include "dashpot/physics/steel.h"
#include "dashpot/value.h"

namespace dashpot {

/// The law by which the flux density follows the coil's current.
enum class CircuitLaw {
  Filled,  ///< fluid in the gap, steel that saturates: solved for the flux
  Paper    ///< equations 2 to 8 of the family paper: air in the gap, then saturated
};
/// The law by which pressure follows flow.
enum class FlowLaw {
  Plate,       ///< Bingham fluid between parallel plates, exact
  MovingWall,  ///< the same where one plate is the piston's land, with its drag
  Paper        ///< equations 13 to 15 of the family paper, dimensionally right
};

/// A damper as its drawing, its coil and its fluid say, in SI. description_fields() gives each
/// number's unit, default, bounds and meaning. A field of 0 whose meaning says so follows from
/// others. `fluid` is never null; without a `steel` the steel is that of permeability and
/// saturation.
struct DamperDescription {
  std::string name;
  std::shared_ptr<const Fluid> fluid;
  std::string yield_law;  ///< of the fluid's laws; "": its first
  std::shared_ptr<const Steel> steel;
  CircuitLaw circuit_law = CircuitLaw::Filled;
  FlowLaw flow_law = FlowLaw::Plate;

  double bore_diameter, rod_diameter, gap, slot_diameter, slot_share, pole_length, passive_length;
  double piston_area, gap_area;
  double viscosity, viscosity_exponent, temperature, yield_stress, carrier;
  double turns, wire_diameter, turn_length, window_area, resistivity, resistivity_coefficient;
  double core_length, core_area, pole_area, magnetic_gap, permeability, saturation;
  double shear_modulus, spring_wire, spring_radius, spring_coils;
  double friction, stroke;

  DamperDescription();  ///< the defaults of the table
  /// The law of the yield stress. The description must be possible.
  const FluidLaw& law() const { return *fluid->law(yield_law); }
};

/// One row of the table from which reading, writing, documentation and design take their fields.
struct DescriptionField {
  double DamperDescription::* field;
  std::string_view name, unit;
  double value, lower, upper;  ///< default and bounds
  std::string_view meaning;
};
/// All fields, in the order in which they are written.
std::span<const DescriptionField> description_fields();
/// Reads a number in the field's unit, or with a unit of its own, and checks its bounds. Throws
/// Error(file:line, ...).
double read_field(const Value& value, const DescriptionField& field);
/// Throws Error(where, "gap is 1.2 m", ...) outside the field's bounds.
void require_within(double value, const DescriptionField& field, const std::string& where);
/// Throws Error(where, "unknown field ...").
const DescriptionField& find_description_field(std::string_view name, const std::string& where);

/// From YAML: "gap: 1 mm", "turns: 150", "fluid: 140CG", "steel: mine.yaml", "flow: plate". A fluid
/// and a steel are names, files relative to that of the description (`source`), or stand there
/// whole. Throws Error that names file and line. What cannot be together (a rod wider than the
/// bore) is refused too.
DamperDescription parse_description(std::string_view text, const std::string& source);
DamperDescription load_description(const std::filesystem::path& path);
/// A description that comes with Dashpot, of data/dampers. Throws Error "unknown damper ...".
DamperDescription named_description(const std::string& name);
std::vector<std::string> description_names();
/// The description as YAML that reads back as the same, to the bit.
std::string format_description(const DamperDescription& description);

/// Throws Error where fields cannot be together; `where` begins the message.
void require_possible(const DamperDescription& description, const std::string& where);
/// Throws Error where the yield stress is a number, and so the same at any current: of no use where
/// the current is to matter.
void require_field(const DamperDescription& description, const std::string& where);
/// The damper of data/dampers of this name, or of this file.
DamperDescription find_description(const std::string& damper);

}  // namespace dashpot
