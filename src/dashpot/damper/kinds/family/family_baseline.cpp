#include "dashpot/damper/kinds/family/family_baseline.h"

#include <array>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/physics/plate_flow.h"

namespace dashpot {
namespace {

constexpr std::array<std::string_view, 3> kTargets{"total", "yield_force", "residual"};

}  // namespace

std::string_view name_of(FamilyTarget target) { return kTargets[static_cast<std::size_t>(target)]; }

FamilyTarget family_target_named(std::string_view name, const std::string& where) {
  for (std::size_t k = 0; k < kTargets.size(); ++k)
    if (kTargets[k] == name) return static_cast<FamilyTarget>(k);
  throw Error(where, "unknown target '" + std::string(name) + "'",
              suggest(name, {kTargets.begin(), kTargets.end()}));
}

double viscous_force(const FamilyMember& m, double velocity) noexcept {
  const double moving_area = m.piston_area + m.gap_area / 2;
  return 12 * m.viscosity * m.pole_length * m.piston_area * moving_area * velocity /
         (m.gap_area * m.gap * m.gap);
}

double plate_flow_force(const FamilyMember& m, double speed, double yield_stress) noexcept {
  const PlateGap gap{m.pole_length, m.gap_area / m.gap, m.gap};
  return plate_bingham_pressure(viscous_force(m, speed),
                                m.piston_area * plate_yield_pressure(&gap, yield_stress));
}

double FamilyBaseline::force(const FamilyMember& member, const DamperInput& input) const noexcept {
  if (target == FamilyTarget::Total) return 0;
  const double spring = member.spring_stiffness * input.displacement;
  if (target == FamilyTarget::YieldForce) return spring + viscous_force(member, input.velocity);
  const double flow =
      plate_flow_force(member, std::abs(input.velocity), member.yield.at(input.current));
  return spring + share * std::tanh(input.velocity / onset) * flow;
}

}  // namespace dashpot
