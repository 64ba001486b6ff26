/* Acceleration-driven damper: c = c_max where z'' d >= 0, else c_min. */
#include "hard_when.h"

static inline DamperDemand add_demand(const ControlLimits* limits, const StrutSignals* s) {
  return hard_when((s->body_acceleration * s->deflection_velocity) >= 0, limits);
}
