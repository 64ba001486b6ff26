/* What a damper's piston gives more in one direction: a valve of its own beside the law, as C99
 * text that the library takes in and the C export ships. friction N and viscous N*s/m act in
 * rebound (v > 0) where they are positive and in compression where they are negative; friction sets
 * in over `speed`, m/s. Against v at every speed, whatever the numbers, so that it takes energy
 * out.
 */
static inline double law_side(double friction, double viscous, double speed, double v) {
  const double side = (v > 0) ? 1.0 : -1.0;
  return (fmax(side * friction, 0.0) * tanh(v / speed)) + (fmax(side * viscous, 0.0) * v);
}
