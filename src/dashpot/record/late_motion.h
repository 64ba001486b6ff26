#pragma once
#include <optional>
#include <span>

#include "dashpot/dataset.h"

namespace dashpot {

/// A motion that is recorded later than the force, as by a displacement sensor whose electronics
/// take their time. A model takes it for inertia or for less hysteresis than there is, and is wrong
/// where the motion is quicker: no later look at errors on the same motions tells.
///
/// A damper's force follows its motion. So the forces at each constant drive are described by what
/// cannot go ahead of a motion (friction elements of several strokes, saturating and viscous
/// dampings of each direction, a spring; with coefficients >= 0, least squares) and an inertia,
/// which can, and the force is moved back against the motion by up to 20 ms. Where at every drive
/// with unlike motions one delay leaves at most 0.6 of the squared error, the motion is told to be
/// late by it. What a damper's own compliance hides is not seen: a force that follows late anyhow.
std::optional<Suspect> doubt_about_timing(std::span<const Record> records);

}  // namespace dashpot
