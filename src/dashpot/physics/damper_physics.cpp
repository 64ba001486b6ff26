#include "dashpot/physics/damper_physics.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "dashpot/base/text.h"
#include "dashpot/numerics/root.h"
#include "dashpot/physics/coil.h"
#include "dashpot/physics/magnetic_circuit.h"
#include "dashpot/physics/plate_flow.h"
#include "dashpot/physics/spring.h"

namespace dashpot {
namespace {

using P = DamperPhysics;
constexpr double kPi = std::numbers::pi;

constexpr std::array kQuantities{
    PhysicsQuantity{&P::spring_stiffness, "spring", "stiffness", "N/m", "G d^4 / (64 R^3 n)"},
    PhysicsQuantity{&P::spring_stiffness_as_printed, "spring", "as the family paper prints it",
                    "N/m", "G d^4 / (32 R^3 n)"},
    PhysicsQuantity{&P::spring_force, "spring", "force of the spring", "N", "K x"},
    PhysicsQuantity{&P::pole_area, "magnetic circuit", "pole area", "m^2", "A_pole"},
    PhysicsQuantity{&P::magnetic_gap, "magnetic circuit", "gap in the magnetic path", "m", "l_g"},
    PhysicsQuantity{&P::core_reluctance, "magnetic circuit", "reluctance of the core", "A/Wb",
                    "R_c = l_c / (mu_r mu0 A_t)"},
    PhysicsQuantity{&P::gap_reluctance, "magnetic circuit", "reluctance of the gap", "A/Wb",
                    "R_g = l_g / (mu A)"},
    PhysicsQuantity{&P::flux, "magnetic circuit", "flux", "Wb", "phi"},
    PhysicsQuantity{&P::core_flux_density, "magnetic circuit", "flux density in the core", "T",
                    "B_c"},
    PhysicsQuantity{&P::core_saturation, "magnetic circuit", "share of saturation", "1",
                    "B_c / B_sat"},
    PhysicsQuantity{&P::flux_density, "magnetic circuit", "flux density in the gap", "T", "B_o"},
    PhysicsQuantity{&P::resistance, "coil", "resistance", "ohm", "rho l / A"},
    PhysicsQuantity{&P::inductance, "coil", "inductance", "H", "N phi / I"},
    PhysicsQuantity{&P::time_constant, "coil", "time constant", "s", "L / R"},
    PhysicsQuantity{&P::voltage, "coil", "voltage", "V", "R I"},
    PhysicsQuantity{&P::power, "coil", "heat", "W", "R I^2"},
    PhysicsQuantity{&P::current_density, "coil", "current density in the wire", "A/m^2", "I / A"},
    PhysicsQuantity{&P::coil_fill, "coil", "share of its room that is copper", "1",
                    "N A / A_window"},
    PhysicsQuantity{&P::field, "fluid", "field", "A/m", "H(B_o)"},
    PhysicsQuantity{&P::yield_stress, "fluid", "yield stress", "Pa", "T_y(H)"},
    PhysicsQuantity{&P::viscosity, "fluid", "viscosity", "Pa*s", "eta"},
    PhysicsQuantity{&P::piston_area, "hydraulics", "piston area", "m^2", "A_p"},
    PhysicsQuantity{&P::gap_area, "hydraulics", "gap area", "m^2", "A_g"},
    PhysicsQuantity{&P::gap_width, "hydraulics", "gap width", "m", "w = A_g / h"},
    PhysicsQuantity{&P::moving_area, "hydraulics", "area of the moving flow", "m^2",
                    "A_rm = A_p + A_g / 2"},
    PhysicsQuantity{&P::flow, "hydraulics", "flow", "m^3/s", "Q = A_p |v|"},
    PhysicsQuantity{&P::newtonian_pressure, "hydraulics", "pressure without yield stress", "Pa",
                    "Bingham: 12 eta L Q / (w h^3)"},
    PhysicsQuantity{&P::yield_pressure, "hydraulics", "pressure below which nothing flows", "Pa",
                    "2 T_y L / h"},
    PhysicsQuantity{&P::passive_pressure, "hydraulics", "pressure of the gap without field", "Pa",
                    "Bingham: 12 eta L_0 Q / (w h^3)"},
    PhysicsQuantity{&P::pressure, "hydraulics", "pressure of the gap with field, fixed walls", "Pa",
                    "Bingham: P^3 - (1 + 3T) P^2 + 4 T^3 = 0"},
    PhysicsQuantity{&P::viscous_force, "force", "viscous force of the family paper, eq. 13 x L A_p",
                    "N", "12 eta L A_p A_rm v / (A_g h^2)"},
    PhysicsQuantity{&P::yield_factor, "force", "its factor c", "1", "2.07 + 1 / (1 + 0.4 T)"},
    PhysicsQuantity{&P::yield_force, "force", "its force of the field, eq. 15", "N",
                    "c T_y A_p L / h"},
    PhysicsQuantity{&P::plate_force, "force", "exact plate flow", "N", "A_p dp"},
    PhysicsQuantity{&P::moving_wall_force, "force", "exact, the wall moving against the flow", "N",
                    "A_p dp + drag"},
    PhysicsQuantity{&P::force, "force", "force, with friction and spring", "N", "F"},
    PhysicsQuantity{&P::off_force, "force", "the same without current", "N", "F(0 A)"},
    PhysicsQuantity{&P::dynamic_range, "force", "dynamic range, spring left out", "1",
                    "F / F(0 A)"}};

double slot_mean_diameter(const DamperDescription& d) {
  return d.slot_diameter > 0 ? d.slot_diameter + d.gap : d.bore_diameter - d.gap;
}

/// Areas that follow from the drawing, where the description does not give them.
void add_shape(const DamperDescription& d, DamperPhysics& p) {
  const double circumference = d.slot_share * kPi * slot_mean_diameter(d);
  p.gap_area = d.gap_area > 0 ? d.gap_area : circumference * d.gap;
  p.gap_width = p.gap_area / d.gap;
  const double inside =
      0.25 * kPi * (d.bore_diameter * d.bore_diameter - d.rod_diameter * d.rod_diameter);
  p.piston_area = d.piston_area > 0 ? d.piston_area : inside - p.gap_area;
  p.moving_area = p.piston_area + 0.5 * p.gap_area;
  p.pole_area = d.pole_area > 0 ? d.pole_area : 0.5 * d.pole_length * circumference;
  p.magnetic_gap = d.magnetic_gap > 0 ? d.magnetic_gap : 2 * d.gap;
}

/// The circuit of the family paper: air in the gap, relative permeability 1.
MagneticCircuit circuit_of(const DamperDescription& d, const DamperPhysics& shape) {
  return {d.turns, d.core_length, shape.magnetic_gap, d.core_area, d.permeability, d.saturation, 1};
}

bool has_curve(const DamperDescription& d) { return d.steel && !d.steel->points.empty(); }

/// A/m in the core at a flux density: by the steel's curve, else by permeability and saturation.
double steel_field(const DamperDescription& d, double core) {
  if (has_curve(d)) return d.steel->field(core);
  return core * d.saturation / (d.saturation - core) / (d.permeability * DASHPOT_MU0);
}

/// Ampere-turns that drive this flux density (T, in the core) through steel and fluid. Without a
/// curve the steel's field follows from its saturation: B = B_sat b / (b + B_sat) with b = mu H.
double ampere_turns(const DamperDescription& d, const DamperPhysics& shape, double core) {
  return steel_field(d, core) * d.core_length +
         d.law().field(core * d.core_area / shape.pole_area) * shape.magnetic_gap;
}

/// The core's flux density, T, that a current drives: between none and what the steel alone would
/// carry.
double filled_core_flux_density(const DamperDescription& d, const DamperPhysics& shape,
                                double current) {
  const double wanted = d.turns * current,
               steel = d.permeability * DASHPOT_MU0 * wanted / d.core_length;
  const double most = has_curve(d) ? d.steel->flux_density(wanted / d.core_length)
                                   : d.saturation * steel / (steel + d.saturation);
  const auto off = [&](double core) { return ampere_turns(d, shape, core) - wanted; };
  return find_root(off, {0, -wanted}, {most, off(most)}, 1e-14 * wanted);
}

/// Flux, field and yield stress at a current of either sign.
FluidState fluid_state(const DamperDescription& d, const DamperPhysics& shape, double current) {
  FluidState state;
  const double magnitude = std::abs(current);
  if (d.circuit_law == CircuitLaw::Paper) {
    const MagneticCircuit circuit = circuit_of(d, shape);
    state.core_flux_density = magnetic_flux(&circuit, magnitude) / d.core_area;
    state.flux_density = circuit_flux_density(&circuit, magnitude);
  } else {
    state.core_flux_density = magnitude > 0 ? filled_core_flux_density(d, shape, magnitude) : 0;
    state.flux_density = state.core_flux_density * d.core_area / shape.pole_area;
  }
  state.field = d.law().field(state.flux_density);
  state.yield_stress =
      d.yield_stress > 0 ? d.yield_stress : d.law().yield_stress(state.field, d.carrier);
  return state;
}

/// Reluctances and the coil. Both are ratios to the flux, so without current they are those of a
/// small one.
void add_circuit(const DamperDescription& d, double current, const FluidState& at_current,
                 DamperPhysics& p) {
  constexpr double kSmall = 1e-6;
  const double seen = std::max(std::abs(current), kSmall);

  const FluidState state = seen > kSmall ? at_current : fluid_state(d, p, kSmall);
  const MagneticCircuit circuit = circuit_of(d, p);

  const double turns_current = d.turns * seen, flux = state.core_flux_density * d.core_area;

  p.core_reluctance = has_curve(d) ? d.steel->field(state.core_flux_density) * d.core_length / flux
                                   : core_reluctance(&circuit);
  p.gap_reluctance = d.circuit_law == CircuitLaw::Paper ? gap_reluctance(&circuit)
                                                        : state.field * p.magnetic_gap / flux;

  // Resistance, inductance and what the current heats.
  const Coil coil{d.turns, d.wire_diameter, d.turn_length, d.resistivity,
                  d.resistivity_coefficient};
  p.resistance = coil_resistance(&coil, d.temperature);
  p.inductance = coil_inductance(&coil, turns_current / flux);
  p.time_constant = coil_time_constant(p.inductance, p.resistance);
  p.voltage = p.resistance * std::abs(current);
  p.power = p.voltage * std::abs(current);
  p.current_density = std::abs(current) / coil_wire_area(&coil);
  p.coil_fill = d.window_area > 0 ? d.turns * coil_wire_area(&coil) / d.window_area : 0;
}

/// The state of steel and fluid; the viscosity follows the temperature as far as the description
/// says how.
void add_fluid(const DamperDescription& d, const FluidState& state, DamperPhysics& p) {
  p.core_flux_density = state.core_flux_density;
  p.flux = state.core_flux_density * d.core_area;
  p.core_saturation =
      state.core_flux_density / (has_curve(d) ? d.steel->saturated() : d.saturation);
  p.flux_density = state.flux_density;
  p.field = state.field;
  p.yield_stress = state.yield_stress;
  const double at_40 = d.viscosity > 0 ? d.viscosity : d.fluid->viscosity(d.temperature);
  p.viscosity = at_40 * std::exp(-d.viscosity_exponent * (d.temperature - 313.15));
}

/// Pressures between walls that stand: a Bingham fluid's, or a Herschel-Bulkley fluid's, whose
/// power law goes through the viscosity at a shear rate.
void add_pressures(const DamperDescription& d, const PlateGap& active, const PlateGap& passive,
                   DamperPhysics& p) {
  p.newtonian_pressure = plate_newtonian_pressure(&active, p.viscosity, p.flow);
  p.passive_pressure = plate_newtonian_pressure(&passive, p.viscosity, p.flow);
  if (p.flow == 0) return;
  p.pressure = plate_bingham_pressure(p.newtonian_pressure, p.yield_pressure);
  if (const double n = d.fluid->index; n != 1) {
    const double consistency = p.viscosity * std::pow(d.fluid->shear_rate, 1 - n);
    p.newtonian_pressure = plate_power_law_pressure(&active, consistency, n, p.flow);
    p.passive_pressure = plate_power_law_pressure(&passive, consistency, n, p.flow);
    p.pressure = plate_herschel_bulkley_pressure(p.newtonian_pressure, p.yield_pressure, n);
  }
}

/// Pressures and forces of all three flow laws at a speed, whichever the description chooses.
void add_flow(const DamperDescription& d, double velocity, DamperPhysics& p) {
  const double speed = std::abs(velocity);
  const PlateGap active{d.pole_length, p.gap_width, d.gap},
      passive{d.passive_length, p.gap_width, d.gap};
  p.flow = p.piston_area * speed;
  p.yield_pressure = plate_yield_pressure(&active, p.yield_stress);
  add_pressures(d, active, passive, p);
  if (speed == 0) return;
  p.plate_force = p.piston_area * (p.pressure + p.passive_pressure);

  // The wall moves against the flow, in the part with field and in the part without. Of any fluid
  // this is the flow of Bingham's with its viscosity.
  const double newtonian = plate_newtonian_pressure(&active, p.viscosity, p.flow),
               passive_newtonian = plate_newtonian_pressure(&passive, p.viscosity, p.flow);
  const double wall = p.gap_area * speed / p.flow;  // w h v / Q
  const double moving = plate_moving_wall_pressure(newtonian, p.yield_pressure, wall);
  const double drag = plate_wall_drag(moving, newtonian, p.yield_pressure, wall);
  const double passive_moving = (1 + 0.5 * wall) * passive_newtonian;
  p.moving_wall_force =
      p.piston_area * (moving + drag + passive_moving +
                       plate_wall_drag(passive_moving, passive_newtonian, 0, wall));

  // Equations 13 to 15 of the family paper.
  const double length = d.pole_length + d.passive_length;
  p.viscous_force = 12 * p.viscosity * length * p.piston_area * p.moving_area * speed /
                    (p.gap_area * d.gap * d.gap);
  const double ratio = p.yield_pressure / (2 * newtonian);  // T
  p.yield_factor = 2.07 + 1 / (1 + 0.4 * ratio);
  p.yield_force = p.yield_factor * p.yield_stress * p.piston_area * d.pole_length / d.gap;
}

double flow_force(const DamperDescription& d, const DamperPhysics& p) {
  if (d.flow_law == FlowLaw::Paper) return p.viscous_force + p.yield_force;
  return d.flow_law == FlowLaw::Plate ? p.plate_force : p.moving_wall_force;
}

}  // namespace

std::span<const PhysicsQuantity> physics_quantities() { return kQuantities; }

FluidState fluid_state(const DamperDescription& description, double current) {
  DamperPhysics shape;
  add_shape(description, shape);
  return fluid_state(description, shape, current);
}

DamperPhysics evaluate_physics(const DamperDescription& d, const DamperOperation& operation) {
  // Shape and spring do not depend on the current.
  DamperPhysics off;
  add_shape(d, off);
  if (d.spring_wire > 0) {
    const HelicalSpring spring{d.shear_modulus, d.spring_wire, d.spring_radius, d.spring_coils};
    off.spring_stiffness = spring_stiffness(&spring);
    off.spring_stiffness_as_printed = spring_stiffness_as_printed(&spring);
    off.spring_force = off.spring_stiffness * operation.displacement;
  }

  // The same chain with the current and without: circuit, fluid, flow.
  DamperPhysics p = off;
  const FluidState state = fluid_state(d, p, operation.current);
  add_circuit(d, operation.current, state, p);
  add_fluid(d, state, p);
  add_flow(d, operation.velocity, p);
  add_fluid(d, fluid_state(d, off, 0), off);
  add_flow(d, operation.velocity, off);

  // Forces against the motion, with friction and spring.
  const double side = plate_side(operation.velocity);
  const double damping = flow_force(d, p) + d.friction,
               off_damping = flow_force(d, off) + d.friction;
  p.force = side * damping + p.spring_force;
  p.off_force = side * off_damping + p.spring_force;
  p.dynamic_range =
      off_damping > 0 ? damping / off_damping : std::numeric_limits<double>::infinity();
  return p;
}

std::vector<KnownWithin> force_uncertainty(const DamperDescription& d,
                                           const DamperOperation& operation) {
  const double force = evaluate_physics(d, operation).force;
  std::vector<KnownWithin> parts;
  const auto add = [&](std::string what, double share, const DamperDescription& other) {
    parts.push_back(
        {std::move(what), share, std::abs(evaluate_physics(other, operation).force - force)});
  };

  // Each is moved by its standard deviation, the others as they are.
  if (const double share = d.fluid->yield_uncertainty; share > 0) {
    Fluid fluid = *d.fluid;
    for (FluidLaw& law : fluid.laws) law.scale *= 1 + share;
    DamperDescription other = d;
    other.fluid = std::make_shared<const Fluid>(std::move(fluid));
    add("yield stress of " + d.fluid->name, share, other);
  }
  if (const double share = d.fluid->viscosity_uncertainty; share > 0 && !(d.viscosity > 0)) {
    Fluid fluid = *d.fluid;
    for (auto& [temperature, viscosity] : fluid.viscosities) viscosity *= 1 + share;
    DamperDescription other = d;
    other.fluid = std::make_shared<const Fluid>(std::move(fluid));
    add("viscosity of " + d.fluid->name, share, other);
  }
  if (d.steel && d.steel->uncertainty > 0) {
    const double share = d.steel->uncertainty;
    Steel steel = *d.steel;
    steel.scale *= 1 + share;
    DamperDescription other = d;
    other.saturation *= 1 + share;
    other.permeability *= 1 + share;
    other.steel = std::make_shared<const Steel>(std::move(steel));
    add("flux density of " + d.steel->name, share, other);
  }
  return parts;
}

std::vector<std::string> fluid_warnings(const DamperDescription& d, double field) {
  const FluidLaw& law = d.law();
  std::vector<std::string> warnings = law.faults;
  const auto kilo = [](double value, const std::string& unit) {
    return format_number(value / 1000) + " k" + unit;
  };
  const double end = law.has_yield_polynomial      ? law.polynomial.held_field
                     : !law.yield_stresses.empty() ? law.yield_stresses.back().first
                                                   : std::numeric_limits<double>::infinity();
  if (field > end)
    warnings.push_back("the yield stress of " + d.fluid->name + " is held at " +
                       kilo(law.yield_stress(end, d.carrier), "Pa") + " above " + kilo(end, "A/m") +
                       ", where its " +
                       (law.has_yield_polynomial ? "polynomial is used no further" : "points end"));
  if (!law.verified)
    warnings.push_back("the volume fraction of " + d.fluid->name +
                       " is recalled, not from its data sheet");
  return warnings;
}

std::vector<std::string> physics_warnings(const DamperDescription& d, const DamperPhysics& p) {
  std::vector<std::string> warnings = fluid_warnings(d, p.field);
  if (d.fluid->index != 1)
    warnings.push_back(d.fluid->name +
                       " is a Herschel-Bulkley fluid: the moving wall and the paper's equations "
                       "take it as Bingham's, of the viscosity at its shear rate");

  // The coil and its circuit. The paper's circuit takes turns that stand for its saturation as
  // well.
  if (d.turns != std::round(d.turns) && d.circuit_law != CircuitLaw::Paper)
    warnings.push_back("turns is " + format_number(d.turns, 6) +
                       ", which no coil has: it is taken as it stands");
  if (p.coil_fill > 0.6)
    warnings.push_back("the coil fills " + format_number(100 * p.coil_fill, 3) +
                       " % of its room with copper; windings reach about 60 %");
  if (p.core_saturation > 0.8)
    warnings.push_back("the core is at " + format_number(100 * p.core_saturation, 3) +
                       " % of its saturation");
  if (p.current_density > 10e6)
    warnings.push_back("the wire carries " + format_number(p.current_density / 1e6, 3) +
                       " A/mm^2; more than 10 overheats it when it lasts");

  // What the figures of the flow leave out, and how far plates stand for an annulus.
  if (const double still = d.law().yield_stress(0, d.carrier);
      still > 0 && d.passive_length > 0 && !(d.yield_stress > 0)) {
    // In slow flow it adds this pressure, in fast flow 1 + n / (n + 1) times as much.
    const PlateGap passive{d.passive_length, p.gap_width, d.gap};
    const double slow = p.piston_area * plate_yield_pressure(&passive, still),
                 fast = slow * (1 + d.fluid->index / (d.fluid->index + 1));
    warnings.push_back("the gap without field is taken for one without yield stress: the " +
                       format_number(still) + " Pa that " + d.fluid->name +
                       " has there would add " + format_number(slow, 3) + " to " +
                       format_number(fast, 3) + " N, with current and without");
  }
  const double diameter = slot_mean_diameter(d);
  if (d.gap > 0.05 * diameter)
    warnings.push_back(
        "the gap is " + format_number(100 * d.gap / diameter, 3) +
        " % of its diameter: plates stand for an annulus to the order of its square only");

  // Between plates, by the hydraulic diameter of 2 h and the mean velocity Q / (w h).
  constexpr double kMostLaminar = 2000;
  const double density = 0.5 * (d.fluid->density_min + d.fluid->density_max);
  const double reynolds = 2 * density * std::abs(p.flow) / (p.gap_width * p.viscosity);
  if (reynolds > kMostLaminar)
    warnings.push_back("the Reynolds number in the gap is " + format_number(reynolds, 3) +
                       ": above about 2000 a flow is no longer laminar, as all figures here take "
                       "it");
  if (d.viscosity_exponent == 0 && d.fluid->viscosities.size() == 1 &&
      std::abs(d.temperature - 313.15) > 1)
    warnings.push_back(
        "the viscosity is that at 40 degC: state viscosity_exponent to have it follow the "
        "temperature");
  return warnings;
}

}  // namespace dashpot
