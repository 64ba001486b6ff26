/* Power-driven damper: c = c_min where k x d + c_min d^2 >= 0, c_max where k x d + c_max d^2 < 0,
 * (c_min + c_max) / 2 where x != 0 and d = 0, else -k x / d.
 */
#include "demand.h"

typedef struct Pdd {
  double stiffness; /* N/m, of the suspension */
} Pdd;

static inline DamperDemand pdd_demand(const Pdd* p, const ControlLimits* limits,
                                      const StrutSignals* s) {
  const double d = s->deflection_velocity, spring = p->stiffness * s->deflection;
  double damping;
  if (((spring * d) + (limits->damping_min * d * d)) >= 0) {
    const int still = (d == 0) && (s->deflection != 0);
    damping =
        (still != 0) ? (0.5 * (limits->damping_min + limits->damping_max)) : limits->damping_min;
  } else if (((spring * d) + (limits->damping_max * d * d)) < 0) {
    damping = limits->damping_max;
  } else {
    damping = -spring / d;
  }
  return demand_of(kDemandDamping, damping);
}
