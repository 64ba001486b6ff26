/* Mix-1-sensor: c = c_max where z''^2 - (2 pi f z')^2 <= 0, else c_min. */
#include "frequency_range.h"
#include "hard_when.h"

typedef struct Mix1 {
  double crossover; /* Hz, between low and high frequencies */
} Mix1;

static inline DamperDemand mix1_demand(const Mix1* p, const ControlLimits* limits,
                                       const StrutSignals* s) {
  return hard_when(frequency_range(s, p->crossover) <= 0, limits);
}
