/* How a law's states and the current in its coil are brought over one step of a simulation, as C99
 * text that the library takes in and the C export ships, both behind law_path.h. Declared before,
 * for the law at work: LawParameters, law_parameters (at a current), law_states (how many),
 * law_rate (its bound, 1/s), law_explicit_step, and law_has_own_step, law_own_step_is_exact,
 * law_own_step (0 where it does not apply).
 */

/* The law's own step, `count` times; 0 where the law has none for these parameters. */
static inline int law_own_steps(const LawModel* m, const LawPath* path, int count, double* z) {
  const double h = path->dt / (double)count;
  int done = law_has_own_step(m), k;
  for (k = 0; (k < count) && (done != 0); ++k) {
    const double t = (double)k * h;
    double x[2], v[2];
    LawParameters middle;

    /* One set of parameters serves the whole step: that of its middle. */
    law_parameters(m, law_path_current(path, t + h / 2), &middle);
    x[0] = path->x + path->x_slope * t;
    x[1] = path->x + path->x_slope * (t + h);
    v[0] = path->v + path->v_slope * t;
    v[1] = path->v + path->v_slope * (t + h);

    done = law_own_step(m, &middle, x, v, h, z);
  }
  return done;
}

/* Classical Runge-Kutta, `count` times; `start`: the parameters at the path's start. */
static inline void law_explicit_steps(const LawModel* m, const LawPath* path,
                                      const LawParameters* start, int count, double* z) {
  const double h = path->dt / (double)count;
  LawParameters middle, ends[2];
  const LawParameters* stages[3];
  int k;
  stages[0] = start;
  stages[1] = start;
  stages[2] = start;
  for (k = 0; k < count; ++k) {
    const double t = (double)k * h;
    double x[3], v[3];

    /* Motion at the step's start, middle and end. */
    x[0] = path->x + path->x_slope * t;
    x[1] = path->x + path->x_slope * (t + h / 2);
    x[2] = path->x + path->x_slope * (t + h);
    v[0] = path->v + path->v_slope * t;
    v[1] = path->v + path->v_slope * (t + h / 2);
    v[2] = path->v + path->v_slope * (t + h);

    /* Parameters there. The end's serve the next step as its start, so two sets take turns. */
    if (path->varies != 0) {
      LawParameters* end = &ends[k % 2];
      law_parameters(m, law_path_current(path, ((double)k + 0.5) * h), &middle);
      law_parameters(m, law_path_current(path, ((double)k + 1) * h), end);
      stages[1] = &middle;
      stages[2] = end;
    }

    law_explicit_step(m, stages, x, v, h, z);
    stages[0] = stages[2];
  }
}

/* The states over the step in as many steps of their own as the law's rate asks for: classical
 * Runge-Kutta, or the law's own step where that would take many. */
static inline void law_integrate(const LawModel* m, const LawPath* path, double* z) {
  /* Runge-Kutta is stable up to rate * step = 2.78 on the real axis. Where the cap is reached the
   * run diverges, and shows it, instead of taking hours. */
  const double step_limit = 2, most_steps = 200;
  /* A law's own step costs about two explicit ones and serves for six: measured on the modified
   * Bouc-Wen law, the error of both then is that of inputs taken as straight lines between samples.
   */
  const double many_steps = 3, own_step_ratio = 6;
  const int exact = law_own_step_is_exact(m);
  int done = 0;

  /* An exact step needs no smaller ones while the parameters stay. */
  if ((exact != 0) && (path->varies == 0)) {
    done = law_own_steps(m, path, 1, z);
  }

  if (done == 0) {
    /* The fastest rate at either end of the step decides how many steps are wanted. */
    const double top_speed = fmax(fabs(path->v), fabs(path->v + path->v_slope * path->dt));
    double rate, wanted;
    LawParameters start, end;
    law_parameters(m, law_path_current(path, 0), &start);
    rate = law_rate(m, &start, top_speed);
    if (path->varies != 0) {
      law_parameters(m, law_path_current(path, path->dt), &end);
      rate = fmax(rate, law_rate(m, &end, top_speed));
    }

    wanted = ceil(rate * path->dt / step_limit);

    /* The law's own step where many are wanted; explicit ones else, or where the law declines. */
    if (wanted > ((exact != 0) ? 1 : many_steps)) {
      const int count = (exact != 0) ? 1 : 1 + (int)ceil(fmin(wanted, most_steps) / own_step_ratio);
      done = law_own_steps(m, path, count, z);
    }
    if (done == 0) {
      const int count = (wanted > 1) ? (int)fmin(wanted, most_steps) : 1; /* 1 for NaN too */
      law_explicit_steps(m, path, &start, count, z);
    }
  }
}

/* `state`: the law's states, then the current in the coil when it lags. */
static inline void law_advance(const LawModel* m, const DamperInput* from, const DamperInput* to,
                               double dt, double* state) {
  const int states = law_states(m), lags = (law_lag_rate(m) > 0) ? 1 : 0;
  const LawPath path = law_path(m, from, to, dt, (lags != 0) ? state[states] : 0);
  if (lags != 0) {
    state[states] = law_path_current(&path, dt);
  }
  if (states > 0) {
    law_integrate(m, &path, state);
  }
}
