#ifndef DASHPOT_SELECTED_DEMAND_H
#define DASHPOT_SELECTED_DEMAND_H
#include "frequency_range.h"

/* One law's demand at low frequencies of the body, another's at high ones. */
static inline DamperDemand selected_demand(const StrutSignals* s, double crossover,
                                           DamperDemand low, DamperDemand high) {
  DamperDemand demand = low;
  if (frequency_range(s, crossover) > 0) {
    demand = high;
  }
  return demand;
}

#endif
