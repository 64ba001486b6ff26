#include "dashpot/damper/kinds/family/family_baseline.h"

#include "example_family.h"
#include "support.h"

using namespace dashpot;

// TC-3.3: equation 13 of the family paper as a force, without wall shear.
TEST_CASE("the viscous force has the sourced value") {
  CHECK_CLOSE(viscous_force(example_member(), 0.034), 0.76305403, 1e-7, 0);
}

TEST_CASE(
    "plate flow without yield stress is viscous; with one and no flow it is 2 tau L A_p / h") {
  const FamilyMember member = example_member();
  CHECK_CLOSE(plate_flow_force(member, 0.034, 0), viscous_force(member, 0.034), 1e-12, 0);
  CHECK_CLOSE(plate_flow_force(member, 0, 20122.8539), 2 * 20122.8539 * 6e-3 * 1.6029e-4 / 1e-3,
              1e-12, 0);
}

TEST_CASE("each target has its first principles beside it") {
  FamilyMember member = example_member();
  member.spring_stiffness = 100;
  const DamperInput input{0.01, 0.034, 0.5};
  CHECK(FamilyBaseline{}.force(member, input) == 0);
  CHECK_CLOSE((FamilyBaseline{FamilyTarget::YieldForce}.force(member, input)), 1 + 0.76305403, 1e-7,
              0);
  CHECK_CLOSE((FamilyBaseline{FamilyTarget::Residual, 0.5, 1e-3}.force(member, input)),
              1 + 0.5 * plate_flow_force(member, 0.034, 30000), 1e-9, 0);
  CHECK(family_target_named(name_of(FamilyTarget::Residual), "") == FamilyTarget::Residual);
  CHECK(message_of([] { family_target_named("totl", "x"); }).find("unknown target 'totl'") !=
        std::string::npos);
}
