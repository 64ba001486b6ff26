#include <array>
#include <cmath>
#include <limits>

#include "dashpot/design/quantities.h"
#include "dashpot/numerics/root.h"

namespace dashpot {
namespace {

/// Wb: what the voltage of the coil has to build up.
double flux_linkage(const DamperDescription& d, double current) {
  return d.turns * fluid_state(d, current).core_flux_density * d.core_area;
}

/// The current at which the force has made 90 % of its way; the force rises with the current.
double current_of_90_percent(const OperatedDamper& damper, double off, double on) {
  const double wanted = off + 0.9 * (on - off);
  DamperOperation trial = damper.operation;
  const auto missing = [&](double current) {
    trial.current = current;
    return std::abs(damper.model.force(damper.description, trial)) - wanted;
  };

  // A fitted model runs through a cycle for each force, which no more than its errors is worth.
  const double tolerance = damper.model.is_fitted() ? 1e-4 : 1e-9;
  return find_root(missing, {0, off - wanted}, {std::abs(damper.operation.current), on - wanted},
                   tolerance * (on - off));
}

}  // namespace

double response_time(const OperatedDamper& damper) {
  // Points and weights of Gauss and Legendre on 0 ... 1.
  constexpr std::array<double, 5> kPoints{0.046910077030668, 0.230765344947158, 0.5,
                                          0.769234655052842, 0.953089922969332};
  constexpr std::array<double, 5> kWeights{0.118463442528095, 0.239314335249683, 0.284444444444444,
                                           0.239314335249683, 0.118463442528095};
  const double off = std::abs(damper.physics.off_force), on = std::abs(damper.physics.force);
  const double end = std::abs(damper.operation.current);
  if (!(on > off) || end == 0) return std::numeric_limits<double>::quiet_NaN();
  const double reached = current_of_90_percent(damper, off, on);
  // d(lambda)/dt = R (I - i), so that t is the integral of d(lambda) / (R (I - i)). By parts lambda
  // alone is asked; in s = -ln(1 - i/I), with ds = di / (I - i), what is left is smooth.
  double time = flux_linkage(damper.description, reached) / (end - reached);
  const double last = -std::log1p(-reached / end);
  for (std::size_t k = 0; k < kPoints.size(); ++k) {
    const double left = end * std::exp(-last * kPoints[k]);
    time -= last * kWeights[k] * flux_linkage(damper.description, end - left) / left;
  }
  return time / damper.physics.resistance;
}

}  // namespace dashpot
