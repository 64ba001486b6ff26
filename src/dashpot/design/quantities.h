#pragma once
#include <span>
#include <string>
#include <string_view>

#include "dashpot/design/design_model.h"

namespace dashpot {

struct DesignRequest;

/// A damper at work, of which quantities are computed; all must outlive it.
struct OperatedDamper {
  const DamperDescription& description;
  const DamperOperation& operation;
  const DamperPhysics& physics;
  const DesignModel& model;
  const DesignRequest* request = nullptr;  ///< whose ride `comfort` is of; null: there is none
};

/// Something that a design can be asked for: a figure of the physics, a field, or an estimate made
/// of them.
struct DesignQuantity {
  std::string_view name, unit, meaning;
  double DamperPhysics::* physics = nullptr;
  double DamperDescription::* field = nullptr;
  double (*estimate)(const OperatedDamper&) = nullptr;
  bool of_drawing = false;  ///< the same at any current and speed

  double of(const OperatedDamper& damper) const;
  /// Whether it is made of forces, in which models differ.
  bool is_of_force() const;
  /// Whether it has the sign of the velocity.
  bool is_signed() const;
  /// Whether a band of the forces makes one of it: of those figures all but times.
  bool has_band() const;
  /// Whether it says nothing at rest, where nothing flows.
  bool needs_flow() const;
  /// Whether it says nothing without a current: what one heats and magnetises, and what tells the
  /// force with it from that without.
  bool needs_current() const;
};

/// Every quantity, each name once: figures of the physics, estimates, then fields.
std::span<const DesignQuantity> design_quantities();
/// By its name, or by that of physics_quantities() ("time constant"). Throws Error(where, ...).
const DesignQuantity& find_design_quantity(std::string_view name, const std::string& where);

/// Name of the quantity that says how far a damper lies outside of those that its model was fitted
/// on; a constraint on it refuses such designs.
constexpr std::string_view kOutsideFamily = "outside_family";

/// A unit in which people read such figures, and what one of it is in SI: "mm", 0.001.
struct ShownUnit {
  std::string unit;
  double factor = 1;
};
ShownUnit shown_unit(std::string_view si_unit);
/// "12.3 mm" of a figure in SI.
std::string shown_figure(double value, std::string_view si_unit);

/// Name of the quantity that the ride of a request has.
constexpr std::string_view kRideComfort = "comfort";
/// What the request's ride (design_ride.h) says of the damper's model; NaN without a ride.
double comfort(const OperatedDamper& damper);

/// Time from a step of the coil's voltage to 90 % of the force's change, s. The flux linkage N
/// phi(i) follows the circuit with its saturation; eddy currents and the fluid's own milliseconds
/// are left out.
double response_time(const OperatedDamper& damper);

}  // namespace dashpot
