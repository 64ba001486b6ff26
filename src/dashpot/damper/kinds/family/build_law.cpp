#include "dashpot/damper/kinds/family/build_law.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dashpot {
namespace {

const BuildLaw& build_of(const void* with) { return *static_cast<const BuildLaw*>(with); }

int step_build(const void* with, const double* p, const double*, const double* v, double h,
               double* z) {
  const FamilyPhysics::Element element = build_of(with).element(p);
  physics_advance(&element, v[0], v[1], h, z);
  return 1;
}

double force_of_build(const void*, const double*, double, double, const double* z) {
  return z[0] + z[1];
}

/// By a short step, since the resistances are known by their forces and not by their speeds.
double flow_of_build(const void* with, const double* p, double x, double v, const double* z,
                     double* dz) {
  constexpr double kShort = 1e-6;  // s
  const double speeds[] = {v, v};
  double later[kPhysicsStates];
  std::copy_n(z, kPhysicsStates, later);
  step_build(with, p, nullptr, speeds, kShort, later);
  for (std::size_t k = 0; k < kPhysicsStates; ++k) dz[k] = (later[k] - z[k]) / kShort;
  return force_of_build(with, p, x, v, z);
}

void rest_build(const void*, const double*, double, double, double* z) {
  std::fill_n(z, kPhysicsStates, 0.);
}

/// As fast as can be: what is stable for springs of any stiffness is the law's own step.
double rate_of_build(const void*, const double*, double) {
  constexpr double kFast = 1e6;
  return kFast;
}

}  // namespace

BuildLaw::BuildLaw(const FamilyModel& member) : member_(member.member()) {
  const auto* force = dynamic_cast<const PhysicsFamily*>(member.family().force.get());
  assert(force);
  physics_ = force->physics();
  law_ = {.name = "this_build",
          .title = "A build of a drawing",
          .equation = {},
          .source = {},
          .remarks = {},
          .states = {{"seal", "N"}, {"flow", "N"}, {"follower", "m/s"}},
          .params = {},
          .needs_displacement = false,
          .rest = {this, rest_build},
          .derivative = nullptr,
          .force = {this, force_of_build},
          .forces = nullptr,
          .flow = {this, flow_of_build},
          .runge_kutta = nullptr,
          .rate = {this, rate_of_build},
          .step = {this, step_build},
          .exact_step = true,
          .fastest_rate = nullptr};

  // How a build may differ, and the current.
  constexpr double kReach = 6, kWidest = 3;
  constexpr struct {
    std::string_view name, meaning;
  } kRows[kNumbers] = {{"seal", "ln of the seal's friction over the mean build's"},
                       {"flow", "ln of the flow's force over the mean build's"},
                       {"springs", "ln of the springs over the mean build's"}};
  const Numbers spread = spreads();
  for (std::size_t k = 0; k < kNumbers; ++k) {
    const double reach = std::min(kReach * spread[k], kWidest);
    law_.params.push_back({.name = kRows[k].name,
                           .unit = "1",
                           .lower = -reach,
                           .upper = reach,
                           .meaning = kRows[k].meaning});
  }
  law_.params.push_back({.name = "current",
                         .unit = "A",
                         .lower = -100,
                         .upper = 100,
                         .fit = Fit::Drive,
                         .meaning = "in the coil"});
}

// The family counts flow and springs beyond the whole force, which the seal's friction goes with.
FamilyPhysics::Element BuildLaw::element(const double* p) const noexcept {
  return physics_.element(member_, {p[0], p[1] - p[0], p[2] - p[0], 0}, p[kNumbers]);
}

BuildLaw::Numbers BuildLaw::numbers_of(const FamilyPhysics::Deviation& build) const {
  Numbers numbers{build[0], build[0] + build[1], build[0] + build[2]};
  for (std::size_t k = 0; k < kNumbers; ++k)
    numbers[k] = std::clamp(numbers[k], law_.params[k].lower, law_.params[k].upper);
  return numbers;
}

BuildLaw::Numbers BuildLaw::spreads() const {
  const std::vector<double> covariance = physics_.deviation_covariance();
  const auto at = [&](std::size_t i, std::size_t k) {
    return covariance[i * FamilyPhysics::kDeviations + k];
  };
  Numbers spread;
  for (std::size_t k = 0; k < kNumbers; ++k)
    spread[k] = std::sqrt(k == 0 ? at(0, 0) : at(0, 0) + at(k, k) + 2 * at(0, k));
  return spread;
}

}  // namespace dashpot
