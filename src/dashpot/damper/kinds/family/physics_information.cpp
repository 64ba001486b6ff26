#include "dashpot/damper/kinds/family/physics_information.h"

#include <algorithm>
#include <cmath>

#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {

std::vector<double> test_sensitivity(const FamilyPhysics& physics, double offset,
                                     const FamilyMember& member,
                                     std::span<const DamperInput> inputs,
                                     std::span<const double> time, std::size_t first) {
  constexpr double kStep = 1e-5;        // of the differences
  constexpr double kLeastForce = 1e-3;  // of the reference force: no share of a smaller one
  const std::vector<double> force = run_family_physics(physics, member, inputs, time);
  const std::size_t samples = force.size() - first;

  // One column for each unknown and each deviation; the offset moves all samples alike.
  std::vector<double> columns;
  columns.reserve(kTestRows * samples);
  const auto add_column = [&](const FamilyPhysics& moved, double step) {
    const std::vector<double> other = run_family_physics(moved, member, inputs, time);
    for (std::size_t k = first; k < force.size(); ++k)
      columns.push_back((other[k] - force[k]) / step);
  };
  for (std::size_t n = 0; n < kPhysicsNumbers; ++n) {
    FamilyPhysics moved = physics;
    const double step =
        physics.numbers[n] + kStep > FamilyPhysics::table()[n].high ? -kStep : kStep;
    moved.numbers[n] += step;
    add_column(moved, step);
  }
  columns.insert(columns.end(), samples, physics.reference.force);
  for (std::size_t d = 0; d < FamilyPhysics::kDeviations; ++d) {
    FamilyPhysics moved = physics;
    moved.deviation[d] += kStep;
    add_column(moved, kStep);
  }

  // Their products over the power of the force.
  double power = 0;
  for (std::size_t k = first; k < force.size(); ++k)
    power += (force[k] + offset) * (force[k] + offset);
  power = std::max(
      power, static_cast<double>(samples) * std::pow(kLeastForce * physics.reference.force, 2));
  std::vector<double> sensitivity(kTestRows * kTestRows);
  for (std::size_t i = 0; i < kTestRows; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < samples; ++k)
        sum += columns[i * samples + k] * columns[j * samples + k];
      sensitivity[i * kTestRows + j] = sensitivity[j * kTestRows + i] = sum / power;
    }
  return sensitivity;
}

std::vector<double> damper_information(const FamilyPhysics& physics,
                                       std::span<const double> tests) {
  constexpr std::size_t kOwn = FamilyPhysics::kDeviations;
  const double weight = 1 / (physics.record_error * physics.record_error);
  const auto at = [&](std::size_t i, std::size_t j) { return weight * tests[i * kTestRows + j]; };

  // The deviations' own block with what is expected of them, and their block across.
  std::vector<double> own = inverse(physics.deviation_covariance(), kOwn);
  std::vector<double> across(kOwn * kPhysicsUnknowns);
  for (std::size_t i = 0; i < kOwn; ++i) {
    for (std::size_t j = 0; j < kOwn; ++j)
      own[i * kOwn + j] += at(kPhysicsUnknowns + i, kPhysicsUnknowns + j);
    for (std::size_t j = 0; j < kPhysicsUnknowns; ++j)
      across[i * kPhysicsUnknowns + j] = at(kPhysicsUnknowns + i, j);
  }

  // Eliminate the deviations.
  const std::vector<double> taken = solve_columns(own, across, kOwn);
  std::vector<double> information(kPhysicsUnknowns * kPhysicsUnknowns);
  for (std::size_t i = 0; i < kPhysicsUnknowns; ++i)
    for (std::size_t j = 0; j < kPhysicsUnknowns; ++j) {
      double told = at(i, j);
      for (std::size_t k = 0; k < kOwn; ++k)
        told -= across[k * kPhysicsUnknowns + i] * taken[k * kPhysicsUnknowns + j];
      information[i * kPhysicsUnknowns + j] = told;
    }
  return information;
}

}  // namespace dashpot
