#include "dashpot/suspension/bound/force_range.h"

#include <algorithm>
#include <array>
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

ForceRange damping_range(double least, double greatest) {
  if (!(least <= greatest))
    throw Error("damping range",
                "least " + format_number(least) + ", greatest " + format_number(greatest));
  return {{-1, 0, 1}, {-least, 0, least}, {-greatest, 0, greatest}};
}

namespace {

/// Least of -(F - a v)(F - b v) over both edges of a range: minus this is the constant that the
/// limit needs. q is concave in F, so the edges decide; on a straight piece it is a parabola in v.
double shortfall(const ForceRange& range, double a, double b) {
  double least = 0;
  const auto& v = range.velocity;
  for (std::size_t k = 0; k + 1 < v.size(); ++k)
    for (const double share : {0.0, 1.0}) {
      const auto [slope, offset] = range.piece(0.5 * (v[k] + v[k + 1]), share);
      const double square = -(slope - a) * (slope - b), linear = -offset * (2 * slope - a - b);

      // Its values at the ends of the piece; outside the table pieces go on for ever.
      const bool first = k == 0, last = k + 2 == v.size();
      const auto at = [&](double x) { return square * x * x + linear * x - offset * offset; };
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

std::vector<ForceLimit> force_limits(const ForceRange& range) {
  // Slopes that hold the range in above some speed; below it the limit's constant does.
  constexpr double kAbove[] = {0, 0.05, 0.15, 0.4, 1};
  const std::size_t last = range.velocity.size() - 1;
  std::vector<ForceLimit> limits;
  for (const double above : kAbove) {
    // The slopes between which all forces lie at these speeds and beyond.
    double least = INFINITY, greatest = -INFINITY;
    const auto include = [&](double slope) {
      least = std::min(least, slope);
      greatest = std::max(greatest, slope);
    };
    for (const double share : {0.0, 1.0}) {
      for (const double end : {range.velocity[0] - 1, range.velocity[last] + 1})
        include(range.piece(end, share).slope);
      for (const double v : range.velocity)
        if (v != 0 && std::abs(v) >= above) include(range.force(v, share) / v);
    }

    // A limit that some constant makes hold all along the range, and that is not known yet.
    const double missing = shortfall(range, least, greatest);
    if (!(least >= 0) || !std::isfinite(missing)) continue;
    const ForceLimit limit{-1, least + greatest, -least * greatest, -missing};
    const auto same = [&](const ForceLimit& other) {
      return other.fv == limit.fv && other.vv == limit.vv;
    };
    if (std::none_of(limits.begin(), limits.end(), same)) limits.push_back(limit);
  }
  if (limits.empty()) throw Error("clairvoyant bound", "the range of forces is not dissipative");
  return limits;
}

bool has_width(const ForceRange& range) { return range.soft != range.hard; }

ForceRange model_range(const DamperModel& model, double current_min, double current_max,
                       double velocity_max) {
  if (model.state_size() > 0)
    throw Error(model.name(), "has a memory: it has no range of forces by velocity alone",
                "a model without states, as 'network'");
  if (!(velocity_max > 0 && current_min < current_max))
    throw Error(model.name(), "a range up to " + format_number(velocity_max) + " m/s between " +
                                  format_number(current_min) + " and " +
                                  format_number(current_max) + " A");

  // Least and greatest force over the currents, at velocities of a grid.
  constexpr int kVelocities = 60, kCurrents = 20;  // either way
  ForceRange range;
  for (int k = -kVelocities; k <= kVelocities; ++k) {
    const double share = static_cast<double>(k) / kVelocities;
    const double v = velocity_max * share * std::abs(share);  // close together where curves bend
    double least = INFINITY, greatest = -INFINITY;
    for (int i = 0; i <= kCurrents; ++i) {
      const double current = current_min + (current_max - current_min) * i / kCurrents;
      const double force = model.force({0, v, current}, {});
      least = std::min(least, force);
      greatest = std::max(greatest, force);
    }
    range.velocity.push_back(v);
    range.soft.push_back(v < 0 ? greatest : least);
    range.hard.push_back(v < 0 ? least : greatest);
  }
  // Where the model has no data, forces in proportion to the velocity.
  for (std::vector<double>* table : {&range.velocity, &range.soft, &range.hard}) {
    const double first = table->front(), last = table->back();
    table->insert(table->begin(), 2 * first);
    table->push_back(2 * last);
  }
  return range;
}

}  // namespace dashpot
