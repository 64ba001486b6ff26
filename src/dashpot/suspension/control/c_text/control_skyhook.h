/* Skyhook, two states: c = c_max where z' d >= 0, else c_min; d = z' - z_us'. */
#include "hard_when.h"

static inline DamperDemand skyhook_demand(const ControlLimits* limits, const StrutSignals* s) {
  return hard_when((s->body_velocity * s->deflection_velocity) >= 0, limits);
}
