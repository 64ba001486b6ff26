#include "dashpot/record/differences.h"

#include <algorithm>
#include <cmath>

namespace dashpot {
namespace {

constexpr double kSameLevel = 0.02;

Difference difference_of(const Measured& first, const Measured& second) {
  return {first.value, second.value, std::hypot(first.error, second.error)};
}

/// The scatter of one cycle's force, N; 0 where it was computed rather than measured.
double scatter_of(const SpeedFigures& figures) {
  return figures.repeatability / 100 * std::abs(figures.damping_force);
}

/// The level of the other characterisation at that drive; null where it has none.
const LevelFigures* level_at(const Characterisation& all, const LevelFigures& level,
                             double greatest) {
  if (!level.drive) return all.levels.size() == 1 ? &all.levels.front() : nullptr;
  const auto found = std::ranges::find_if(all.levels, [&](const LevelFigures& other) {
    return other.drive && std::abs(*other.drive - *level.drive) <= kSameLevel * greatest;
  });
  return found == all.levels.end() ? nullptr : &*found;
}

/// A number with the load cell's zero in it, which repeats tell nothing of.
Difference with_zero(double first, double second) { return {first, second, kNoNumber}; }

SpeedDifference difference_at(const SpeedFigures& first, const SpeedFigures& second) {
  return {first.speed,
          with_zero(first.rebound.mid_force, second.rebound.mid_force),
          with_zero(first.compression.mid_force, second.compression.mid_force),
          {first.damping_force, second.damping_force,
           std::hypot(scatter_of(first), scatter_of(second))}};
}

}  // namespace

std::optional<bool> Difference::is_clear() const {
  if (!std::isfinite(noise) || !std::isfinite(value())) return std::nullopt;
  return std::abs(value()) > 2 * noise;
}

std::vector<LevelDifference> differences(const Characterisation& first,
                                         const Characterisation& second,
                                         const std::vector<double>& speeds) {
  double greatest = 0;
  for (const Characterisation* all : {&first, &second})
    for (const LevelFigures& level : all->levels)
      greatest = std::max(greatest, std::abs(level.drive.value_or(0)));

  std::vector<LevelDifference> levels;
  for (const LevelFigures& one : first.levels) {
    const LevelFigures* other = level_at(second, one, greatest);
    if (!other) continue;
    LevelDifference level{
        .drive = one.drive,
        .speeds = {},
        .friction = difference_of(one.friction, other->friction),
        .yield = difference_of(one.yield, other->yield),
        .static_force = with_zero(one.static_force.value, other->static_force.value),
        .rate = difference_of(one.rate, other->rate),
        .knee_rebound = difference_of(one.rebound.knee, other->rebound.knee),
        .knee_compression = difference_of(one.compression.knee, other->compression.knee)};

    // A knee among speeds and one in a loop are found in different ways: what the fits scatter by
    // tells nothing of whether the two differ.
    if (one.basis != other->basis)
      for (Difference* figure :
           {&level.friction, &level.yield, &level.knee_rebound, &level.knee_compression})
        figure->noise = kNoNumber;

    // At the stated speeds, or at those of the first.
    std::vector<double> at = speeds;
    if (at.empty())
      for (const SpeedFigures& figures : one.speeds) at.push_back(figures.speed);
    for (const double speed : at) {
      const auto a = at_speed(one, speed), b = at_speed(*other, speed);
      if (a && b) level.speeds.push_back(difference_at(*a, *b));
    }
    levels.push_back(std::move(level));
  }
  return levels;
}

}  // namespace dashpot
