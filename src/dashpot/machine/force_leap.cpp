#include "dashpot/machine/force_leap.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace dashpot {
namespace {

constexpr double kTimesOfSwing = 11;
constexpr double kNextToZero = 1e-200;  // m or m/s: so near to 0 that only a leap lies between
constexpr double kNoLeap = 1e-6;        // N: no leap

/// How far the force leaps where the stroke passes 0, N.
double leap_over_stroke(const DamperModel& damper, DamperInput at, std::span<const double> state) {
  at.displacement = kNextToZero;
  const double above = damper.force(at, state);
  at.displacement = -kNextToZero;
  return above - damper.force(at, state);
}

/// Likewise where the speed does, at the middle of the stroke.
double leap_over_speed(const DamperModel& damper, double drive, std::span<const double> state) {
  return damper.force({0, kNextToZero, drive}, state) -
         damper.force({0, -kNextToZero, drive}, state);
}

}  // namespace

ForceLeap::ForceLeap(const DamperModel& damper, double low, double high, double time, double yields)
    : damper_(&damper), half_time_(time / 2) {
  // At rest the force is leap / (2 reach) stiff, and swings by the root of that over the mass.
  constexpr double kRadians = 2 * std::numbers::pi / kTimesOfSwing;  // over that time
  std::vector<double> state(damper.state_size());
  for (const double drive : {low, high}) {
    damper.rest({0, 0, drive}, state);
    const double leap = std::abs(leap_over_stroke(damper, {0, 0, drive}, state));
    if (leap > kNoLeap) slow_ = std::max(slow_, leap * yields * time / (kRadians * kRadians));
  }
}

double ForceLeap::beyond_line(const DamperInput& at, std::span<const double> state) const noexcept {
  const double far = std::abs(at.displacement);
  if (slow_ == 0 || far > half_time_ * (std::abs(at.velocity) + slow_)) return 0;
  const double reach = half_time_ * std::hypot(at.velocity, slow_);
  if (far >= reach || far == 0) return 0;
  const double side = at.displacement > 0 ? 1 : -1;
  return leap_over_stroke(*damper_, at, state) / 2 * (side - at.displacement / reach);
}

bool leaps_at_rest(const DamperModel& damper, double low, double high) {
  std::vector<double> state(damper.state_size());
  for (const double drive : {low, high}) {
    damper.rest({0, 0, drive}, state);
    if (std::abs(leap_over_stroke(damper, {0, 0, drive}, state)) > kNoLeap ||
        std::abs(leap_over_speed(damper, drive, state)) > kNoLeap)
      return true;
  }
  return false;
}

}  // namespace dashpot
