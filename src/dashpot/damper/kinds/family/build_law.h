#pragma once
#include <array>

#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/damper/kinds/family/physics_family.h"
#include "dashpot/damper/law.h"

namespace dashpot {

/// The builds of one damper of family_physics as a law, whose parameters say how a build differs
/// from its drawing: logarithms of the seal's friction, of the flow's force and of the springs,
/// each over the mean build's. So what identifies a law finds a build. It has no offset, is in no
/// list, and no model file can hold it: it serves identify_in_plant() alone.
class BuildLaw {
 public:
  /// The member must be of family_physics. Parameters reach six standard deviations of builds.
  explicit BuildLaw(const FamilyModel& member);
  BuildLaw(const BuildLaw&) = delete;
  BuildLaw& operator=(const BuildLaw&) = delete;

  /// Models of it end with this object.
  const Law& law() const { return law_; }
  static constexpr std::size_t kNumbers = 3;  ///< of a build; behind them stands the current
  using Numbers = std::array<double, kNumbers>;
  /// The law's numbers of a build, within their bounds, and how much builds differ in each.
  Numbers numbers_of(const FamilyPhysics::Deviation& build) const;
  Numbers spreads() const;
  /// p: the parameters in the order of the table.
  FamilyPhysics::Element element(const double* p) const noexcept;

 private:
  FamilyPhysics physics_;
  FamilyMember member_;
  Law law_;
};

}  // namespace dashpot
