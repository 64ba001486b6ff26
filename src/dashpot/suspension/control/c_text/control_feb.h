/* Frequency-estimation-based: f = sqrt(sum d^2 / sum x^2) / 2 pi, sums that forget being a window
 * without a buffer; c = c_max where f < low or middle <= f < high, else c_min. memory: the two
 * sums.
 */
#include "hard_when.h"

typedef struct Feb {
  double keep;              /* of the sums, from sample to sample */
  double low, middle, high; /* Hz */
} Feb;

static inline DamperDemand feb_demand(const Feb* p, const ControlLimits* limits,
                                      const StrutSignals* s, double* memory) {
  double f = 0;
  if ((isfinite(s->deflection) != 0) && (isfinite(s->deflection_velocity) != 0)) {
    memory[0] = (p->keep * memory[0]) + (s->deflection_velocity * s->deflection_velocity);
    memory[1] = (p->keep * memory[1]) + (s->deflection * s->deflection);
  }
  if (memory[1] > 0) {
    f = sqrt(memory[0] / memory[1]) / 6.283185307179586;
  }
  return hard_when((f < p->low) || ((f >= p->middle) && (f < p->high)), limits);
}
