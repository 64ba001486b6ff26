#pragma once
#include <memory>

#include "dashpot/damper_model.h"

namespace dashpot {

/// No integrator meets its tolerance where friction jumps as the motion turns, and a car chatters
/// about a middle of the stroke at which the force jumps: the force changes over this speed, or
/// over this way to both sides, instead.
constexpr double kFrictionSpeed = 2e-3;  // m/s
constexpr double kSideWay = 2e-4;        // m

/// Whether the model's force jumps where the velocity passes 0, at the ends or in the middle of a
/// range of currents.
bool jumps_at_rest(const DamperModel& model, double current_min, double current_max);
/// Likewise where the displacement passes 0.
bool jumps_in_middle(const DamperModel& model, double current_min, double current_max);

/// The same model, its force within kFrictionSpeed of rest a straight line between those at its
/// ends.
std::shared_ptr<const DamperModel> with_soft_friction(std::shared_ptr<const DamperModel> model);
/// Likewise within kSideWay of the middle.
std::shared_ptr<const DamperModel> with_soft_sides(std::shared_ptr<const DamperModel> model);

}  // namespace dashpot
