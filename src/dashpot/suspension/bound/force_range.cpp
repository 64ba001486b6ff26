#include "dashpot/suspension/bound/force_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

double straight(const std::vector<double>& v, const std::vector<double>& f, std::size_t k,
                double at) {
  return f[k] + (f[k + 1] - f[k]) * (at - v[k]) / (v[k + 1] - v[k]);
}

std::size_t place_of(const std::vector<double>& velocity, double v) {
  const auto after = std::upper_bound(velocity.begin() + 1, velocity.end() - 1, v);
  return static_cast<std::size_t>(after - velocity.begin()) - 1;
}

}  // namespace

ForceRange::Piece ForceRange::piece(double v, double share) const noexcept {
  const std::size_t k = place_of(velocity, v);
  const auto mixed = [&](std::size_t n) { return soft[n] + share * (hard[n] - soft[n]); };
  const double slope = (mixed(k + 1) - mixed(k)) / (velocity[k + 1] - velocity[k]);
  return {slope, mixed(k) - slope * velocity[k]};
}

double ForceRange::force(double v, double share) const noexcept {
  const Piece at = piece(v, share);
  return at.slope * v + at.offset;
}

double ForceRange::force_against(double free, double by_force, double share) const noexcept {
  double v = free, force = 0;
  for (int k = 0; k < 8; ++k) {
    const Piece at = piece(v, share);
    force = (at.slope * free + at.offset) / (1 - at.slope * by_force);
    const double reached = free + by_force * force;
    if (place_of(velocity, reached) == place_of(velocity, v)) break;
    v = reached;
  }
  return force;
}

double ForceRange::share(double v, double f) const noexcept {
  const std::size_t k = place_of(velocity, v);
  const double least = straight(velocity, soft, k, v),
               wide = straight(velocity, hard, k, v) - least;
  return wide == 0 ? 0 : std::clamp((f - least) / wide, 0.0, 1.0);
}

const ForceRange& ForceRange::at(double displacement) const noexcept {
  for (const ForceRange& part : parts)
    if (displacement <= part.to) return part;
  return parts.empty() ? *this : parts.back();
}

double ForceRange::least(std::size_t node) const noexcept {
  return std::min(soft[node], hard[node]);
}

double ForceRange::greatest(std::size_t node) const noexcept {
  return std::max(soft[node], hard[node]);
}

ForceRange damping_range(double least, double greatest) {
  if (!(least <= greatest))
    throw Error("damping range",
                "least " + format_number(least) + ", greatest " + format_number(greatest));
  ForceRange range;
  range.velocity = {-1, 0, 1};
  range.soft = {-least, 0, least};
  range.hard = {-greatest, 0, greatest};
  return range;
}

bool has_width(const ForceRange& range) { return range.soft != range.hard; }

namespace {

/// What is looked at: at each velocity every current and some displacements.
class ForceSamples {
 public:
  ForceSamples(const std::string& name, const StaticForce& force, const RangeLimits& limits)
      : name_(name), force_(force) {
    constexpr int kCurrents = 32, kDisplacements = 12;  // the latter either way
    for (int k = 0; k <= kCurrents; ++k)
      currents_.push_back(limits.current_min +
                          (limits.current_max - limits.current_min) * k / kCurrents);
    if (limits.displacement == 0) {
      displacements_ = {0};
      return;
    }
    for (int k = 1; k <= kDisplacements; ++k)
      for (const double side : {-1.0, 1.0})
        displacements_.push_back(side * limits.displacement * k / kDisplacements);
    for (const double beside : {-kBesideZero, 0.0, kBesideZero}) displacements_.push_back(beside);
  }

  struct Ends {
    double least = INFINITY, greatest = -INFINITY;
  };
  /// Beside a spring, on one side of the displacements (-1 or 1, with what is close to 0) or on
  /// both (0).
  Ends at(double velocity, double stiffness, int side) const {
    Ends ends;
    const auto look = [&](double v) {
      for (const double displacement : displacements_) {
        if (displacement * side < 0) continue;
        for (const double current : currents_) {
          const double force = force_({displacement, v, current});
          if (!std::isfinite(force))
            throw Error(name_, "its force is not finite at " + format_number(v) + " m/s",
                        "forces that a range can have");
          ends.least = std::min(ends.least, force - stiffness * displacement);
          ends.greatest = std::max(ends.greatest, force - stiffness * displacement);
        }
      }
    };

    // At a jump, which dry friction has at rest, both of its sides.
    look(velocity);
    if (velocity == 0) {
      look(-kBesideZero);
      look(kBesideZero);
    }
    return ends;
  }

  bool has_displacement() const { return displacements_.size() > 1; }
  double travel() const { return *std::max_element(displacements_.begin(), displacements_.end()); }

 private:
  static constexpr double kBesideZero = 1e-9;  // m/s or m
  const std::string& name_;
  const StaticForce& force_;
  std::vector<double> currents_, displacements_;
};

/// The spring beside which the range is narrowest. Its width, summed over some velocities, is
/// convex in the stiffness, being a sum of greatest less least of straight lines.
double narrowest_stiffness(const ForceSamples& samples, const std::vector<double>& velocity) {
  const auto width = [&](double stiffness) {
    double sum = 0;
    for (std::size_t k = 0; k < velocity.size(); k += 8) {
      for (const int side : {-1, 1}) {
        const ForceSamples::Ends ends = samples.at(velocity[k], stiffness, side);
        sum += ends.greatest - ends.least;
      }
    }
    return sum;
  };

  // No spring that is worth it is stiffer than the whole range over the travel.
  double high = width(0) / samples.travel(), low = -high;
  constexpr int kThirds = 40;
  for (int k = 0; k < kThirds; ++k) {
    const double first = low + (high - low) / 3, second = high - (high - low) / 3;
    if (width(first) <= width(second))
      high = second;
    else
      low = first;
  }
  const double best = 0.5 * (low + high);
  return width(best) < (1 - 1e-9) * width(0) ? best : 0;
}

/// Soft and hard from the samples on one side of the displacements, or on both.
void set_forces(ForceRange& range, const ForceSamples& samples, int side) {
  // Least and greatest force at each velocity.
  std::vector<ForceSamples::Ends> ends;
  for (const double v : range.velocity) ends.push_back(samples.at(v, range.stiffness, side));

  // Room for what lies between the velocities, where curves bend; a quarter more, because it too is
  // looked at in some places only.
  constexpr double kMore = 1.25;
  constexpr double kBetween[] = {0.25, 0.5, 0.75};
  std::vector<ForceSamples::Ends> room(ends.size(), {0, 0});
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    for (const double share : kBetween) {
      const auto mixed = [&](double a, double b) { return a + share * (b - a); };
      const ForceSamples::Ends found =
          samples.at(mixed(range.velocity[k], range.velocity[k + 1]), range.stiffness, side);
      const double under = mixed(ends[k].least, ends[k + 1].least) - found.least,
                   over = found.greatest - mixed(ends[k].greatest, ends[k + 1].greatest);
      for (const std::size_t node : {k, k + 1}) {
        room[node].least = std::max(room[node].least, kMore * under);
        room[node].greatest = std::max(room[node].greatest, kMore * over);
      }
    }
  range.soft.clear();
  range.hard.clear();
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const double least = ends[k].least - room[k].least,
                 greatest = ends[k].greatest + room[k].greatest;
    range.soft.push_back(range.velocity[k] < 0 ? greatest : least);
    range.hard.push_back(range.velocity[k] < 0 ? least : greatest);
  }
}

/// A range of damping, where all forces are in proportion to the velocity.
bool as_damping(const ForceRange& range, ForceRange& damping) {
  const auto none = std::pair{INFINITY, -INFINITY};
  std::pair<double, double> soft = none, hard = none;  // least and greatest slopes
  for (std::size_t k = 0; k < range.velocity.size(); ++k) {
    const double v = range.velocity[k];
    if (v == 0) continue;
    soft = {std::min(soft.first, range.soft[k] / v), std::max(soft.second, range.soft[k] / v)};
    hard = {std::min(hard.first, range.hard[k] / v), std::max(hard.second, range.hard[k] / v)};
  }
  const double rounding = 1e-6 * std::max(std::abs(soft.first), std::abs(hard.second));
  if (soft.second - soft.first > rounding || hard.second - hard.first > rounding) return false;
  const double least = soft.first, greatest = hard.second;
  damping = damping_range(least, greatest);
  return true;
}

}  // namespace

ForceRange force_range(const std::string& name, const StaticForce& force,
                       const RangeLimits& limits) {
  if (!(limits.velocity > 0 && limits.displacement >= 0 &&
        limits.current_min <= limits.current_max))
    throw Error(name, "a range up to " + format_number(limits.velocity) + " m/s and " +
                          format_number(limits.displacement) + " m between " +
                          format_number(limits.current_min) + " and " +
                          format_number(limits.current_max) + " A");
  const ForceSamples samples(name, force, limits);

  // Velocities close together where curves bend.
  constexpr int kVelocities = 60;  // either way
  ForceRange range;
  range.ends = true;
  for (int k = -kVelocities; k <= kVelocities; ++k) {
    const double share = static_cast<double>(k) / kVelocities;
    range.velocity.push_back(limits.velocity * share * std::abs(share));
  }

  // What of the displacement is a spring goes beside the range.
  if (samples.has_displacement()) {
    range.travel = limits.displacement;
    range.stiffness = narrowest_stiffness(samples, range.velocity);
  }

  // One table, or one for either side of the displacements and one for both.
  set_forces(range, samples, 0);
  if (samples.has_displacement()) {
    ForceRange inner = range, outer = range;
    set_forces(inner, samples, -1);
    set_forces(outer, samples, 1);
    inner.from = -limits.displacement;
    outer.to = limits.displacement;
    inner.to = outer.from = 0;
    for (std::size_t k = 0; k < range.velocity.size(); ++k) {
      range.soft[k] = range.velocity[k] < 0 ? std::max(inner.soft[k], outer.soft[k])
                                            : std::min(inner.soft[k], outer.soft[k]);
      range.hard[k] = range.velocity[k] < 0 ? std::min(inner.hard[k], outer.hard[k])
                                            : std::max(inner.hard[k], outer.hard[k]);
    }
    range.parts = {std::move(inner), std::move(outer)};
  }

  // The damper itself reaches less: its least and greatest force at one displacement.
  ForceRange damping;
  if (!samples.has_displacement() && as_damping(range, damping)) return damping;
  range.reach = [force, limits](double displacement, double velocity) {
    constexpr int kCurrents = 16;
    std::pair<double, double> reached{INFINITY, -INFINITY};
    for (int k = 0; k <= kCurrents; ++k) {
      const double current =
          limits.current_min + (limits.current_max - limits.current_min) * k / kCurrents;
      const double newton = force({displacement, velocity, current});
      reached = {std::min(reached.first, newton), std::max(reached.second, newton)};
    }
    return reached;
  };
  return range;
}

ForceRange model_range(const DamperModel& model, const RangeLimits& limits) {
  if (model.state_size() > 0)
    throw Error(model.name(), "has a memory: it has no range of forces by velocity alone",
                "a model without states, as 'network'");
  if (model.needs_displacement() && limits.displacement == 0)
    throw Error(model.name(), "depends on displacement, and no travel is stated");
  RangeLimits needed = limits;
  if (!model.needs_displacement()) needed.displacement = 0;
  return force_range(
      model.name(), [&model](const DamperInput& at) { return model.force(at, {}); }, needed);
}

namespace {

/// Least of a quadratic along both edges of a range, of which the edges decide: it is concave in F.
/// On a straight piece it is a parabola in v.
double least_along(const ForceRange& range, const ForceLimit& q) {
  double least = INFINITY;
  const auto& v = range.velocity;
  for (std::size_t k = 0; k + 1 < v.size(); ++k)
    for (const bool upper : {false, true}) {
      const double from = upper ? range.greatest(k) : range.least(k),
                   to = upper ? range.greatest(k + 1) : range.least(k + 1);
      const double slope = (to - from) / (v[k + 1] - v[k]), offset = from - slope * v[k];
      const double square = q.ff * slope * slope + q.fv * slope + q.vv,
                   linear = 2 * q.ff * slope * offset + q.fv * offset + q.f * slope + q.v;

      // Its values at the ends of the piece; outside the table pieces may go on for ever.
      const bool first = k == 0 && !range.ends, last = k + 2 == v.size() && !range.ends;
      const auto at = [&](double v_at) { return q.at(0, v_at, slope * v_at + offset); };
      if (!first) least = std::min(least, at(v[k]));
      if (!last) least = std::min(least, at(v[k + 1]));
      if ((first || last) && (square < 0 || (square == 0 && linear != 0))) {
        const bool falls = square < 0 || (first ? linear > 0 : linear < 0);
        if (falls) return -std::numeric_limits<double>::infinity();
      }

      // And at its lowest point, where that lies on the piece.
      const double bottom = square > 0 ? -0.5 * linear / square : 0;
      const bool inside = (first || bottom > v[k]) && (last || bottom < v[k + 1]);
      if (square > 0 && inside) least = std::min(least, at(bottom));
    }
  return least;
}

}  // namespace

std::vector<ForceLimit> sector_limits(const ForceRange& range) {
  // The point where the lines meet: the middle of the forces at rest.
  const double rest = 0.5 * (range.force(0, 0) + range.force(0, 1));
  const std::size_t last = range.velocity.size() - 1;

  // Slopes that hold the range in above some share of its velocities; below it the constant does.
  constexpr double kAbove[] = {0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8};
  std::vector<ForceLimit> limits;
  for (const double above : kAbove) {
    double least = INFINITY, greatest = -INFINITY;
    const auto include = [&](double v, double force) {
      if (v == 0 || std::abs(v) < above * range.velocity[last]) return;
      least = std::min(least, (force - rest) / v);
      greatest = std::max(greatest, (force - rest) / v);
    };
    for (std::size_t k = 0; k <= last; ++k)
      for (const double share : {0.0, 1.0})
        include(range.velocity[k], range.force(range.velocity[k], share));
    if (!range.ends)  // far outside of the table its last pieces decide
      for (const double v : {2 * range.velocity[0] - 1, 2 * range.velocity[last] + 1})
        for (const double share : {0.0, 1.0}) include(v, rest + range.piece(v, share).slope * v);
    if (!std::isfinite(least)) continue;

    // A limit that some constant makes hold all along the range, and that is not known yet.
    const double room = 1e-12 * std::max(std::abs(least), std::abs(greatest));
    const double a = least - room, b = greatest + room;
    ForceLimit limit{.ff = -1, .fv = a + b, .vv = -a * b, .f = 2 * rest, .v = -rest * (a + b)};
    limit.one = -least_along(range, limit);
    const auto same = [&](const ForceLimit& other) {
      return other.fv == limit.fv && other.vv == limit.vv;
    };
    if (std::isfinite(limit.one) && std::none_of(limits.begin(), limits.end(), same))
      limits.push_back(limit);
  }

  // Sectors of damping alone, where there are any.
  const auto takes_energy_out = [](const ForceLimit& limit) { return limit.vv <= 0; };
  if (std::any_of(limits.begin(), limits.end(), takes_energy_out))
    std::erase_if(limits, [&](const ForceLimit& limit) { return !takes_energy_out(limit); });
  return limits;
}

std::vector<RangeCorner> corners(const ForceRange& range) {
  std::vector<RangeCorner> found;
  const auto add = [&](const ForceRange& part, double displacement) {
    for (std::size_t k = 0; k < part.velocity.size(); k += 4) {
      found.push_back({displacement, part.velocity[k], part.least(k)});
      found.push_back({displacement, part.velocity[k], part.greatest(k)});
    }
  };
  if (range.parts.empty()) add(range, 0);
  for (const ForceRange& part : range.parts) {
    add(part, part.from);
    add(part, part.to);
  }
  return found;
}

}  // namespace dashpot
