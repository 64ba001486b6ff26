/* The model that runs beside the damper: what inverse_observer.h asks for. */
typedef InverseModel Observer;

static inline int observed_states(const Observer* m) {
  (void)m;
  return @states @;
}

static inline double observer_step(const Observer* m) {
  (void)m;
  return @step @;
}

static inline int observer_lags(const Observer* m) {
  (void)m;
  return @lags @;
}

static inline int observer_horizon(const Observer* m) {
  (void)m;
  return @horizon @;
}

static inline void observed_rest(const Observer* m, const DamperInput* input, double* state) {
  (void)m;
  @stem @_rest(input, state);
}

static inline void observed_advance(const Observer* m, const DamperInput* from, const DamperInput* to,
                                    double dt, double* state) {
  (void)m;
  @stem @_advance(from, to, dt, state);
}

static inline double observed_force(const Observer* m, const DamperInput* input, const double* state) {
  (void)m;
  return @stem @_force(input, state);
}
