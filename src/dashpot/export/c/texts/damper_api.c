void damper_rest(const damper_input* input, double* state) { model_rest(input, state); }

void damper_move(const damper_input* from, const damper_input* to, double dt, double* state) {
  if (dt > 0) {
    model_advance(from, to, dt, state);
  }
}

double damper_force(const damper_input* input, const double* state) {
  return model_force(input, state);
}

void damper_reset(damper_model* model, const damper_input* input) {
  model->input = *input;
  damper_rest(input, model->state);
}

void damper_init(damper_model* model) {
  const damper_input still = {0.0, 0.0, 0.0};
  damper_reset(model, &still);
}

double damper_advance(damper_model* model, const damper_input* input, double dt) {
  damper_move(&model->input, input, dt, model->state);
  model->input = *input;
  return damper_force(input, model->state);
}

double damper_step(damper_model* model, const damper_input* input) {
  return damper_advance(model, input, DAMPER_SAMPLE_TIME);
}
