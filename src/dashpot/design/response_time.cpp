#include <cmath>
#include <limits>

#include "dashpot/design/quantities.h"

namespace dashpot {
namespace {

/// Wb: what the voltage of the coil has to build up.
double flux_linkage(const DamperDescription& d, double current) {
  return d.turns * fluid_state(d, current).core_flux_density * d.core_area;
}

/// The current at which the force has made 90 % of its way; the force rises with the current.
double current_of_90_percent(const OperatedDamper& damper, double wanted) {
  double low = 0, high = std::abs(damper.operation.current);
  DamperOperation trial = damper.operation;
  for (int k = 0; k < 20; ++k) {
    trial.current = 0.5 * (low + high);
    const double force = std::abs(damper.model.evaluate(damper.description, trial).force);
    (force < wanted ? low : high) = trial.current;
  }
  return 0.5 * (low + high);
}

}  // namespace

double response_time(const OperatedDamper& damper) {
  constexpr int kSteps = 16;
  const double off = std::abs(damper.physics.off_force), on = std::abs(damper.physics.force);
  const double end = std::abs(damper.operation.current);
  if (!(on > off) || end == 0) return std::numeric_limits<double>::quiet_NaN();
  const double reached = current_of_90_percent(damper, off + 0.9 * (on - off));
  // d(lambda)/dt = R (I - i): the time is the integral of d(lambda) / (R (I - i)), by the midpoint rule.
  double time = 0, before = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double linkage = flux_linkage(damper.description, reached * (k + 1) / kSteps);
    time += (linkage - before) / (damper.physics.resistance * (end - reached * (k + 0.5) / kSteps));
    before = linkage;
  }
  return time;
}

}  // namespace dashpot
