#pragma once
#include <vector>

#include "dashpot/damper/kinds/family/family_member.h"
#include "dashpot/damper_input.h"

namespace dashpot {

/// One record of a member of a family.
struct FamilyRecord {
  FamilyMember member;
  std::vector<DamperInput> inputs;
  std::vector<double> time, force;
  std::size_t first = 0;  ///< scored from here on
  double specimen = 0;    ///< which build of its drawing
};

/// Which damper, drawing and design each record is of. A drawing is a geometry with a fluid, and a
/// damper one build of it; a design is all dampers of one geometry, or of one fluid where there is
/// one geometry.
struct FamilyGroups {
  std::vector<std::size_t> damper, design;  ///< one per record
  std::vector<std::size_t> drawing_of;      ///< one per damper
  std::size_t dampers = 0, drawings = 0, designs = 0;
};
FamilyGroups groups_of(const std::vector<FamilyRecord>& records);

}  // namespace dashpot
