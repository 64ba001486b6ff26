#include "dashpot/export/tables/force_map.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/print_units.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/export/export_run.h"

namespace dashpot {
namespace {

constexpr int kHalf = 15;  // velocities of either sign
constexpr int kCurrents = 11, kForces = 31;
constexpr double kLongest = 2.0;  // s, of a stroke
constexpr double kMostSteps = 20000;

double settled_force(const ExportedModel& model, double velocity, double current,
                     double sample_time) {
  const Domain& d = model.domain;
  const double middle = 0.5 * (d.displacement_min + d.displacement_max);
  const double half = 0.5 * (d.displacement_max - d.displacement_min);
  const double wanted =
      std::min(kLongest, half > 0 ? half / std::max(std::abs(velocity), 1e-12) : kLongest);

  // A stroke of half the domain, or of two seconds, in steps of the sample time; longer ones where
  // these would be too many, so that it is as long whatever the data's rate is.
  const double own_steps = std::max(1.0, std::ceil(wanted / sample_time));
  const double steps = std::min(own_steps, kMostSteps);
  const double step = own_steps > kMostSteps ? wanted / steps : sample_time;
  std::vector<DamperInput> stroke;
  for (double k = 0; k <= steps; ++k)
    stroke.push_back({middle + velocity * (k - steps) * step, velocity, current});

  const double force = force_along(model.model, stroke, step).back();
  if (!std::isfinite(force))
    throw Error(model.model.name(), "has no finite force at " + format_number(velocity) +
                                        " m/s and " + format_number(current) + " " +
                                        unit_of(model.drive_unit));
  return force;
}

/// The nearest number of 12 digits: a table's heads are read by people.
double readable(double value) {
  constexpr int kReadable = 12;
  return *parse_number(format_number(value, kReadable));
}

std::vector<double> evenly(double low, double high, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(readable(low + (high - low) * k / (count - 1)));
  return values;
}

/// Within the domain but for rounding.
bool is_within(double value, double low, double high) {
  const double slack = 1e-9 * std::max(std::abs(low), std::abs(high));
  return value >= low - slack && value <= high + slack;
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

ForceMap force_map(const ExportedModel& model, double sample_time,
                   const std::vector<double>& velocities, const std::vector<double>& currents) {
  // The user's grid, or one over the domain.
  ForceMap map{.velocity = velocities, .current = currents, .force = {}, .extrapolated = {}};
  const Domain& d = model.domain;
  for (int k = -kHalf; k <= kHalf && velocities.empty(); ++k) {
    const double share = static_cast<double>(k * k) / (kHalf * kHalf);
    map.velocity.push_back(readable(share * (k < 0 ? d.velocity_min : d.velocity_max)));
  }
  if (currents.empty())
    map.current = d.current_max > d.current_min ? evenly(d.current_min, d.current_max, kCurrents)
                                                : std::vector{d.current_min};

  for (const double velocity : map.velocity)
    for (const double current : map.current) {
      map.force.push_back(settled_force(model, velocity, current, sample_time));
      map.extrapolated.push_back(is_within(velocity, d.velocity_min, d.velocity_max) &&
                                         is_within(current, d.current_min, d.current_max)
                                     ? 0
                                     : 1);
    }
  return map;
}

std::string extrapolation_note(const ExportedModel& model, const ExportOptions& options,
                               const PrintUnit& speed) {
  const Domain& d = model.domain;
  const auto leaves = [](const std::vector<double>& grid, double low, double high) {
    return std::ranges::any_of(grid, [&](double value) { return !is_within(value, low, high); });
  };
  if (!leaves(options.velocities, d.velocity_min, d.velocity_max) &&
      !leaves(options.currents, d.current_min, d.current_max))
    return {};
  const auto [low, high] =
      std::minmax({0 + speed.factor * d.velocity_min, 0 + speed.factor * d.velocity_max});
  return "extrapolated beyond " + format_number(low) + " ... " + format_number(high) + ' ' +
         speed.name + " and " + format_number(d.current_min) + " ... " +
         format_number(d.current_max) + ' ' + unit_of(model.drive_unit);
}

CurrentMap inverse_of(const ForceMap& map) {
  const auto [low, high] = std::ranges::minmax_element(map.force);
  CurrentMap inverse{map.velocity, evenly(*low, *high, kForces), {}};
  for (std::size_t v = 0; v < map.velocity.size(); ++v)
    for (const double force : inverse.force) inverse.current.push_back(current_for(map, v, force));
  return inverse;
}

}  // namespace dashpot
