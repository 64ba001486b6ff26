#include "dashpot/suspension/bound/force_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

std::size_t place_of(const std::vector<double>& velocity, double v) {
  const auto after = std::upper_bound(velocity.begin() + 1, velocity.end() - 1, v);
  return static_cast<std::size_t>(after - velocity.begin()) - 1;
}

}  // namespace

ForceCurves::Piece ForceCurves::piece(double v, double share) const noexcept {
  const std::size_t k = place_of(velocity_, v);
  const auto mixed = [&](std::size_t n) {
    const double soft = (*soft_[0])[n] + way_ * ((*soft_[1])[n] - (*soft_[0])[n]),
                 hard = (*hard_[0])[n] + way_ * ((*hard_[1])[n] - (*hard_[0])[n]);
    return soft + share * (hard - soft);
  };
  const double slope = (mixed(k + 1) - mixed(k)) / (velocity_[k + 1] - velocity_[k]);
  return {slope, mixed(k) - slope * velocity_[k]};
}

double ForceCurves::force(double v, double share) const noexcept {
  const Piece at = piece(v, share);
  return at.slope * v + at.offset;
}

double ForceCurves::force_against(double free, double by_force, double share) const noexcept {
  double v = free, force = 0;
  for (int k = 0; k < 8; ++k) {
    const Piece at = piece(v, share);
    force = (at.slope * free + at.offset) / (1 - at.slope * by_force);
    const double reached = free + by_force * force;
    if (place_of(velocity_, reached) == place_of(velocity_, v)) break;
    v = reached;
  }
  return force;
}

double ForceCurves::share(double v, double f) const noexcept {
  const double soft = force(v, 0), wide = force(v, 1) - soft;
  return wide == 0 ? 0 : std::clamp((f - soft) / wide, 0.0, 1.0);
}

double ForceCurves::slope_by_displacement(double v, double share) const noexcept {
  if (apart_ == 0) return 0;
  const ForceCurves first(velocity_, *soft_[0], *hard_[0]), second(velocity_, *soft_[1], *hard_[1]);
  return (second.force(v, share) - first.force(v, share)) / apart_;
}

ForceCurves ForceRange::at(double displacement) const noexcept {
  if (reached.empty()) return curves();
  const RangeSide& side =
      displacement <= reached.front().displacement.back() ? reached.front() : reached.back();
  const std::size_t k = place_of(side.displacement, displacement);
  const double from = side.displacement[k], apart = side.displacement[k + 1] - from;
  return {velocity, side, k, std::clamp((displacement - from) / apart, 0.0, 1.0)};
}

bool ForceRange::holds(double x, double v, double force, double slack) const noexcept {
  // The displacements on either side of x, and the velocities on either side of v.
  const std::size_t n = place_of(velocity, v);
  const double along = (v - velocity[n]) / (velocity[n + 1] - velocity[n]);
  const auto mixed = [&](const auto& at, std::size_t node) {
    if (sides.empty()) return at(*this, node);
    const RangeSide& side = x <= 0 ? sides.front() : sides.back();
    const std::size_t k = place_of(side.displacement, x);
    const double from = side.displacement[k], to = side.displacement[k + 1];
    return std::lerp(at(side, k, node), at(side, k + 1, node), (x - from) / (to - from));
  };
  const auto edge = [&](const auto& at) {
    return std::lerp(mixed(at, n), mixed(at, n + 1), along);
  };

  const double beside_spring = force - stiffness * x;
  const auto least = [](const auto& table, auto... place) { return table.least(place...); };
  const auto greatest = [](const auto& table, auto... place) { return table.greatest(place...); };
  return beside_spring >= edge(least) - slack && beside_spring <= edge(greatest) + slack;
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

bool stands(const ForceRange& range) {
  const auto zero = std::ranges::find(range.velocity, 0.0);
  if (zero == range.velocity.end()) return false;
  const auto node = static_cast<std::size_t>(zero - range.velocity.begin());
  return range.soft[node] == 0 && range.hard[node] == 0;
}

namespace {

struct ForceEnds {
  double least = INFINITY, greatest = -INFINITY;
  void include(const ForceEnds& other) {
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
  }
};

/// What is looked at: at each velocity every current and some displacements. Each velocity is
/// looked at once.
class ForceSamples {
 public:
  ForceSamples(const std::string& name, const StaticForce& force, const RangeLimits& limits)
      : name_(name), force_(force) {
    constexpr int kCurrents = 32;
    for (int k = 0; k <= kCurrents; ++k)
      currents_.push_back(limits.current_min +
                          (limits.current_max - limits.current_min) * k / kCurrents);
    const int steps = limits.displacement == 0 ? 0 : kDisplacements;
    for (int k = 0; k <= steps; ++k)
      distances_.push_back(steps == 0 ? 0 : limits.displacement * k / steps);
  }

  static constexpr int kDisplacements = 12;  ///< either way

  /// Over all currents at one of the distances from 0 and that way (-1 or 1), beside a spring: next
  /// to 0 and at it, where laws jump.
  ForceEnds at(double velocity, int side, std::size_t distance, double stiffness) const {
    const ForceEnds found = looked_at(velocity)[side < 0 ? 0 : 1][distance];
    const double spring = stiffness * side * distances_[distance];
    return {found.least - spring, found.greatest - spring};
  }
  /// The same over all distances.
  ForceEnds at(double velocity, int side, double stiffness) const {
    ForceEnds ends;
    for (std::size_t k = 0; k < distances_.size(); ++k)
      ends.include(at(velocity, side, k, stiffness));
    return ends;
  }

  /// Whether the currents move the force at rest by more than its jump there, and by no small part
  /// of what they do at a velocity: then the forces of a steady current do not turn with the
  /// motion.
  bool leans(double velocity) const {
    ForceEnds rest;
    for (const double current : currents_) {
      const double force = force_({0, 0, current});
      rest.include({force, force});
    }
    constexpr double kOfJump = 0.5, kOfAll = 0.1;
    const auto width = [](const ForceEnds& ends) { return ends.greatest - ends.least; };
    return width(rest) > kOfJump * width(at(0, 1, 0, 0)) &&
           width(rest) > kOfAll * width(at(velocity, 1, 0, 0));
  }

  bool has_displacement() const { return distances_.size() > 1; }
  const std::vector<double>& distances() const { return distances_; }
  double travel() const { return distances_.back(); }

 private:
  using Sides = std::array<std::vector<ForceEnds>, 2>;

  const Sides& looked_at(double velocity) const {
    const auto known = known_.find(velocity);
    if (known != known_.end()) return known->second;

    // At a jump, which dry friction has at rest, both of its sides.
    std::vector<double> velocities{velocity};
    if (velocity == 0) velocities = {-kBesideZero, 0, kBesideZero};
    Sides found;
    for (const int side : {-1, 1})
      for (const double distance : distances_)
        found[side < 0 ? 0 : 1].push_back(
            over(has_displacement() && distance == 0 ? side * kBesideZero : side * distance,
                 velocities));

    // At 0 itself a force mostly lies between those on its sides, and a limit that holds for these
    // holds for it. What lies beyond is of both.
    ForceEnds hull = found[0].front();
    hull.include(found[1].front());
    const ForceEnds middle = over(0, velocities);
    for (std::vector<ForceEnds>& side : found) {
      if (middle.least < hull.least) side.front().least = middle.least;
      if (middle.greatest > hull.greatest) side.front().greatest = middle.greatest;
    }
    return known_.emplace(velocity, std::move(found)).first->second;
  }

  ForceEnds over(double displacement, const std::vector<double>& velocities) const {
    ForceEnds ends;
    for (const double velocity : velocities)
      for (const double current : currents_) {
        const double force = force_({displacement, velocity, current});
        if (!std::isfinite(force))
          throw Error(name_, "its force is not finite at " + format_number(velocity) + " m/s",
                      "forces that a range can have");
        ends.include({force, force});
      }
    return ends;
  }

  static constexpr double kBesideZero = 1e-9;  // m/s or m
  const std::string& name_;
  const StaticForce& force_;
  std::vector<double> currents_, distances_;
  mutable std::map<double, Sides> known_;
};

/// The spring beside which the range is narrowest. Its width, summed over some velocities, is
/// convex in the stiffness, being a sum of greatest less least of straight lines.
double narrowest_stiffness(const ForceSamples& samples, const std::vector<double>& velocity) {
  const auto width = [&](double stiffness) {
    double sum = 0;
    for (std::size_t k = 0; k < velocity.size(); k += 8) {
      for (const int side : {-1, 1}) {
        const ForceEnds ends = samples.at(velocity[k], side, stiffness);
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

using EndsByVelocity = std::vector<ForceEnds>;

/// Soft is what resists less, either way; of a damper that leans, the least force.
void add_curves(const std::vector<double>& velocity, const EndsByVelocity& ends, bool leans,
                std::vector<double>& soft, std::vector<double>& hard) {
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    const bool turned = velocity[k] < 0 && !leans;
    soft.push_back(turned ? ends[k].greatest : ends[k].least);
    hard.push_back(turned ? ends[k].least : ends[k].greatest);
  }
}

/// Least and greatest forces on one side, or where there is no displacement, at the velocities of a
/// table and some of the samples' distances: straight between both.
class EdgeTable {
 public:
  EdgeTable(const ForceSamples& samples, const std::vector<double>& velocity, double stiffness,
            int side, std::vector<std::size_t> places)
      : samples_(samples),
        velocity_(velocity),
        stiffness_(stiffness),
        side_(side),
        places_(std::move(places)) {
    for (const std::size_t place : places_) {
      ends_.emplace_back();
      for (const double v : velocity_) ends_.back().push_back(found(v, place));
    }
  }

  /// Room for what lies between, where curves bend; a quarter more, because it too is looked at in
  /// some places only.
  void make_room() {
    std::vector<ForceEnds> room(velocity_.size(), {0, 0});
    for (std::size_t distance = 0; distance <= places_.back(); ++distance)
      for (std::size_t k = 0; k + 1 < velocity_.size(); ++k)
        for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) add_room(room, distance, k, share);
    for (EndsByVelocity& ends : ends_)
      for (std::size_t k = 0; k < ends.size(); ++k) {
        ends[k].least -= room[k].least;
        ends[k].greatest += room[k].greatest;
      }
  }

  const std::vector<EndsByVelocity>& ends() const { return ends_; }

  RangeSide side() const {
    RangeSide out;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      out.displacement.push_back(side_ * samples_.distances()[places_[k]]);
      add_curves(velocity_, ends_[k], samples_.leans(velocity_.back()), out.soft.emplace_back(),
                 out.hard.emplace_back());
    }
    if (side_ > 0) return out;
    for (auto* const list : {&out.soft, &out.hard}) std::ranges::reverse(*list);
    std::ranges::reverse(out.displacement);
    return out;
  }

 private:
  ForceEnds found(double v, std::size_t distance) const {
    return samples_.at(v, side_, distance, stiffness_);
  }

  /// What is missed at a distance and between two velocities of the table.
  void add_room(std::vector<ForceEnds>& room, std::size_t distance, std::size_t k,
                double share) const {
    // The table there.
    const std::size_t last = places_.size() - 1;
    std::size_t p = 0;
    while (p + 1 < last && places_[p + 1] < distance) ++p;
    const std::size_t q = std::min(p + 1, last);
    const double from = samples_.distances()[places_[p]], to = samples_.distances()[places_[q]];
    const double out = q == p ? 0 : (samples_.distances()[distance] - from) / (to - from);
    const auto mixed = [](double a, double b, double way) { return a + way * (b - a); };
    const auto table = [&](double ForceEnds::* end) {
      return mixed(mixed(ends_[p][k].*end, ends_[q][k].*end, out),
                   mixed(ends_[p][k + 1].*end, ends_[q][k + 1].*end, out), share);
    };

    // The damper there.
    constexpr double kMore = 1.25;
    const ForceEnds is = found(mixed(velocity_[k], velocity_[k + 1], share), distance);
    const double under = table(&ForceEnds::least) - is.least,
                 over = is.greatest - table(&ForceEnds::greatest);
    for (const std::size_t node : {k, k + 1}) {
      room[node].least = std::max(room[node].least, kMore * under);
      room[node].greatest = std::max(room[node].greatest, kMore * over);
    }
  }

  const ForceSamples& samples_;
  const std::vector<double>& velocity_;
  double stiffness_;
  int side_;
  std::vector<std::size_t> places_;
  std::vector<EndsByVelocity> ends_;  ///< by place
};

/// A table for either side of the displacements, close and without room, and wide and with it; and
/// one that is as wide as all of these.
void set_sides(ForceRange& range, const ForceSamples& samples) {
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < samples.distances().size(); ++k) all.push_back(k);
  EndsByVelocity widest(range.velocity.size());
  for (const int side : {-1, 1}) {
    range.reached.push_back(EdgeTable(samples, range.velocity, range.stiffness, side, all).side());

    // What is proven rests on three places of either side: rides are between the first two.
    EdgeTable table(samples, range.velocity, range.stiffness, side,
                    {0, all.back() / 3, all.back()});
    table.make_room();
    for (const EndsByVelocity& ends : table.ends())
      for (std::size_t k = 0; k < ends.size(); ++k) widest[k].include(ends[k]);
    range.sides.push_back(table.side());
  }
  add_curves(range.velocity, widest, samples.leans(range.velocity.back()), range.soft, range.hard);
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

  // By displacement, or one table for all.
  if (samples.has_displacement()) {
    set_sides(range, samples);
  } else {
    EdgeTable table(samples, range.velocity, 0, 1, {0});
    table.make_room();
    add_curves(range.velocity, table.ends().front(), samples.leans(range.velocity.back()),
               range.soft, range.hard);
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
        for (const double share : {0.0, 1.0})
          include(v, rest + range.curves().piece(v, share).slope * v);
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
  constexpr std::size_t kEvery = 4;
  std::vector<RangeCorner> found;
  const auto add = [&](double displacement, const auto& least, const auto& greatest) {
    for (std::size_t k = 0; k < range.velocity.size(); k += kEvery) {
      found.push_back({displacement, range.velocity[k], least(k)});
      found.push_back({displacement, range.velocity[k], greatest(k)});
    }
  };
  if (range.sides.empty())
    add(
        0, [&](std::size_t k) { return range.least(k); },
        [&](std::size_t k) { return range.greatest(k); });
  for (const RangeSide& side : range.sides)
    for (std::size_t p = 0; p < side.displacement.size(); ++p)
      add(
          side.displacement[p], [&](std::size_t k) { return side.least(p, k); },
          [&](std::size_t k) { return side.greatest(p, k); });
  return found;
}

}  // namespace dashpot
