void damper_init(damper_model* model) {
  int k;
  model->started = 0;
  for (k = 0; k < DAMPER_STRUTS; ++k) {
    model->demands[k] = demand_of(kDemandDamping, 0);
  }
  for (k = 0; k < DAMPER_STATE_SIZE; ++k) {
    model->state[k] = 0;
  }
}

void damper_reset(damper_model* model, const damper_input* input) {
  int k;
  damper_init(model);
  model->started = 1;
  for (k = 0; k < DAMPER_STRUTS; ++k) {
    strut_rest(&input->struts[k], &model->state[k * STRUT_STATE]);
  }
}

void damper_step(damper_model* model, const damper_input* input, double* commands) {
  int k;
  if (model->started == 0) {
    damper_reset(model, input);
  }
  for (k = 0; k < DAMPER_STRUTS; ++k) {
    double* state = &model->state[k * STRUT_STATE];
    const StrutSignals s = strut_signals(&input->struts[k], state);
    model->demands[k] = strut_demand(&s, input, k, state);
    commands[k] = strut_command(&s, &model->demands[k], state);
  }
}
