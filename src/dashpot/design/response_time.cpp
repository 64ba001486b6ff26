#include <array>
#include <cmath>
#include <limits>

#include "dashpot/design/quantities.h"

namespace dashpot {
namespace {

/// Wb: what the voltage of the coil has to build up.
double flux_linkage(const DamperDescription& d, double current) {
  return d.turns * fluid_state(d, current).core_flux_density * d.core_area;
}

/// The current at which the force has made 90 % of its way; the force rises with the current. Illinois'
/// regula falsi.
double current_of_90_percent(const OperatedDamper& damper, double off, double on) {
  const double tolerance = 1e-9 * (on - off), wanted = off + 0.9 * (on - off);
  double low = 0, high = std::abs(damper.operation.current), below = off - wanted, above = on - wanted;
  DamperOperation trial = damper.operation;
  for (int k = 0; k < 60; ++k) {
    trial.current = (low * above - high * below) / (above - below);
    const double off_wanted = std::abs(damper.model.evaluate(damper.description, trial).force) - wanted;
    if (std::abs(off_wanted) <= tolerance) break;
    if (off_wanted < 0) {
      low = trial.current;
      below = off_wanted;
      above *= 0.5;
    } else {
      high = trial.current;
      above = off_wanted;
      below *= 0.5;
    }
  }
  return trial.current;
}

}  // namespace

double response_time(const OperatedDamper& damper) {
  // Points and weights of Gauss and Legendre on 0 ... 1.
  constexpr std::array<double, 5> kPoints{0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                                          0.953089922969332};
  constexpr std::array<double, 5> kWeights{0.118463442528095, 0.239314335249683, 0.284444444444444,
                                           0.239314335249683, 0.118463442528095};
  const double off = std::abs(damper.physics.off_force), on = std::abs(damper.physics.force);
  const double end = std::abs(damper.operation.current);
  if (!(on > off) || end == 0) return std::numeric_limits<double>::quiet_NaN();
  const double reached = current_of_90_percent(damper, off, on);
  // d(lambda)/dt = R (I - i), so that t is the integral of d(lambda) / (R (I - i)); by parts, lambda alone is
  // asked.
  double time = flux_linkage(damper.description, reached) / (end - reached);
  for (std::size_t k = 0; k < kPoints.size(); ++k) {
    const double current = reached * kPoints[k], left = end - current;
    time -= reached * kWeights[k] * flux_linkage(damper.description, current) / (left * left);
  }
  return time / damper.physics.resistance;
}

}  // namespace dashpot
