#include "dashpot/export/tables/force_map.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/export/export_run.h"

namespace dashpot {
namespace {

constexpr int kHalf = 15;  // velocities of either sign
constexpr int kCurrents = 11, kForces = 31;
constexpr double kLongest = 2.0;  // s, of a stroke
constexpr double kMostSteps = 2000;

double settled_force(const ExportedModel& model, double velocity, double current,
                     double sample_time) {
  const Domain& d = model.domain;
  const double middle = 0.5 * (d.displacement_min + d.displacement_max);
  const double half = 0.5 * (d.displacement_max - d.displacement_min);
  const double wanted =
      std::min(kLongest, half > 0 ? half / std::max(std::abs(velocity), 1e-12) : kLongest);

  // A stroke of half the domain, or of two seconds, in steps of the sample time.
  const double steps = std::clamp(std::ceil(wanted / sample_time), 1.0, kMostSteps);
  std::vector<DamperInput> stroke;
  for (double k = 0; k <= steps; ++k)
    stroke.push_back({middle + velocity * (k - steps) * sample_time, velocity, current});

  const double force = force_along(model.model, stroke, sample_time).back();
  if (!std::isfinite(force))
    throw Error(model.model.name(), "has no finite force at " + format_number(velocity) +
                                        " m/s and " + format_number(current) + " " +
                                        unit_of(model.drive_unit));
  return force;
}

std::vector<double> evenly(double low, double high, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(low + (high - low) * k / (count - 1));
  return values;
}

/// The current at which the row of forces first has the force, straight between currents; the
/// nearest else.
double current_for(const ForceMap& map, std::size_t v, double force) {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < map.current.size(); ++i) {
    const double here = map.at(v, i);
    if (here == force) return map.current[i];
    if (i > 0) {
      const double before = map.at(v, i - 1);
      if ((before < force) != (here < force))
        return map.current[i - 1] +
               (force - before) / (here - before) * (map.current[i] - map.current[i - 1]);
    }
    if (std::abs(here - force) < std::abs(map.at(v, nearest) - force)) nearest = i;
  }
  return map.current[nearest];
}

}  // namespace

ForceMap force_map(const ExportedModel& model, double sample_time) {
  ForceMap map;
  const Domain& d = model.domain;
  for (int k = -kHalf; k <= kHalf; ++k) {
    const double share = static_cast<double>(k * k) / (kHalf * kHalf);
    map.velocity.push_back(share * (k < 0 ? d.velocity_min : d.velocity_max));
  }
  map.current = d.current_max > d.current_min ? evenly(d.current_min, d.current_max, kCurrents)
                                              : std::vector{d.current_min};
  for (const double velocity : map.velocity)
    for (const double current : map.current)
      map.force.push_back(settled_force(model, velocity, current, sample_time));
  return map;
}

CurrentMap inverse_of(const ForceMap& map) {
  const auto [low, high] = std::ranges::minmax_element(map.force);
  CurrentMap inverse{map.velocity, evenly(*low, *high, kForces), {}};
  for (std::size_t v = 0; v < map.velocity.size(); ++v)
    for (const double force : inverse.force) inverse.current.push_back(current_for(map, v, force));
  return inverse;
}

}  // namespace dashpot
