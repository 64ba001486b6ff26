/* From a demand to a wanted force, as C99 text that the library takes in and the C export ships.
 * Declared before: what demand.h asks for. */

/* N, at this velocity; of a demand that is no current. */
static inline double demanded_force(const DamperDemand* demand, double velocity) {
  return (demand->kind == kDemandForce) ? demand->value : (demand->value * velocity);
}
