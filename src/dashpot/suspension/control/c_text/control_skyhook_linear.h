/* Skyhook, linear: c = sat((a c_max d + (1 - a) c_max z') / d) where z' d > 0, else c_min. */
#include "demand.h"

typedef struct SkyhookLinear {
  double share; /* a, of the passive damper */
} SkyhookLinear;

static inline DamperDemand skyhook_linear_demand(const SkyhookLinear* p,
                                                 const ControlLimits* limits,
                                                 const StrutSignals* s) {
  const double d = s->deflection_velocity, z = s->body_velocity;
  double damping = limits->damping_min;
  if ((z * d) > 0) {
    const double wanted = limits->damping_max * (p->share + ((1 - p->share) * z / d));
    damping = fmin(fmax(wanted, limits->damping_min), limits->damping_max);
  }
  return demand_of(kDemandDamping, damping);
}
