#pragma once
#include <span>
#include <vector>

#include "dashpot/damper/kinds/family/physics_family.h"

namespace dashpot {

// What tests tell of a family of physics, linear about its numbers (Gauss and Newton). Matrices are
// symmetric, row by row. Their first kPhysicsUnknowns rows are of what all dampers share, the
// numbers and the offset over the reference force; in a test's matrix the kDeviations of the damper
// that it is run on follow.

constexpr std::size_t kPhysicsUnknowns = kPhysicsNumbers + 1;
constexpr std::size_t kTestRows = kPhysicsUnknowns + FamilyPhysics::kDeviations;

/// J'J of one test in free run, kTestRows square, where J is how the force moves over its root mean
/// square: v' (J'J) v is the mean square share by which a change v moves the force. `offset`: N, of
/// the family. Scored from the sample `first` on.
std::vector<double> test_sensitivity(const FamilyPhysics& physics, double offset,
                                     const FamilyMember& member,
                                     std::span<const DamperInput> inputs,
                                     std::span<const double> time, std::size_t first);

/// What the tests of one damper tell of the unknowns, kPhysicsUnknowns square, when it deviates
/// from its drawing as dampers left out of the fit did: the deviations are eliminated. `tests`: the
/// sum of J'J of its tests; each is known to the family's error of a record, as one observation.
std::vector<double> damper_information(const FamilyPhysics& physics, std::span<const double> tests);

}  // namespace dashpot
