/* Motion and coil current over one step of a simulation, as C99 text that the library takes in and
 * the C export ships. Declared before: LawModel, DamperInput, law_lag_rate (1/s, of the coil; 0:
 * none) and law_follows_current (whether a parameter depends on the current).
 */

/* Straight lines in time for displacement, velocity and the command. The coil's current is a
 * straight line too, but for a deviation that decays at the lag rate: with these inputs this is
 * exact. */
typedef struct LawPath {
  double x, v, i; /* at its start; i: what the coil's current tends to */
  double x_slope, v_slope, i_slope;
  double lag_rate, deviation;
  double dt;
  int varies; /* the law's parameters do, with the coil's current */
} LawPath;

/* The path from one input to the next over dt; coil_current: the one in the coil at its start. */
static inline LawPath law_path(const LawModel* m, const DamperInput* from, const DamperInput* to,
                               double dt, double coil_current) {
  const double lag_rate = law_lag_rate(m);
  LawPath path;
  path.x = from->displacement;
  path.v = from->velocity;
  path.i = from->current;
  path.x_slope = (to->displacement - from->displacement) / dt;
  path.v_slope = (to->velocity - from->velocity) / dt;
  path.i_slope = (to->current - from->current) / dt;

  /* A coil that lags tends to the command as it was one time constant ago. */
  path.lag_rate = lag_rate;
  path.deviation = 0;
  path.dt = dt;
  if (lag_rate > 0) {
    path.i -= path.i_slope / lag_rate;
    path.deviation = coil_current - path.i;
    if (1e-14 * fabs(path.i) >= fabs(path.deviation)) { /* rounding */
      path.deviation = 0;
    }
  }
  path.varies =
      (law_follows_current(m) != 0) && ((path.i_slope != 0) || (path.deviation != 0)) ? 1 : 0;
  return path;
}

/* A, in the coil at t after the step's start */
static inline double law_path_current(const LawPath* path, double t) {
  const double settled = path->i + path->i_slope * t;
  return path->deviation == 0 ? settled : settled + path->deviation * exp(-path->lag_rate * t);
}
