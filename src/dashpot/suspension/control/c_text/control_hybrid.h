/* Hybrid of skyhook and groundhook: F = G (a s + (1 - a) g), within c_min d ... c_max d; s = z'
 * where z' d > 0, g = -z_us' where -z_us' d > 0, else 0.
 */
#include "dissipating_force.h"

typedef struct Hybrid {
  double gain;  /* G, N*s/m */
  double share; /* a, of the skyhook */
} Hybrid;

static inline DamperDemand hybrid_demand(const Hybrid* p, const ControlLimits* limits,
                                         const StrutSignals* s) {
  const double d = s->deflection_velocity;
  const double sky = ((s->body_velocity * d) > 0) ? s->body_velocity : 0;
  const double ground = ((-s->wheel_velocity * d) > 0) ? -s->wheel_velocity : 0;
  return dissipating_force(p->gain * ((p->share * sky) + ((1 - p->share) * ground)), d, limits);
}
