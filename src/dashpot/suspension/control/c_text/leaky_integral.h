/* Velocity from an acceleration sensor, as C99 text that the library takes in and the C export
 * ships. */

/* An integral that forgets by `keep` from sample to sample, so that an offset of the sensor stays
 * without consequence. memory: the velocity, m/s, and the last acceleration, which stands for one
 * that is no number.
 */
static inline double leaky_integral(double acceleration, double keep, double dt, double* memory) {
  const double seen = (isfinite(acceleration) != 0) ? acceleration : memory[1];
  memory[0] = (keep * memory[0]) + (0.5 * dt * (memory[1] + seen));
  memory[1] = seen;
  return memory[0];
}
