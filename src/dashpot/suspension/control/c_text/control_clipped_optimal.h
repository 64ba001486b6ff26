/* Clipped-optimal control: i = i_max where (F_wanted - F) F > 0, else i_min; F_wanted = K [q, q'].
 */
#include "demand.h"
#include "regulator_force.h"

static inline DamperDemand clipped_optimal_demand(double wanted, const ControlLimits* limits,
                                                  const StrutSignals* s) {
  const double growing = (wanted - s->force) * s->force;
  return demand_of(kDemandCurrent, (growing > 0) ? limits->current_max : limits->current_min);
}
