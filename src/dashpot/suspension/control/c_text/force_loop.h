/* Force tracking, as C99 text that the library takes in and the C export ships. Declared before:
 * ForceLoop with its proportional (1), integral (1/s) and derivative (s) gain. */

/* The wanted force and what the measured one misses of it, by PID. memory: what was missed at last,
 * N, its integral, and that before this step. */
static inline double force_loop_step(const ForceLoop* loop, double wanted, double measured,
                                     double dt, double* memory) {
  const double missed = wanted - measured;
  double answer = wanted;
  memory[2] = memory[1];
  if (isfinite(missed) != 0) {
    const double rate = (missed - memory[0]) / dt;
    memory[0] = missed;
    memory[1] += missed * dt;
    answer +=
        (loop->proportional * missed) + (loop->integral * memory[1]) + (loop->derivative * rate);
  }
  return answer;
}

/* The integral stands still while the current that comes of it is at one of its limits. */
static inline void force_loop_limit(double current, double least, double most, double* memory) {
  if (!((current > least) && (current < most))) {
    memory[1] = memory[2];
  }
}
