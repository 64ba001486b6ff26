#pragma once
#include "dashpot/damper/kinds/family/physics_family.h"
#include "dashpot/identify/fit/family_record.h"
#include "dashpot/monitor.h"

namespace dashpot {

/// Ridges of what geometry does to the whole force, to the flow beyond physics, and to its spring.
struct GeometryRidges {
  double all = 0, yield = 0, spring = 0;
};

/// The fitted family with the offset of its force and the spread of its builds.
struct FamilyPhysicsFit {
  FamilyPhysics physics;
  double offset = 0;  ///< N
  /// From designs that were left out, with its 95 % interval; 0 where there is one.
  double build_spread = 0, spread_low = 0, spread_high = 0;
  /// Builds of one drawing tell theirs apart from what the family gets wrong of a drawing; else
  /// build_spread is of both.
  bool builds_repeat = false;
  double drawing_spread = 0;
  GeometryRidges ridges;  ///< that leaving designs out has chosen
  bool converged = false;
  int iterations = 0;
};

/// Least squares in free run, all records alike; each damper's build is drawn around its design
/// (ridge), and geometry's corrections shrink to physics by ridges that leaving designs out of
/// these records chooses, with the fit linearised. Throws Error where nothing moves.
FamilyPhysicsFit fit_family_physics(const std::vector<FamilyRecord>& records, int threads,
                                    const Monitor& monitor);

}  // namespace dashpot
