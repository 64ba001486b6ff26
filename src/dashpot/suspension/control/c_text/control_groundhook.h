/* Groundhook, two states: c = c_max where -z_us' d >= 0, else c_min. */
#include "hard_when.h"

static inline DamperDemand groundhook_demand(const ControlLimits* limits, const StrutSignals* s) {
  return hard_when((-s->wheel_velocity * s->deflection_velocity) >= 0, limits);
}
