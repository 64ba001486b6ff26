#pragma once
#include <string_view>

#include "dashpot/damper/kinds/family/family_member.h"
#include "dashpot/damper_model.h"

namespace dashpot {

/// The share of the force that a family's learned part stands for.
enum class FamilyTarget {
  Total,       ///< the whole force, as the family paper's authors' code has it
  YieldForce,  ///< F_Ty: what spring and viscous flow leave, as their paper has it
  Residual     ///< what the spring and a share of the quasi-static plate flow leave
};
std::string_view name_of(FamilyTarget target);
/// Throws Error(where, "unknown target ...").
FamilyTarget family_target_named(std::string_view name, const std::string& where);

/// The first-principles part beside the learned one.
struct FamilyBaseline {
  FamilyTarget target = FamilyTarget::Total;
  double share = 1;     ///< of the plate flow's force
  double onset = 1e-3;  ///< m/s: the plate flow's force sets in as tanh(v / onset)

  double force(const FamilyMember& member, const DamperInput& input) const noexcept;
};

/// F_eta of equations 13 and 14, as a force: 12 eta L A_p (A_p + A_g / 2) v / (A_g h^2), N.
double viscous_force(const FamilyMember& member, double velocity) noexcept;
/// Force of a Bingham fluid between parallel plates: pressure times piston area, N, at a
/// speed >= 0.
double plate_flow_force(const FamilyMember& member, double speed, double yield_stress) noexcept;

}  // namespace dashpot
