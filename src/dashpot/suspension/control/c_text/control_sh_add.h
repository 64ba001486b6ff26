/* Mixed skyhook and ADD: by the body's velocity z' where z''^2 - (2 pi f z')^2 <= 0, by its
 * acceleration z'' elsewhere; c = c_max where that times d is above 0, else c_min.
 */
#include "frequency_range.h"
#include "hard_when.h"

typedef struct ShAdd {
  double crossover; /* Hz, between low and high frequencies */
} ShAdd;

static inline DamperDemand sh_add_demand(const ShAdd* p, const ControlLimits* limits,
                                         const StrutSignals* s) {
  const double signal =
      (frequency_range(s, p->crossover) <= 0) ? s->body_velocity : s->body_acceleration;
  return hard_when((signal * s->deflection_velocity) > 0, limits);
}
