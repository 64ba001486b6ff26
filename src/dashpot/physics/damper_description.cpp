#include "dashpot/physics/damper_description.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "dashpot/base/data_folder.h"
#include "dashpot/base/escape.h"
#include "dashpot/base/file.h"
#include "dashpot/base/file_kind.h"
#include "dashpot/base/find_row.h"
#include "dashpot/base/read_quantity.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/value.h"

namespace dashpot {
namespace {

using D = DamperDescription;

constexpr std::array kFields{
    DescriptionField{&D::bore_diameter, "bore_diameter", "m", 0.046, 1e-3, 1, "of the cylinder"},
    DescriptionField{&D::rod_diameter, "rod_diameter", "m", 0.012, 0, 1, "of the piston rod"},
    DescriptionField{&D::gap, "gap", "m", 1e-3, 5e-5, 0.01,
                     "height of the gap that the fluid flows through"},
    DescriptionField{
        &D::slot_diameter, "slot_diameter", "m", 0, 0, 1,
        "inner diameter of an annular slot in the piston; 0: the gap lies around the piston"},
    DescriptionField{&D::slot_share, "slot_share", "1", 1, 0.01, 1,
                     "of the circumference that is open"},
    DescriptionField{&D::pole_length, "pole_length", "m", 0.02, 1e-4, 1,
                     "length of gap in which the field acts"},
    DescriptionField{&D::passive_length, "passive_length", "m", 0.015, 0, 1,
                     "length of gap without field"},
    DescriptionField{&D::piston_area, "piston_area", "m^2", 0, 0, 1,
                     "that displaces fluid; 0: bore less rod less gap"},
    DescriptionField{&D::gap_area, "gap_area", "m^2", 0, 0, 1,
                     "cross-section of the gap; 0: from the diameters"},
    DescriptionField{&D::viscosity, "viscosity", "Pa*s", 0, 0, 100,
                     "at 40 degC; 0: from the fluid's data sheet"},
    DescriptionField{&D::viscosity_exponent, "viscosity_exponent", "1/K", 0, 0, 0.2,
                     "share of the viscosity that each kelvin above 40 degC takes; 0: none (data "
                     "sheets of MR fluids give one temperature)"},
    DescriptionField{&D::temperature, "temperature", "K", 313.15, 200, 500, "of fluid and coil"},
    DescriptionField{&D::yield_stress, "yield_stress", "Pa", 0, 0, 1e6,
                     "in place of magnetic circuit and fluid; 0: from these"},
    DescriptionField{&D::carrier, "carrier", "1", 1, 0.5, 2,
                     "factor of Carlson's law: 1 hydrocarbon, 1.16 water, 0.95 silicone oil"},
    DescriptionField{&D::turns, "turns", "1", 150, 1, 1e5, "of the coil"},
    DescriptionField{&D::wire_diameter, "wire_diameter", "m", 5e-4, 2e-5, 0.01,
                     "of the coil's copper"},
    DescriptionField{&D::turn_length, "turn_length", "m", 0.09, 1e-3, 10, "mean length of a turn"},
    DescriptionField{&D::window_area, "window_area", "m^2", 6e-5, 0, 1,
                     "room for the coil in section; 0: not checked"},
    DescriptionField{&D::resistivity, "resistivity", "ohm*m", 1.72e-8, 1e-9, 1e-4,
                     "of the wire at 20 degC"},
    DescriptionField{&D::resistivity_coefficient, "resistivity_coefficient", "1/K", 3.93e-3, 0, 0.1,
                     "of the wire"},
    DescriptionField{&D::core_length, "core_length", "m", 0.06, 1e-4, 10,
                     "of the magnetic path in steel"},
    DescriptionField{&D::core_area, "core_area", "m^2", 3.5e-4, 1e-8, 1,
                     "of steel that the flux passes, at its narrowest"},
    DescriptionField{&D::pole_area, "pole_area", "m^2", 0, 0, 1,
                     "of one pole towards the gap; 0: half of the pole length around the gap"},
    DescriptionField{&D::magnetic_gap, "magnetic_gap", "m", 0, 0, 1,
                     "of the magnetic path across the gap; 0: twice the gap"},
    DescriptionField{&D::permeability, "permeability", "1", 2000, 1, 1e6, "relative, of the steel"},
    DescriptionField{&D::saturation, "saturation", "T", 1.5, 0.1, 3,
                     "flux density that the steel tends to"},
    DescriptionField{&D::shear_modulus, "shear_modulus", "Pa", 79e9, 1e6, 1e12,
                     "of the spring's wire"},
    DescriptionField{&D::spring_wire, "spring_wire", "m", 0, 0, 0.1,
                     "diameter of the spring's wire; 0: no spring"},
    DescriptionField{&D::spring_radius, "spring_radius", "m", 0.02, 1e-4, 1,
                     "of the spring's helix"},
    DescriptionField{&D::spring_coils, "spring_coils", "1", 8, 0.5, 1000, "active ones"},
    DescriptionField{&D::friction, "friction", "N", 0, 0, 1e5, "of seals and guides"},
    DescriptionField{&D::stroke, "stroke", "m", 0.05, 1e-4, 10, "from end to end"}};

template <class Law>
struct LawWord {
  std::string_view word;
  Law law;
};
constexpr std::array kCircuitLaws{LawWord{"filled", CircuitLaw::Filled},
                                  LawWord{"paper", CircuitLaw::Paper}};
constexpr std::array kFlowLaws{LawWord{"plate", FlowLaw::Plate},
                               LawWord{"moving_wall", FlowLaw::MovingWall},
                               LawWord{"paper", FlowLaw::Paper}};

template <class Words, class Law>
void read_law(ObjectReader& reader, std::string_view key, const Words& words, Law& law) {
  const Value* value = reader.optional(key);
  if (!value) return;
  std::vector<std::string> known;
  for (const auto& [word, meant] : words) {
    if (value->as_string() == word) {
      law = meant;
      return;
    }
    known.emplace_back(word);
  }
  throw Error(value->where(), "unknown word '" + value->as_string() + "' for " + std::string(key),
              suggest(value->as_string(), known));
}

template <class Words, class Law>
std::string_view word_of(const Words& words, Law law) {
  for (const auto& [word, meant] : words)
    if (meant == law) return word;
  return {};
}

/// A name, which YAML takes for a number where it is nothing but one.
const std::string& read_name(const Value& value, const std::string& what) {
  if (value.kind() == Value::Kind::Number) {
    const std::string number = format_number(value.as_number());
    throw Error(value.where(), what + " is the number " + number + ", not a name",
                "quotes around it: " + what + ": \"" + number + "\"");
  }
  return value.as_string();
}

}  // namespace

DamperDescription::DamperDescription() : fluid(find_fluid("132DG")) {
  for (const DescriptionField& field : kFields) this->*field.field = field.value;
}

std::span<const DescriptionField> description_fields() { return kFields; }

void require_within(double value, const DescriptionField& field, const std::string& where) {
  if (value >= field.lower && value <= field.upper) return;
  const std::string unit = field.unit == "1" ? "" : " " + std::string(field.unit);
  throw Error(where, std::string(field.name) + " is " + format_number(value) + unit,
              format_number(field.lower) + " ... " + format_number(field.upper) + unit);
}

double read_field(const Value& value, const DescriptionField& field) {
  const double number = read_quantity(value, field.unit);
  require_within(number, field, value.where());
  return number;
}

const DescriptionField& find_description_field(std::string_view name, const std::string& where) {
  return find_row(kFields, name, "field", where);
}

void require_possible(const DamperDescription& d, const std::string& where) {
  for (const DescriptionField& field : kFields) require_within(d.*field.field, field, where);

  // No single field's bounds can say this: the parts must fit into each other.
  const auto millimetres = [](double m) { return format_number(1000 * m) + " mm"; };
  if (d.rod_diameter >= d.bore_diameter)
    throw Error(where, "rod_diameter is " + millimetres(d.rod_diameter),
                "less than the bore, " + millimetres(d.bore_diameter));
  const double outer =
      d.slot_diameter > 0 ? d.slot_diameter + 2 * d.gap : d.rod_diameter + 2 * d.gap;
  if (outer >= d.bore_diameter && !(d.piston_area > 0 && d.gap_area > 0))
    throw Error(
        where,
        "no piston is left between slot or rod, gap and a bore of " + millimetres(d.bore_diameter),
        "a wider bore or a smaller gap");

  const double bore_area = std::numbers::pi / 4 * d.bore_diameter * d.bore_diameter;
  if (d.gap_area >= bore_area)
    throw Error(where, "gap_area is " + format_number(1e6 * d.gap_area, 4) + " mm^2",
                "less than the bore has, " + format_number(1e6 * bore_area, 4) + " mm^2");

  const double across = 2 * d.gap;
  if (across >= d.bore_diameter)
    throw Error(where,
                "the gap of " + millimetres(d.gap) +
                    " on either side leaves nothing of a bore of " + millimetres(d.bore_diameter),
                "a smaller gap or a wider bore");

  if (d.spring_wire >= 2 * d.spring_radius)
    throw Error(
        where, "spring_wire is " + millimetres(d.spring_wire),
        "less than the diameter of the spring's helix, " + millimetres(2 * d.spring_radius));

  // The fluid has the law that is asked for, and the equations know a fluid of its kind.
  if (!d.fluid->law(d.yield_law)) {
    std::vector<std::string> known;
    for (const FluidLaw& law : d.fluid->laws) known.push_back(law.name);
    throw Error(where, d.fluid->name + " has no yield stress '" + d.yield_law + "'",
                "yield: " + join(known, " or ") + ", or a fluid that has it");
  }
  if (d.fluid->index != 1 && d.flow_law != FlowLaw::Plate)
    throw Error(where,
                d.fluid->name + " is a Herschel-Bulkley fluid, which this flow does not take",
                "flow: plate");
  if (d.fluid->viscosities.size() > 1 && d.viscosity_exponent > 0)
    throw Error(
        where,
        "viscosity_exponent stands beside the viscosities over temperature of " + d.fluid->name,
        "one of the two");
  if (d.steel && !d.steel->points.empty() && d.circuit_law == CircuitLaw::Paper)
    throw Error(where, "the paper's circuit has no B-H curve, but permeability and saturation",
                "circuit: filled");
}

void require_field(const DamperDescription& d, const std::string& where) {
  if (!(d.yield_stress > 0)) return;
  throw Error(where,
              "yield_stress is " + format_number(d.yield_stress) +
                  " Pa at any current, without one too: a damper that no current changes",
              "a fluid whose file states its yield stress over the field (--fluid mine.yaml)");
}

DamperDescription parse_description(std::string_view text, const std::string& source) {
  const Value document = parse_yaml(text, source);
  refuse_other_kind(document, "a damper description");
  ObjectReader reader(document, "a damper description");
  DamperDescription description;
  description.name = reader.string("name", "");

  // Fluid and steel: by name, by a file beside this one, or whole.
  const std::filesystem::path folder = std::filesystem::path(source).parent_path();
  if (const Value* fluid = reader.optional("fluid"))
    description.fluid = fluid->kind() == Value::Kind::Object
                            ? std::make_shared<const Fluid>(read_fluid(*fluid))
                            : find_fluid(read_name(*fluid, "fluid"), fluid->where(), folder);
  const Value* steel = reader.optional("steel");
  if (steel) {
    description.steel = steel->kind() == Value::Kind::Object
                            ? std::make_shared<const Steel>(read_steel(*steel))
                            : find_steel(read_name(*steel, "steel"), steel->where(), folder);
    for (const std::string_view twice : {"permeability", "saturation"})
      if (const Value* stated = reader.optional(twice))
        throw Error(stated->where(), std::string(twice) + " stands beside steel", "one of the two");
  }
  reader.string("note", "");

  if (const Value* yield = reader.optional("yield")) description.yield_law = yield->as_string();
  read_law(reader, "circuit", kCircuitLaws, description.circuit_law);
  read_law(reader, "flow", kFlowLaws, description.flow_law);

  // Fields that are not given keep the table's defaults.
  for (const DescriptionField& field : kFields)
    if (const Value* value = reader.optional(field.name))
      description.*field.field = read_field(*value, field);

  if (description.steel && description.steel->points.empty()) {
    description.permeability = description.steel->permeability;
    description.saturation = description.steel->saturation;
  }
  reader.finish();
  require_possible(description, source);
  return description;
}

DamperDescription load_description(const std::filesystem::path& path) {
  return parse_description(read_file(path), path.string());
}

DamperDescription named_description(const std::string& name) {
  const std::vector<std::string> known = description_names();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw Error("", "unknown damper '" + name + "'", suggest(name, known));
  return load_description(data_folder("dampers") / (name + ".yaml"));
}

DamperDescription find_description(const std::string& damper) {
  const std::vector<std::string> known = description_names();
  const bool is_known = std::find(known.begin(), known.end(), damper) != known.end();

  // A word without dot or slash that is no file is meant as a name.
  std::error_code none;
  const bool is_file =
      damper.find_first_of("./") != std::string::npos || std::filesystem::exists(damper, none);
  return is_known || !is_file ? named_description(damper) : load_description(damper);
}

std::vector<std::string> description_names() { return data_names("dampers", ".yaml"); }

std::string format_description(const DamperDescription& d) {
  // A fluid and a steel of the user's own stand there whole, since their files may lie elsewhere.
  const auto own = [](const auto& thing, const std::vector<std::string>& names, const auto& find) {
    return std::find(names.begin(), names.end(), thing->name) == names.end() ||
           find(thing->name, "", "") != thing;
  };
  const bool own_fluid = own(d.fluid, fluid_names(), find_fluid);
  const std::string fluid = own_fluid ? format_json(to_json(*d.fluid), false) : d.fluid->name;
  std::string text = "name: " + yaml_string(d.name) + "\nfluid: " + fluid +
                     "\nyield: " + d.law().name +
                     "\ncircuit: " + std::string(word_of(kCircuitLaws, d.circuit_law)) +
                     "\nflow: " + std::string(word_of(kFlowLaws, d.flow_law)) + '\n';
  if (d.steel)
    text += "steel: " +
            (own(d.steel, steel_names(), find_steel) ? format_json(to_json(*d.steel), false)
                                                     : yaml_string(d.steel->name)) +
            '\n';
  for (const DescriptionField& field : kFields)
    if (!d.steel || (field.name != "permeability" && field.name != "saturation"))
      text += std::string(field.name) + ": " + format_exact(d.*field.field) +
              (field.unit == "1" ? "" : " " + std::string(field.unit)) + '\n';
  return text;
}

}  // namespace dashpot
