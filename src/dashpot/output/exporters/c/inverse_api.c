static const int kSignals = 4; /* in a row of the state: displacement, velocity, wanted force, current */

void damper_reset(damper_model* model, const damper_input* input) {
  int k;
  for (k = 0; k < DAMPER_STATE_SIZE; k += kSignals) {
    model->state[k] = input->displacement;
    model->state[k + 1] = 0;
    model->state[k + 2] = 0;
    model->state[k + 3] = held(input->current, kLeast, kMost);
  }
}

void damper_init(damper_model* model) {
  const damper_input still = {0.0, 0.0, 0.0, 0.0};
  damper_reset(model, &still);
}

/* What the network answers, no further from its last answer than it may change. */
static double wanted_current(damper_model* model, const damper_input* input) {
  double raw[MLP_MOST_WIDTH], current;
  int k;
  for (k = DAMPER_STATE_SIZE - 1; k >= kSignals; --k) {
    model->state[k] = model->state[k - kSignals];
  }
  model->state[0] = input->displacement;
  model->state[1] = input->velocity;
  model->state[2] = input->wanted;
  for (k = 0; k < INVERSE_TAPS; ++k) {
    raw[k] = model->state[kPlaces[k]];
  }
  current = mlp_evaluate(&kMlps[0], raw);
  if (!(current > kLeast)) { /* nor a number */
    current = kLeast;
  }
  current = fmin(current, kMost);
  model->state[3] = held(current, model->state[7] - kMostChange, model->state[7] + kMostChange);
  return model->state[3];
}

double damper_step(damper_model* model, const damper_input* input) {
  double command = input->current;
  if (isfinite(input->wanted) && isfinite(input->displacement) && isfinite(input->velocity) &&
      isfinite(input->current)) {
    command = wanted_current(model, input);
  }
  if (!(command > kLeast)) {
    command = kLeast;
  }
  return fmin(command, kMost);
}
