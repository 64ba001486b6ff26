#include "dashpot/identify/fit/family_record.h"

#include <array>
#include <map>

namespace dashpot {

FamilyGroups groups_of(const std::vector<FamilyRecord>& records) {
  // Number geometries, fluids and their pairs as they come.
  FamilyGroups groups;
  std::map<std::array<double, 4>, std::size_t> geometries;
  std::map<double, std::size_t> fluids;
  std::map<std::array<double, 5>, std::size_t> dampers;
  std::vector<std::size_t> fluid;
  for (const FamilyRecord& record : records) {
    const FamilyMember& m = record.member;
    groups.design.push_back(
        geometries.try_emplace({m.piston_area, m.gap_area, m.gap, m.pole_length}, geometries.size())
            .first->second);
    groups.damper.push_back(
        dampers
            .try_emplace({m.piston_area, m.gap_area, m.gap, m.pole_length, m.viscosity},
                         dampers.size())
            .first->second);
    fluid.push_back(fluids.try_emplace(m.viscosity, fluids.size()).first->second);
  }
  groups.dampers = dampers.size();
  groups.designs = geometries.size();

  // With one geometry only, each fluid is a design.
  if (groups.designs > 1) return groups;
  groups.design = fluid;
  groups.designs = fluids.size();
  return groups;
}

}  // namespace dashpot
