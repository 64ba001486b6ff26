/* What a control law asks of a damper, as C99 text that the library takes in and the C export
 * ships. Declared before: StrutSignals, ControlLimits; DamperDemand with its kind and value, the
 * kinds being kDemandDamping, kDemandForce and kDemandCurrent of type DemandKind.
 */
#ifndef DASHPOT_DEMAND_H
#define DASHPOT_DEMAND_H

static inline DamperDemand demand_of(DemandKind kind, double value) {
  DamperDemand demand;
  demand.kind = kind;
  demand.value = value;
  return demand;
}

#endif
