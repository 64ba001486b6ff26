#pragma once
#include "dashpot/damper_model.h"
#include "dashpot/evaluate.h"

namespace dashpot {

inline constexpr double kStressFactor = 2;   ///< of the domain's amplitude and of its speed
inline constexpr double kStressSeconds = 5;  ///< simulated
inline constexpr double kStressSpans =
    10;  ///< more than this many force spans is no damper's answer

/// A sine of twice the domain's amplitude and speed (so at its frequency), about its middle; the
/// drive jumps between the ends of its range each half second. force_span: max - min of the data's
/// force, N.
StressRun stress(const DamperModel& model, const Domain& domain, double force_span);

}  // namespace dashpot
