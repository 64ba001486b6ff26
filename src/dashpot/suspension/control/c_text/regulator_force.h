#ifndef DASHPOT_REGULATOR_FORCE_H
#define DASHPOT_REGULATOR_FORCE_H
#include "demand.h"

/* A row of the regulator's gain times the plant's state, N. */
static inline double regulator_force(const double* gain, const double* x, int count) {
  double force = 0;
  int k;
  for (k = 0; k < count; ++k) {
    force += gain[k] * x[k];
  }
  return force;
}

#endif
