#pragma once
#include <cmath>

#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/damper/kinds/family/physics_family.h"

namespace dashpot {

/// The damper of TC-3.3: 6 mm poles, a gap of 1 mm.
inline FamilyMember example_member() {
  FamilyMember member;
  member.piston_area = 1.6029e-4;
  member.gap_area = 2.487e-5;
  member.gap = 1e-3;
  member.pole_length = 6e-3;
  member.viscosity = 0.28;
  member.yield = {{0, 0.5, 1}, {2000, 30000, 50000}};
  return member;
}

inline FamilyGates example_gates() {
  FamilyGates gates;
  gates.bank.path_rates = {100, 500};
  gates.bank.velocity_rates = {3};
  gates.soft_speeds = {0.01};
  gates.half_current = 0.6;
  gates.mean = {0.4, std::log(0.1), 1.5e-3, 8e-3};
  gates.scale = {0.2, 0.9, 4e-4, 1.6e-3};
  gates.term_scale = {0.01, 1, 1, 0.01, 1, 1};
  for (std::size_t k = 0; k < gates.term_count() * FamilyGates::kGates; ++k)
    gates.weights.push_back(std::sin(static_cast<double>(k)));
  return gates;
}

inline Mlp example_family_mlp() {
  Mlp mlp;
  mlp.layers = {3, 4, 1};
  mlp.activations = {Activation::Relu, Activation::Identity};
  mlp.parameters.resize(Mlp::parameter_count(mlp.layers));
  initialise(mlp, 5);
  mlp.input_mean = {1.5e-3, 3e4, 0};
  mlp.input_scale = {5e-4, 2e4, 0.02};
  mlp.output_scale = 10;
  return mlp;
}

inline Family family_of(std::shared_ptr<const FamilyForce> force) {
  Family family;
  family.name = "family_gated";
  family.force = std::move(force);
  family.build_spread = 0.1;
  for (const MemberField& field : member_fields())
    if (field.required)
      family.domain.push_back(
          {field.field, 0.5 * example_member().*field.field, 2 * example_member().*field.field});
  return family;
}

inline FamilyModel example_family(FamilyTarget target = FamilyTarget::Total) {
  Family family = family_of(std::make_shared<GatedFamily>(example_gates()));
  family.baseline = {target, 0.4, 2e-3};
  return {std::make_shared<Family>(family), example_member(), 0.5};
}

inline FamilyModel example_family_network() {
  Family family = family_of(
      std::make_shared<FamilyNetwork>(std::vector<std::string>{"gap", "yield_stress", "velocity"},
                                      std::vector{example_family_mlp()}));
  family.name = "family_h3x15";
  family.baseline.target = FamilyTarget::YieldForce;
  return {std::make_shared<Family>(family), example_member()};
}

/// Plate flow with corrections, a build and a coil that lags.
inline FamilyModel example_family_physics() {
  FamilyPhysics physics;
  physics.reference = {2e-4, 3e-5, 1.2e-3, 8e-3, 0.2, 2e4, 0.5, 15, 0.05, 0.02};
  physics.numbers = FamilyPhysics::priors();
  physics.numbers[kRoundness] = 0.3;
  physics.numbers[kGapOfYield] = 0.2;
  physics.numbers[kLengthOfAll] = -0.1;
  physics.numbers[kSealGain] = 0.4;
  physics.numbers[kAsymmetry] = 0.1;
  physics.deviation = {0.05, -0.1, 0.2, 0.03};
  Family family = family_of(std::make_shared<PhysicsFamily>(physics));
  family.name = "family_physics";
  FamilyMember member = example_member();
  member.lag_rate = 150;
  member.build = 0.5;
  return {std::make_shared<Family>(family), member, 0.25};
}

/// The gated family with a coil that lags.
inline FamilyModel example_family_lag() {
  FamilyMember member = example_member();
  member.lag_rate = 80;
  return {std::make_shared<Family>(example_family().family()), member, 0.5};
}

}  // namespace dashpot
