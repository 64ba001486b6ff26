#ifndef DASHPOT_FREQUENCY_RANGE_H
#define DASHPOT_FREQUENCY_RANGE_H
#include "demand.h"

/* z''^2 - (2 pi f z')^2: above 0 the body moves faster than at f = crossover Hz. */
static inline double frequency_range(const StrutSignals* s, double crossover) {
  const double rate = 6.283185307179586 * crossover;
  return (s->body_acceleration * s->body_acceleration) -
         (rate * rate * s->body_velocity * s->body_velocity);
}

#endif
