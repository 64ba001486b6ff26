#pragma once
#include "dashpot/damper/model.h"

namespace dashpot {

/// A model driven beyond its data: whether its force stayed finite, and how large it grew.
struct StressRun {
  double seconds = 0;        ///< simulated; 0: not run
  bool finite = false;       ///< the force was a number all along
  double largest_share = 0;  ///< largest |F| over the force span of the data
  bool is_bounded() const;   ///< finite, and within kStressSpans spans
};

inline constexpr double kStressFactor = 2;   ///< of the domain's amplitude and of its speed
inline constexpr double kStressSeconds = 5;  ///< simulated
inline constexpr double kStressSpans =
    10;  ///< more than this many force spans is no damper's answer

/// A sine of twice the domain's amplitude and speed (so at its frequency), about its middle; the
/// drive jumps between the ends of its range each half second. force_span: max - min of the data's
/// force, N.
StressRun stress(const DamperModel& model, const Domain& domain, double force_span);

}  // namespace dashpot
