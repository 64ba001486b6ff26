/* The dampers are all alike. */
static inline double filter_force(const PlantFilter* f, int d, const DamperInput* input,
                                  const double* z) {
  (void)f;
  (void)d;
  return OBSERVED_FORCE(input, z);
}

static inline void filter_advance(const PlantFilter* f, int d, const DamperInput* from,
                                  const DamperInput* to, double dt, double* z) {
  (void)f;
  (void)d;
  OBSERVED_ADVANCE(from, to, dt, z);
}

/* The inputs with the drives behind them; one that is no number as it was. */
static void observer_inputs(const damper_input* input, const double* before, double* now) {
  int k;
  for (k = 0; k < filter_given(&kFilter); ++k) {
    const double value =
        (k < kFilter.inputs) ? input->inputs[k] : input->drives[k - kFilter.inputs];
    now[k] = (fabs(value) < 1e30) ? value : before[k];
  }
}

void damper_init(damper_model* model) {
  int k;
  model->started = 0;
  for (k = 0; k < DAMPER_STATE_SIZE; ++k) {
    model->state[k] = 0;
  }
}

void damper_reset(damper_model* model, const damper_input* input) {
  double* c = &model->state[FILTER_KEPT];
  double* before = &model->state[FILTER_KEPT + (FILTER_MOST * FILTER_MOST)];
  DamperInput still;
  int copy, k;
  damper_init(model);
  model->started = 1;
  observer_inputs(input, before, before);
  still.displacement = 0;
  still.velocity = 0;
  for (k = 0; k < kFilter.dampers; ++k) {
    still.current = before[filter_drive(&kFilter, k)];
    for (copy = 0; copy < ((kFilter.memory[k] > 0) ? 3 : 1); ++copy) {
      OBSERVED_REST(&still, &model->state[filter_state(&kFilter, k) + (copy * kFilter.memory[k])]);
    }
  }
  for (k = 0; k < FILTER_MOST; ++k) {
    c[(k * FILTER_MOST) + k] = kFirstDeviation[k] * kFirstDeviation[k];
  }
}

void damper_step(damper_model* model, const damper_input* input, double* outputs) {
  double* s = model->state;
  double* c = &model->state[FILTER_KEPT];
  double* before = &model->state[FILTER_KEPT + (FILTER_MOST * FILTER_MOST)];
  double now[FILTER_MOST_INPUTS + FILTER_MOST_DAMPERS], past[FILTER_KEPT];
  FilterSample sample;
  int k;
  if (model->started == 0) {
    damper_reset(model, input);
  }

  /* From the sample before to this one: the first one is where it begins. */
  observer_inputs(input, before, now);
  if (model->started == 1) {
    model->started = 2;
    filter_update(&kFilter, before, now, input->sensors, s, c, &sample);
  } else {
    for (k = 0; k < FILTER_KEPT; ++k) {
      past[k] = s[k];
    }
    filter_predict(&kFilter, before, now, s, c, sample.transition);
    filter_update(&kFilter, before, now, input->sensors, s, c, &sample);
    filter_remember(&kFilter, before, now, past, c, s);
  }

  /* What is told: each damper, then plant and roads. */
  for (k = 0; k < kFilter.dampers; ++k) {
    filter_damper(&kFilter, k, before, now, s, c, &outputs[4 * k]);
  }
  for (k = 0; k < filter_error(&kFilter, 0); ++k) {
    outputs[(4 * kFilter.dampers) + k] = s[k];
  }
  for (k = 0; k < filter_given(&kFilter); ++k) {
    before[k] = now[k];
  }
}
