#include "dashpot/design/quantities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

using P = DamperPhysics;
using Q = DesignQuantity;
constexpr double kPi = std::numbers::pi;
constexpr double kSteelDensity = 7850, kCopperDensity = 8960;  // kg/m^3

double disc(double diameter) { return 0.25 * kPi * diameter * diameter; }

double controllable_force(const OperatedDamper& d) {
  return std::abs(d.physics.force) - std::abs(d.physics.off_force);
}

double control_ratio(const OperatedDamper& d) {
  const P& p = d.physics;
  return p.piston_area * p.yield_pressure /
         (p.piston_area * (p.newtonian_pressure + p.passive_pressure) + d.description.friction);
}

double controllable_power(const OperatedDamper& d) {
  return d.physics.yield_pressure * d.physics.flow;
}

double active_volume(const OperatedDamper& d) {
  return d.physics.gap_area * d.description.pole_length;
}

double piston_length(const OperatedDamper& d) {
  return d.description.pole_length + d.description.passive_length;
}

double body_length(const OperatedDamper& d) { return d.description.stroke + piston_length(d); }

/// The tube returns the core's flux at the core's flux density: its section is that of the core.
double outer_diameter(const OperatedDamper& d) {
  return std::sqrt(d.description.bore_diameter * d.description.bore_diameter +
                   4 / kPi * d.description.core_area);
}

double copper_mass(const OperatedDamper& d) {
  return kCopperDensity * d.description.turns * d.description.turn_length *
         disc(d.description.wire_diameter);
}

double mass(const OperatedDamper& d) {
  const DamperDescription& drawn = d.description;
  const double bore = disc(drawn.bore_diameter), rod = disc(drawn.rod_diameter);
  const double coil = drawn.turns * drawn.turn_length * disc(drawn.wire_diameter);
  const double room = std::max(coil, drawn.window_area * drawn.turn_length);
  const double piston = std::max(0., (bore - d.physics.gap_area) * piston_length(d) - room);
  const double steel = drawn.core_area * body_length(d) + piston + rod * body_length(d);
  const double fluid = (bore - rod) * drawn.stroke + d.physics.gap_area * piston_length(d);
  return kSteelDensity * steel + copper_mass(d) +
         0.5 * (drawn.fluid->density_min + drawn.fluid->density_max) * fluid;
}

double outside_family(const OperatedDamper& d) { return d.model.outside(d.description); }

constexpr std::array kEstimates{
    Q{"controllable_force", "N", "force less that without current", {}, {}, controllable_force},
    Q{"control_ratio",
      "1",
      "force below which nothing flows over viscous force and friction without current",
      {},
      {},
      control_ratio},
    Q{"controllable_power",
      "W",
      "pressure below which nothing flows times flow",
      {},
      {},
      controllable_power},
    Q{"response_time",
      "s",
      "from a voltage step to 90 % of the force's change; without eddy currents",
      {},
      {},
      response_time},
    Q{"active_volume", "m^3", "fluid in the gap where the field acts", {}, {}, active_volume, true},
    Q{"piston_length", "m", "gap with field and without", {}, {}, piston_length, true},
    Q{"body_length",
      "m",
      "stroke and piston; neither accumulator nor mounts",
      {},
      {},
      body_length,
      true},
    Q{"outer_diameter",
      "m",
      "of a steel tube whose section is the core's",
      {},
      {},
      outer_diameter,
      true},
    Q{"copper_mass", "kg", "of the coil", {}, {}, copper_mass, true},
    Q{"mass",
      "kg",
      "estimate: steel tube, piston and rod, copper, fluid; no mounts",
      {},
      {},
      mass,
      true},
    Q{kOutsideFamily,
      "1",
      "how far beyond the dampers of a family's model, in shares of their ranges; 0 or less within",
      {},
      {},
      outside_family,
      true},
    Q{kRideComfort,
      "m/s^2",
      "of the request's ride: the body's weighted acceleration, rms (ISO 2631-1, Wk)",
      {},
      {},
      comfort,
      true}};

struct PhysicsWord {
  std::string_view name;
  double P::* value;
};
constexpr std::array kPhysicsWords{PhysicsWord{"force", &P::force},
                                   PhysicsWord{"off_force", &P::off_force},
                                   PhysicsWord{"dynamic_range", &P::dynamic_range},
                                   PhysicsWord{"plate_force", &P::plate_force},
                                   PhysicsWord{"moving_wall_force", &P::moving_wall_force},
                                   PhysicsWord{"viscous_force", &P::viscous_force},
                                   PhysicsWord{"yield_force", &P::yield_force},
                                   PhysicsWord{"yield_factor", &P::yield_factor},
                                   PhysicsWord{"flow", &P::flow},
                                   PhysicsWord{"pressure", &P::pressure},
                                   PhysicsWord{"newtonian_pressure", &P::newtonian_pressure},
                                   PhysicsWord{"yield_pressure", &P::yield_pressure},
                                   PhysicsWord{"passive_pressure", &P::passive_pressure},
                                   PhysicsWord{"piston_area", &P::piston_area},
                                   PhysicsWord{"gap_area", &P::gap_area},
                                   PhysicsWord{"gap_width", &P::gap_width},
                                   PhysicsWord{"moving_area", &P::moving_area},
                                   PhysicsWord{"time_constant", &P::time_constant},
                                   PhysicsWord{"resistance", &P::resistance},
                                   PhysicsWord{"inductance", &P::inductance},
                                   PhysicsWord{"voltage", &P::voltage},
                                   PhysicsWord{"power", &P::power},
                                   PhysicsWord{"current_density", &P::current_density},
                                   PhysicsWord{"coil_fill", &P::coil_fill},
                                   PhysicsWord{"core_saturation", &P::core_saturation},
                                   PhysicsWord{"core_flux_density", &P::core_flux_density},
                                   PhysicsWord{"flux_density", &P::flux_density},
                                   PhysicsWord{"flux", &P::flux},
                                   PhysicsWord{"field", &P::field},
                                   PhysicsWord{"yield_stress", &P::yield_stress},
                                   PhysicsWord{"viscosity", &P::viscosity},
                                   PhysicsWord{"pole_area", &P::pole_area},
                                   PhysicsWord{"magnetic_gap", &P::magnetic_gap},
                                   PhysicsWord{"core_reluctance", &P::core_reluctance},
                                   PhysicsWord{"gap_reluctance", &P::gap_reluctance},
                                   PhysicsWord{"spring_stiffness", &P::spring_stiffness},
                                   PhysicsWord{"spring_force", &P::spring_force}};

const PhysicsQuantity& row_of(double P::* value) {
  return *std::ranges::find(physics_quantities(), value, &PhysicsQuantity::value);
}

/// Figures of the physics come before fields of the same name, which may be 0 for "follows from
/// others".
std::vector<Q> all_quantities() {
  std::vector<Q> all;
  for (const PhysicsWord& word : kPhysicsWords) {
    const PhysicsQuantity& row = row_of(word.value);
    all.push_back({word.name, row.unit, row.name, word.value});
  }
  all.insert(all.end(), kEstimates.begin(), kEstimates.end());
  for (const DescriptionField& field : description_fields())
    if (std::ranges::find(all, field.name, &Q::name) == all.end())
      all.push_back({field.name, field.unit, field.meaning, nullptr, field.field, nullptr, true});
  return all;
}

}  // namespace

ShownUnit shown_unit(std::string_view si_unit) {
  struct Row {
    std::string_view si, shown;
    double factor;
  };
  constexpr std::array kRows{Row{"m", "mm", 1e-3},        Row{"m^2", "mm^2", 1e-6},
                             Row{"m^3", "cm^3", 1e-6},    Row{"s", "ms", 1e-3},
                             Row{"Pa", "kPa", 1e3},       Row{"A/m", "kA/m", 1e3},
                             Row{"A/m^2", "A/mm^2", 1e6}, Row{"H", "mH", 1e-3},
                             Row{"Wb", "mWb", 1e-3},      Row{"1", "", 1}};
  for (const Row& row : kRows)
    if (row.si == si_unit) return {std::string(row.shown), row.factor};
  return {std::string(si_unit), 1};
}

std::string shown_figure(double value, std::string_view si_unit) {
  const ShownUnit shown = shown_unit(si_unit);
  return format_number(value / shown.factor) + (shown.unit.empty() ? "" : ' ' + shown.unit);
}

double DesignQuantity::of(const OperatedDamper& damper) const {
  if (estimate) return estimate(damper);
  return physics ? damper.physics.*physics : damper.description.*field;
}

bool DesignQuantity::is_of_force() const {
  return physics == &P::force || physics == &P::off_force || physics == &P::dynamic_range ||
         estimate == controllable_force || estimate == response_time;
}

bool DesignQuantity::is_signed() const { return physics == &P::force || physics == &P::off_force; }

bool DesignQuantity::has_band() const { return is_of_force() && estimate != response_time; }

bool DesignQuantity::needs_flow() const {
  constexpr std::array kOfFlow{
      &P::flow,        &P::pressure,          &P::newtonian_pressure, &P::passive_pressure,
      &P::plate_force, &P::moving_wall_force, &P::viscous_force,      &P::yield_force,
      &P::yield_factor};
  return is_of_force() || estimate == control_ratio || estimate == controllable_power ||
         std::ranges::find(kOfFlow, physics) != kOfFlow.end();
}

bool DesignQuantity::needs_current() const {
  constexpr std::array kOfCurrent{&P::dynamic_range,   &P::flux,         &P::core_flux_density,
                                  &P::core_saturation, &P::flux_density, &P::field,
                                  &P::voltage,         &P::power,        &P::current_density};
  return estimate == controllable_force || estimate == response_time ||
         std::ranges::find(kOfCurrent, physics) != kOfCurrent.end();
}

std::span<const DesignQuantity> design_quantities() {
  static const std::vector<Q> all = all_quantities();
  return all;
}

const DesignQuantity& find_design_quantity(std::string_view name, const std::string& where) {
  std::vector<std::string> known;
  for (const Q& quantity : design_quantities()) {
    if (quantity.name == name || (quantity.physics && quantity.meaning == name)) return quantity;
    known.emplace_back(quantity.name);
  }
  throw Error(where, "unknown quantity '" + std::string(name) + "'", suggest(name, known));
}

}  // namespace dashpot
