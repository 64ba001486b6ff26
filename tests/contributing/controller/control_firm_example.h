/* A control law for CONTRIBUTING.md: c = c_max, always. */
#include "demand.h"

static inline DamperDemand firm_example_demand(const ControlLimits* limits, const StrutSignals* s) {
  (void)s;
  return demand_of(kDemandDamping, limits->damping_max);
}
