/* Velocity from a displacement sensor, as C99 text that the library takes in and the C export
 * ships. */

/* The difference of neighbours, of which `share` is taken over from sample to sample. memory: the
 * velocity, m/s, and the last displacement, which stands for one that is no number. */
static inline double filtered_slope(double displacement, double share, double dt, double* memory) {
  const double seen = (isfinite(displacement) != 0) ? displacement : memory[1];
  memory[0] += share * (((seen - memory[1]) / dt) - memory[0]);
  memory[1] = seen;
  return memory[0];
}
