#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/physics/damper_description.h"

namespace dashpot {

/// Everything between a coil current and a force, at one speed, in SI; physics_quantities() gives
/// each number's unit, name and equation. Quantities that need a flow are 0 at rest.
struct DamperPhysics {
  double piston_area = 0, gap_area = 0, gap_width = 0, moving_area = 0;  // hydraulics: shape
  double pole_area = 0, magnetic_gap = 0, core_reluctance = 0, gap_reluctance = 0, flux = 0;
  double core_flux_density = 0, core_saturation = 0, flux_density = 0, field = 0;
  double yield_stress = 0, viscosity = 0;
  double resistance = 0, inductance = 0, time_constant = 0, voltage = 0, power = 0,
         current_density = 0;
  double coil_fill = 0;
  double flow = 0, newtonian_pressure = 0, yield_pressure = 0, passive_pressure = 0, pressure = 0;
  double viscous_force = 0, yield_factor = 0, yield_force = 0, plate_force = 0,
         moving_wall_force = 0;
  double spring_stiffness = 0, spring_stiffness_as_printed = 0, spring_force = 0;
  double force = 0, off_force = 0, dynamic_range = 0;
};

/// One row of the table that names them; reports and documentation are made from it.
struct PhysicsQuantity {
  double DamperPhysics::* value;
  std::string_view group;  ///< "hydraulics", "magnetic circuit" ...
  std::string_view name, unit, equation;
};
std::span<const PhysicsQuantity> physics_quantities();

/// The point at which a damper is looked at.
struct DamperOperation {
  double current = 0;       ///< A
  double velocity = 0;      ///< m/s, extension positive
  double displacement = 0;  ///< m, from where the spring is free
  bool operator==(const DamperOperation&) const = default;
};

/// Evaluates the chain coil, magnetic circuit, fluid, flow, force. The description must be possible
/// (require_possible). The same equations as the laws plate_bingham and field_chain, from the same
/// C text. Signs as a damper's: force positive when it resists extension.
DamperPhysics evaluate_physics(const DamperDescription& description,
                               const DamperOperation& operation);

/// Flux density in core and gap, field in the fluid, and the yield stress that comes of them.
struct FluidState {
  double core_flux_density = 0, flux_density = 0;  ///< T
  double field = 0;                                ///< A/m
  double yield_stress = 0;                         ///< Pa
};
FluidState fluid_state(const DamperDescription& description, double current);

/// What is known of a damper within a standard deviation only, as the files of its fluid and steel
/// state it, and what that deviation does to the force.
struct KnownWithin {
  std::string what;
  double share = 0, force = 0;  ///< N
};
std::vector<KnownWithin> force_uncertainty(const DamperDescription& description,
                                           const DamperOperation& operation);

/// What the fluid's file says of its law, and whether it ends below this field, A/m; a sentence
/// each.
std::vector<std::string> fluid_warnings(const DamperDescription& description, double field);

/// Warnings that a user should read with the numbers, one sentence each: those of the fluid,
/// a coil that does not fit, saturation. Empty when there are none.
std::vector<std::string> physics_warnings(const DamperDescription& description,
                                          const DamperPhysics& physics);

}  // namespace dashpot
