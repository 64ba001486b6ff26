/* From a demand to a current without a model of the damper, as C99 text that the library takes in
 * and the C export ships. Declared before: what demand.h asks for. */

/* Damping in a straight line onto the currents; a force as that damping which gives it at this
 * velocity. */
static inline double straight_current(const DamperDemand* demand, double velocity,
                                      const ControlLimits* limits) {
  const double range = limits->damping_max - limits->damping_min;
  double damping = demand->value, place = 0;
  if (demand->kind == kDemandForce) {
    damping = (velocity != 0) ? (demand->value / velocity) : limits->damping_min;
  }
  if (range > 0) {
    place = (damping - limits->damping_min) / range;
  }
  if (!(place > 0)) { /* nor a number */
    place = 0;
  }
  return limits->current_min + (fmin(place, 1) * (limits->current_max - limits->current_min));
}
