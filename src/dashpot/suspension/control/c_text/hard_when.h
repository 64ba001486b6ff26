#ifndef DASHPOT_HARD_WHEN_H
#define DASHPOT_HARD_WHEN_H
#include "demand.h"

/* The most damping where `hard` is not 0, else the least. */
static inline DamperDemand hard_when(int hard, const ControlLimits* limits) {
  const double values[2] = {limits->damping_min,
                            limits->damping_max}; /* no branch: nobody would foresee it */
  return demand_of(kDemandDamping, values[hard != 0]);
}

#endif
