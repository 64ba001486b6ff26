#include "dashpot/identify/fit/family_record.h"

#include <array>
#include <map>
#include <utility>

namespace dashpot {

FamilyGroups groups_of(const std::vector<FamilyRecord>& records) {
  // Number geometries, fluids, their pairs and builds of these as they come.
  FamilyGroups groups;
  std::map<std::array<double, 4>, std::size_t> geometries;
  std::map<double, std::size_t> fluids;
  std::map<std::array<double, 5>, std::size_t> drawings;
  std::map<std::pair<std::size_t, double>, std::size_t> dampers;
  std::vector<std::size_t> fluid;
  for (const FamilyRecord& record : records) {
    const FamilyMember& m = record.member;
    groups.design.push_back(
        geometries.try_emplace({m.piston_area, m.gap_area, m.gap, m.pole_length}, geometries.size())
            .first->second);
    const std::size_t drawing =
        drawings
            .try_emplace({m.piston_area, m.gap_area, m.gap, m.pole_length, m.viscosity},
                         drawings.size())
            .first->second;
    const auto [damper, is_new] = dampers.try_emplace({drawing, record.specimen}, dampers.size());
    if (is_new) groups.drawing_of.push_back(drawing);
    groups.damper.push_back(damper->second);
    fluid.push_back(fluids.try_emplace(m.viscosity, fluids.size()).first->second);
  }
  groups.dampers = dampers.size();
  groups.drawings = drawings.size();
  groups.designs = geometries.size();

  // With one geometry only, each fluid is a design.
  if (groups.designs > 1) return groups;
  groups.design = fluid;
  groups.designs = fluids.size();
  return groups;
}

}  // namespace dashpot
