/* The model that runs beside the damper: what inverse_observer.h asks for. */
typedef InverseModel Observer;

static inline int observed_states(const Observer* m) {
  (void)m;
  return OBSERVED_STATES;
}

static inline double observer_step(const Observer* m) {
  (void)m;
  return OBSERVER_STEP;
}

static inline int observer_lags(const Observer* m) {
  (void)m;
  return OBSERVER_LAGS;
}

static inline int observer_horizon(const Observer* m) {
  (void)m;
  return OBSERVER_HORIZON;
}

static inline void observed_rest(const Observer* m, const DamperInput* input, double* state) {
  (void)m;
  OBSERVED_REST(input, state);
}

static inline void observed_advance(const Observer* m, const DamperInput* from,
                                    const DamperInput* to, double dt, double* state) {
  (void)m;
  OBSERVED_ADVANCE(from, to, dt, state);
}

static inline double observed_force(const Observer* m, const DamperInput* input,
                                    const double* state) {
  (void)m;
  return OBSERVED_FORCE(input, state);
}
