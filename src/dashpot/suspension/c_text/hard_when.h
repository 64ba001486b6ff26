#ifndef DASHPOT_HARD_WHEN_H
#define DASHPOT_HARD_WHEN_H
#include "demand.h"

/* The most damping where `hard` is not 0, else the least. */
static inline DamperDemand hard_when(int hard, const ControlLimits* limits) {
  return demand_of(kDemandDamping, (hard != 0) ? limits->damping_max : limits->damping_min);
}

#endif
