/* Passive: one damping, c = c_min + place (c_max - c_min). */
#include "demand.h"

typedef struct Constant {
  double place; /* 0: soft, 1: hard */
} Constant;

static inline DamperDemand constant_demand(const Constant* p, const ControlLimits* limits,
                                           const StrutSignals* s) {
  (void)s;
  return demand_of(kDemandDamping,
                   limits->damping_min + (p->place * (limits->damping_max - limits->damping_min)));
}
