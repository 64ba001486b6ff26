#pragma once
#include "damper/kinds/family/example_family.h"
#include "dashpot/damper/kinds/family/line_family.h"

namespace dashpot {

/// A family whose force resists the motion everywhere, up to 1 A, and falls a little with the gap.
/// by_current: the logarithm of what 1 A makes of it, or less than nothing.
inline FamilyModel resisting_family(double by_current = 0.2) {
  FamilyLine line;
  line.gap = 1e-3;
  line.pole_length = 6e-3;
  line.viscosity = 0.28;
  line.slow = 1e-3;
  line.size = {2, by_current, 0, 0, 0.1, -0.5};
  line.phase.assign(6, 0.);
  return {std::make_shared<Family>(family_of(std::make_shared<LineFamily>(line))),
          example_member()};
}

}  // namespace dashpot
