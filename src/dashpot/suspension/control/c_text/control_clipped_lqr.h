/* Clipped linear-quadratic regulator: F = K [q, q'], within c_min d ... c_max d. */
#include "dissipating_force.h"
#include "regulator_force.h"

static inline DamperDemand clipped_lqr_demand(double wanted, const ControlLimits* limits,
                                              const StrutSignals* s) {
  return dissipating_force(wanted, s->deflection_velocity, limits);
}
