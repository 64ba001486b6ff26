#ifndef DASHPOT_DISSIPATING_FORCE_H
#define DASHPOT_DISSIPATING_FORCE_H
#include "demand.h"

/* A force within what damping can give at this speed. */
static inline DamperDemand dissipating_force(double force, double velocity,
                                             const ControlLimits* limits) {
  const double a = limits->damping_min * velocity, b = limits->damping_max * velocity;
  const double low = (a < b) ? a : b, high = (a < b) ? b : a;
  const double least = (force > low) ? force : low; /* nor a number */
  return demand_of(kDemandForce, (least < high) ? least : high);
}

#endif
