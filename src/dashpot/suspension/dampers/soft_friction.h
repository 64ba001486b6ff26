#pragma once
#include <memory>

#include "dashpot/damper_model.h"

namespace dashpot {

/// No integrator meets its tolerance where friction jumps as the motion turns: it sets in over this
/// speed instead.
constexpr double kFrictionSpeed = 2e-3;  // m/s

/// Whether the model's force jumps where the velocity passes 0, at the ends or in the middle of a
/// range of currents.
bool jumps_at_rest(const DamperModel& model, double current_min, double current_max);

/// The same model, its force within kFrictionSpeed of rest a straight line between those at its
/// ends.
std::shared_ptr<const DamperModel> with_soft_friction(std::shared_ptr<const DamperModel> model);

}  // namespace dashpot
