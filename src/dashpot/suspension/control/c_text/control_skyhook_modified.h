/* Modified skyhook of Besinger, Cebon and Cole: F = C (a d + (1 - a) z'), within c_min d ... c_max
 * d. */
#include "dissipating_force.h"

typedef struct SkyhookModified {
  double gain;  /* C, N*s/m */
  double share; /* a, of the passive damper */
} SkyhookModified;

static inline DamperDemand skyhook_modified_demand(const SkyhookModified* p,
                                                   const ControlLimits* limits,
                                                   const StrutSignals* s) {
  const double wanted =
      p->gain * ((p->share * s->deflection_velocity) + ((1 - p->share) * s->body_velocity));
  return dissipating_force(wanted, s->deflection_velocity, limits);
}
